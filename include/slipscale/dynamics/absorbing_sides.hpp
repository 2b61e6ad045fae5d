#pragma once

#include <vector>

#include "slipscale/contact/contact_nodes.hpp"
#include "slipscale/dynamics/boundary_nodes.hpp"
#include "slipscale/dynamics/model.hpp"
#include "slipscale/dynamics/straight_sides.hpp"

namespace slipscale {

/// Sides through which waves leave the body, as if it went on behind them: dampers on their nodes,
///     traction = −ρ c_d v_n n − ρ c_s v_t
/// with the speeds of plane waves along the normal (J. Lysmer, R. L. Kuhlemeyer, J. Engng Mech. Div. ASCE 95
/// (1969) 859). Waves that arrive along the normal leave whole, others but for a part that grows with the
/// angle; a damper resists no lasting load, so that what presses the side must balance by itself. Beside it
/// the side carries the traction of the uniform initial state (`initial_pressure`, `initial_shear`), along
/// each direction for which no traction is given, so that a body that starts from it stays at rest.
///
/// With lumped mass the dampers are one number for each component of a node, those of two sides that meet at
/// a corner added. The force at t_n is that of v_n, which it changes itself: with v_n = w_n + β2 Δt a_n,
///     (m + β2 Δt C) a_n = other forces − C w_n,
/// so that no step is too long for it. Components that another boundary prescribes have no damper.
class AbsorbingSides {
 public:
  /// Throws UserError for a side that does not face along an axis. Collective.
  AbsorbingSides(MPI_Comm comm, const Model& model, const std::vector<BoundaryCondition>& conditions,
                 const InitialState& initial, const BoundaryNodes& nodes, const Supports& supports,
                 const StraightSides& straight);
  bool empty() const { return !any_; }

  /// Once loads are known: the traction of the initial state into `nodes.load`, and the dampers' answer to
  /// all forces so far.
  void apply(const StepCoefficients& step, BoundaryNodes& nodes, const NodalState& state) const;
  /// Nodes in contact that have dampers resist a push with m + β2 Δt C.
  void resist(const StepCoefficients& step, const BoundaryNodes& nodes, ContactNodes& contact) const;
  /// Once all forces are known: those of the dampers at t_n, into `nodes.absorbed`.
  void measure(const StepCoefficients& step, BoundaryNodes& nodes, const NodalState& state) const;

 private:
  struct Entry {
    int slot;
    Vector2 damper;  ///< C, kg/(m s)
    Vector2 force;   ///< of the initial state, N/m
  };
  std::vector<Entry> entries_;  ///< ascending slot
  bool any_ = false;
};

}  // namespace slipscale
