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
  std::vector<Vector2> absorbed;  ///< by dampers; empty where no side absorbs

  /// v_n that the forces so far make: w_n + velocity a_n, with a_n from where they have moved the node, m/s.
  double velocity(int slot, int axis, const StepCoefficients& step, const NodalState& state) const {
    const double w = predictor[slot][axis];
    const double moved = state.displacement[node[slot]][axis] - displacement[slot][axis];
    return w + step.velocity / step.displacement * (moved - step.time_step * w);
  }
};

/// Tractions on named boundaries as consistent nodal forces.
class Loads {
 public:
  Loads(const Mesh& mesh, const std::vector<BoundaryCondition>& conditions, const BoundaryNodes& nodes);
  bool empty() const { return entries_.empty(); }
  /// False once a formula of time has made what is no number.
  bool sound() const { return sound_; }
  /// The forces at `time`, into `nodes.load` and onto the state. Nodes of a straight side are among them even
  /// where no traction acts, so that their load starts from zero.
  void apply(double time, const StepCoefficients& step, BoundaryNodes& nodes, const NodalState& state) const;

 private:
  struct Entry {
    int slot;
    std::size_t condition;
    Vector2 force;  ///< at full load, N/m
  };
  /// A traction that follows a formula of time: its values at a number of places make the forces.
  struct Varying {
    std::size_t condition;
    SharedFormula formula;
    std::vector<Vector2> places;  ///< one where the formula is of time alone
    struct Share {
      int slot, place;
      Vector2 force;  ///< of a value of 1 Pa there, N/m
    };
    std::vector<Share> shares;
    mutable std::vector<double> values;  ///< at the places; kept so that a step allocates nothing
  };
  void add_formula(const Mesh& mesh, const Boundary& boundary, std::size_t condition,
                   const Quantity& traction, bool normal, std::vector<Entry>& own,
                   const BoundaryNodes& nodes);
  void apply_varying(double time, const StepCoefficients& step, BoundaryNodes& nodes,
                     const NodalState& state) const;

  std::vector<Entry> entries_;  ///< ascending slot
  std::vector<Varying> varying_;
  std::vector<double> ramps_;  ///< by condition, s
  mutable bool sound_ = true;
};

/// Prescribed displacements: they fix a_n so that u_{n+1} is the prescribed one, and the reaction follows.
class Supports {
 public:
  /// Throws UserError when two boundaries prescribe the same component of a shared node differently.
  /// Collective.
  Supports(MPI_Comm comm, const Mesh& mesh, const std::vector<BoundaryCondition>& conditions,
           const BoundaryNodes& nodes, const Vector2* initial_displacement);
  bool empty() const { return entries_.empty() && varying_.empty(); }
  bool sound() const { return sound_; }  ///< as of Loads
  bool prescribes(int slot, int axis) const;
  /// Sets the prescribed components of a velocity to that with which every ramp begins, 0, and those that
  /// follow a formula of time to its derivative at t = 0.
  void start(const BoundaryNodes& nodes, double time_step, Vector2* velocity) const;
  /// The second of that alone: what a formula prescribes from the start does not begin with a blow.
  void start_formulas(const BoundaryNodes& nodes, double time_step, Vector2* velocity) const;
  /// Imposes ū(next_time); reactions go into `nodes.support`.
  void apply(double next_time, const StepCoefficients& step, BoundaryNodes& nodes,
             const NodalState& state) const;

 private:
  struct Entry {
    int slot, axis;
    std::size_t condition;
    double initial, change;  ///< ū = initial + change · ramp, m
  };
  /// A component that follows a formula of time.
  struct Varying {
    std::size_t condition;
    int axis;
    SharedFormula formula;
    struct Member {
      int slot;
      double initial;  ///< m
      Vector2 place;
    };
    std::vector<Member> members;
  };
  std::vector<Entry> entries_;
  std::vector<Varying> varying_;
  std::vector<double> ramps_;
  mutable bool sound_ = true;
};

}  // namespace slipscale
