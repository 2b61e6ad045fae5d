#pragma once

#include <vector>

#include "slipscale/contact/contact_nodes.hpp"
#include "slipscale/dynamics/conditions.hpp"
#include "slipscale/dynamics/model.hpp"
#include "slipscale/dynamics/scheme.hpp"

namespace slipscale {

/// The owned nodes on the boundaries that carry a condition, meet the surface or are measured, in compact
/// arrays. A node's place in them is its slot. Whatever acts on the body from outside acts here, one node at
/// a time.
class BoundaryNodes {
 public:
  BoundaryNodes(const Model& model, const std::vector<std::string>& boundaries);

  int size() const { return static_cast<int>(node.size()); }
  int slot_of(int local_node) const;  ///< −1 when the node is not among them

  /// Before the step: keeps u_n, u_n − u_{n−1}, w_n, K u_{n−1} and, where the state has it, a_{n−1}.
  void remember(const NodalState& state, const Vector2* previous_force);

  std::vector<int> node;                ///< local node, ascending
  std::vector<double> mass;             ///< kg/m
  std::vector<Vector2> displacement;    ///< u_n, m
  std::vector<Vector2> past_increment;  ///< u_n − u_{n−1}, m
  std::vector<Vector2> predictor;       ///< w_n, m/s
  std::vector<Vector2> acceleration;    ///< a_{n−1}, m/s²
  std::vector<Vector2> internal;        ///< K u_{n−1}, N/m
  // At t_n, N/m:
  std::vector<Vector2> load, support;
};

/// Tractions on named boundaries as consistent nodal forces.
class Loads {
 public:
  Loads(const Mesh& mesh, const std::vector<BoundaryCondition>& conditions, const BoundaryNodes& nodes);
  bool empty() const { return entries_.empty(); }
  /// The forces at `time`, into `nodes.load` and onto the state. Nodes of a straight side are among them even
  /// where no traction acts, so that their load starts from zero.
  void apply(double time, const StepCoefficients& step, BoundaryNodes& nodes, const NodalState& state) const;

 private:
  struct Entry {
    int slot;
    std::size_t condition;
    Vector2 force;  ///< at full load, N/m
  };
  std::vector<Entry> entries_;  ///< ascending slot
  std::vector<double> ramps_;   ///< by condition, s
};

/// Prescribed displacements: they fix a_n so that u_{n+1} is the prescribed one, and the reaction follows.
class Supports {
 public:
  /// Throws UserError when two boundaries prescribe the same component of a shared node differently.
  /// Collective.
  Supports(MPI_Comm comm, const Mesh& mesh, const std::vector<BoundaryCondition>& conditions,
           const BoundaryNodes& nodes, const Vector2* initial_displacement);
  bool empty() const { return entries_.empty(); }
  bool prescribes(int slot, int axis) const;
  /// Sets the prescribed components of a velocity to that with which every ramp begins, 0.
  void start(const BoundaryNodes& nodes, Vector2* velocity) const;
  /// Imposes ū(next_time); reactions go into `nodes.support`.
  void apply(double next_time, const StepCoefficients& step, BoundaryNodes& nodes,
             const NodalState& state) const;

 private:
  struct Entry {
    int slot, axis;
    std::size_t condition;
    double initial, change;  ///< ū = initial + change · ramp, m
  };
  std::vector<Entry> entries_;
  std::vector<double> ramps_;
};

}  // namespace slipscale
