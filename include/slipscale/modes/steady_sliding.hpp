#pragma once

#include <memory>
#include <vector>

#include "slipscale/dynamics/scene.hpp"
#include "slipscale/modes/sliding_law.hpp"
#include "slipscale/modes/sliding_operator.hpp"

namespace slipscale {

/// A node that can meet the surface, as `slide` has it.
struct SurfaceNode {
  int node = 0;          ///< local, owned
  double length = 0;     ///< tributary length, m
  double clearance = 0;  ///< height of the undeformed node above the surface, m
  SteadyCoefficient friction{};
};

/// The equilibrium of a body under which the surface slides for ever: every closed node slips, its friction
/// is μλ in the direction of the surface. Loads and displacements have their full values, and nothing moves.
struct SteadySliding {
  std::vector<Vector2> displacement;            ///< [owned], m
  std::vector<SurfaceNode> nodes;               ///< of this rank, in the order of their numbers
  std::vector<char> is_closed;                  ///< [nodes]
  std::vector<double> reaction;                 ///< [nodes] λ ≥ 0, N/m
  PetscInt in_contact = 0, open = 0;            ///< of the whole body
  double normal_force = 0;                      ///< Σλ, N/m
  double tangential_force = 0;                  ///< of friction on the body along +x, N/m
  int rounds = 0;                               ///< of the active set
  std::vector<std::string> notes;               ///< for the user to see
  std::shared_ptr<const SlidingOperator> body;  ///< of its closed nodes
};

/// Reads the part of a scene that steady sliding takes. Throws UserError without a surface that moves and a
/// friction law.
Scene read_sliding_scene(const Options& options, const Mesh& mesh);

/// Finds it by an active set: closed nodes that are pulled open, open ones that go through the surface
/// closed, until none is left. Throws UserError for contradictory conditions, when nothing touches the
/// surface, for a body that nothing holds, and when no set is left unchanged. Collective.
SteadySliding steady_sliding(MPI_Comm comm, const Model& model, const Scene& scene);

/// Whether the nodes that are closed in `state` are those that are closed with the coefficient of `scene`,
/// which may differ from that of the state in it. Collective.
bool keeps_contact(MPI_Comm comm, const Model& model, const Scene& scene, const SteadySliding& state);

}  // namespace slipscale
