#include "scenes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "slipscale/base/parallel.hpp"

namespace slipscale::testing_support {

Mesh block_mesh(const Block& block, Partitioner partitioner, int refine) {
  const std::string path = scratch("block.msh");
  write_block(block, path);
  return read_mesh(PETSC_COMM_WORLD, {path, partitioner, refine});
}

PetscInt outer_edge_count(const Mesh& mesh) {
  // Every cell beside an owned one is local, those of other ranks included.
  struct Sides {
    int all = 0, owned = 0;
  };
  std::map<std::pair<int, int>, Sides> edges;
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    for (int k = 0, n = mesh.cells.corner_count(cell); k < n; ++k) {
      const int first = mesh.cells.first[cell], a = mesh.cells.corner_nodes[first + k],
                b = mesh.cells.corner_nodes[first + (k + 1) % n];
      Sides& sides = edges[std::minmax(a, b)];
      ++sides.all;
      sides.owned += mesh.cells.owned[cell];
    }
  PetscInt count = 0;
  for (const auto& [ends, sides] : edges) count += sides.all == 1 && sides.owned == 1;
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD);
  return count;
}

Material isotropic(double young, double poisson, double density) {
  return {isotropic_stiffness(young, poisson), density, "isotropic"};
}

double value_near(const Mesh& mesh, const Vector2* field, const Vector2& x, int axis) {
  struct {
    double distance;
    int rank;
  } best{1e300, 0};
  best.rank = rank_of(PETSC_COMM_WORLD);
  const int own_rank = best.rank;
  int nearest = -1;
  for (int i = 0; i < mesh.nodes.owned; ++i) {
    const double d = std::hypot(mesh.nodes.position[i][0] - x[0], mesh.nodes.position[i][1] - x[1]);
    if (d < best.distance) {
      best.distance = d;
      nearest = i;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MINLOC, PETSC_COMM_WORLD);
  double value = own_rank == best.rank ? field[nearest][axis] : 0;
  MPI_Bcast(&value, 1, MPI_DOUBLE, best.rank, PETSC_COMM_WORLD);
  return value;
}

Vector2 support_force(const SlidingBody& body, const std::string& boundary) {
  Vector2 sum{};
  for (int i : body.model().mesh.find_boundary(boundary)->nodes) {
    const Vector2 force = body.force_on_support(body.boundary_nodes().slot_of(i));
    sum = {sum[0] + force[0], sum[1] + force[1]};
  }
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return sum;
}

std::vector<Vector2> whole_field(MPI_Comm comm, const Mesh& mesh, const Vector2* owned) {
  std::vector<Vector2> all(static_cast<std::size_t>(mesh.nodes.total), {0, 0});
  for (int i = 0; i < mesh.nodes.owned; ++i) all[mesh.nodes.number[i]] = owned[i];
  // One rank adds to zeros, so the sum changes no bit.
  MPI_Allreduce(MPI_IN_PLACE, all.data(), 2 * static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, comm);
  return all;
}

void StatusCount::add(const ContactNodes& contact) {
  for (const ContactStatus status : contact.status)
    ++(status == ContactStatus::open ? open : status == ContactStatus::stick ? stick : slip);
}

StatusCount StatusCount::over_ranks(MPI_Comm comm) const {
  StatusCount sum = *this;
  MPI_Allreduce(MPI_IN_PLACE, &sum, 3, MPI_LONG, MPI_SUM, comm);
  return sum;
}

Scene scene_r() {
  Scene scene;
  scene.conditions = {{"top", {0.0, -1.3888888888888889e-6}, 0, 0, 40e-6}};
  scene.damping.stiffness = 2e-9;
  scene.surface = Surface{"bottom", 0, 2, 0};
  scene.friction.law = FrictionChoice::Law::regularized;
  scene.friction.coefficient = 0.5;
  scene.friction.time = 0.6e-6;
  scene.friction.stored_strength = true;
  return scene;
}

Material scene_r_material() { return isotropic(45e9, 0.25, 1800); }

}  // namespace slipscale::testing_support
