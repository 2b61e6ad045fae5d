#pragma once

#include <string>
#include <vector>

#include "block_mesh.hpp"
#include "slipscale/dynamics/sliding_body.hpp"
#include "slipscale/mesh/read.hpp"

namespace slipscale::testing_support {

/// Writes a block to a scratch file and reads it back as a partitioned mesh.
Mesh block_mesh(const Block& block, Partitioner partitioner = Partitioner::metis, int refine = 0);

/// Edges with a cell on one side only, of the whole mesh. Collective on PETSC_COMM_WORLD.
PetscInt outer_edge_count(const Mesh& mesh);

Material isotropic(double young, double poisson, double density);

/// Value at the owned node nearest to `x`, the same on every rank: component `axis` of `field` [owned].
double value_near(const Mesh& mesh, const Vector2* field, const Vector2& x, int axis);

/// Sum over the boundary's nodes of the force of the body on its support, x and y, N/m. Collective.
Vector2 support_force(const SlidingBody& body, const std::string& boundary);

/// Values of all nodes of the whole mesh by their number, the same on every rank. Collective.
std::vector<Vector2> whole_field(MPI_Comm comm, const Mesh& mesh, const Vector2* owned);

/// A body with the mesh and the model it lives on.
struct Simulation {
  Simulation(MPI_Comm comm, const MeshSource& source, const std::vector<Material>& materials,
             const Scene& scene, double time_step)
      : mesh(read_mesh(comm, source)),
        model(mesh, materials, Model::Storage::full),
        body(comm, model, scene, time_step) {}

  const Mesh mesh;
  const Model model;
  SlidingBody body;
};

/// How often a contact node was seen open, sticking and slipping.
struct StatusCount {
  long open = 0, stick = 0, slip = 0;
  void add(const ContactNodes& contact);
  StatusCount over_ranks(MPI_Comm comm) const;
  bool all_seen() const { return open > 0 && stick > 0 && slip > 0; }
};

/// Scene R, of which tests/verification/second_program.py has figures: a homogeneous block pressed at its top
/// on a fast surface. Units SI.
Scene scene_r();
Material scene_r_material();

}  // namespace slipscale::testing_support
