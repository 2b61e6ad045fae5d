#pragma once

#include "slipscale/contact/contact_nodes.hpp"
#include "slipscale/dynamics/boundary_nodes.hpp"
#include "slipscale/dynamics/bulk.hpp"
#include "slipscale/dynamics/scheme.hpp"

namespace slipscale {

/// Everything the energy of the body is made of and where it went since t = 0, J per metre of depth.
struct Energy {
  double kinetic = 0;             ///< ½vᵀMv − (Δt²β2/4) aᵀMa
  double strain = 0;              ///< ½uᵀKu
  double loads = 0;               ///< work of the tractions
  double supports = 0;            ///< work of the prescribed displacements
  double body_force = 0;          ///< work of gravity
  double surface_drive = 0;       ///< work of the motor that drives the surface, ∫ τV
  double friction_heat = 0;       ///< ∫ τ(V − u̇_x) ≥ 0
  double impact_loss = 0;         ///< lost where nodes meet the surface
  double damping = 0;             ///< lost to bulk damping
  double scheme_dissipation = 0;  ///< lost to the time scheme, β2 > ½
  double residual = 0;            ///< what the balance misses: rounding
  double flowed = 0;              ///< sum of the sizes of all the terms: the scale of the residual
};

/// Work Σ Δuᵀ[(1 − β2) f_n + β2 f_{n+1}] of one kind of force; the part that waits for f_{n+1} is kept apart.
class Work {
 public:
  /// With f_n at hand: `past` = f_n · (u_n − u_{n−1}), `next` = f_n · (u_{n+1} − u_n), J/m.
  void add(double beta2, double past, double next) {
    done_ += waiting_ + beta2 * past;
    waiting_ = (1 - beta2) * next;
  }
  double done() const { return done_; }

 private:
  double done_ = 0, waiting_ = 0;
};

/// The exact discrete energy balance of the β2 scheme: with Δ = new − old and f all forces but −Ku,
///     Ê = ½vᵀMv + ½uᵀKu − (Δt²β2/4) aᵀMa,
///     ΔÊ = Δuᵀ[(1−β2) f_n + β2 f_{n+1}] − (β2−½)[ΔuᵀKΔu − (Δt²β2/2) ΔaᵀMΔa].
/// Works are summed every step over this rank's boundary nodes; sums over ranks are taken when a row asks for
/// them.
class EnergyLedger {
 public:
  EnergyLedger(double beta2, double time_step) : beta2_(beta2), time_step_(time_step) {}

  /// Closes the step n−1 → n and opens n → n+1, when all forces at t_n and u_{n+1} are known.
  /// `surface_travel` is the surface's path over the coming step, m.
  void add(const BoundaryNodes& nodes, const ContactNodes& contact, const NodalState& state,
           double surface_travel);

  /// The same for the bulk terms; `sums` are those of free motion and are corrected here for what the
  /// boundary forces changed. `first`: there is no step to close yet.
  void add_bulk(BulkSums sums, const BulkPhysics& physics, const Damping& damping,
                const StepCoefficients& step, const BoundaryNodes& nodes, const ContactNodes& contact,
                const NodalState& state, const Vector2* force, bool first);

  /// This rank's works; kinetic, strain and body force are left to the caller.
  Energy works() const;

 private:
  double beta2_, time_step_;
  Work loads_, supports_, drive_, heat_, impact_, damping_;
  double scheme_ = 0;
  double past_travel_ = 0;
  std::vector<Vector2> scratch_;  ///< all boundary forces by slot; kept so that a step allocates nothing
};

/// Fills `residual` from the other terms and adds the sizes of all but the kinetic one to `flowed`; `start`
/// is Ê at t = 0.
void close_balance(Energy& energy, double start);

}  // namespace slipscale
