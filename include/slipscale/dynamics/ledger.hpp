#pragma once

#include <array>
#include <span>
#include <vector>

#include "slipscale/base/large_array.hpp"
#include "slipscale/base/state_group.hpp"
#include "slipscale/contact/contact_nodes.hpp"
#include "slipscale/dynamics/boundary_nodes.hpp"
#include "slipscale/dynamics/bulk.hpp"
#include "slipscale/dynamics/scheme.hpp"
#include "slipscale/dynamics/straight_sides.hpp"

namespace slipscale {

/// Everything the energy of the body is made of and where it went since t = 0, J per metre of depth.
struct Energy {
  double kinetic = 0;             ///< ½vᵀMv − (Δt²β2/4) aᵀMa
  double strain = 0;              ///< ½uᵀKu
  double loads = 0;               ///< work of the tractions and of the forces on straight sides
  double supports = 0;            ///< work of the prescribed displacements
  double body_force = 0;          ///< work of gravity
  double surface_drive = 0;       ///< work of the motor that drives the surface, ∫ τV
  double friction_heat = 0;       ///< ∫ τ(V − u̇_x), see below
  double impact_loss = 0;         ///< lost where nodes meet the surface
  double damping = 0;             ///< lost to bulk damping
  double radiated = 0;            ///< taken by absorbing sides
  double scheme_dissipation = 0;  ///< lost to the time scheme, β2 > ½
  double residual = 0;            ///< what the balance misses: rounding
  double flowed = 0;              ///< sum of the sizes of all the terms: the scale of the residual
};

/// One term of the balance: what files, summary and the balance itself call it, in their order.
struct EnergyTerm {
  enum class Role { stored, supplied, lost, check };
  const char* name;
  double Energy::*value;
  Role role;
  const char* description;
};

inline constexpr std::array<EnergyTerm, 13> energy_terms{{
    {"kinetic", &Energy::kinetic, EnergyTerm::Role::stored, "kinetic energy, with the scheme's correction"},
    {"strain", &Energy::strain, EnergyTerm::Role::stored, "strain energy"},
    {"loads", &Energy::loads, EnergyTerm::Role::supplied, "work of the tractions and forces since t = 0"},
    {"supports", &Energy::supports, EnergyTerm::Role::supplied,
     "work of the prescribed displacements since t = 0"},
    {"body_force", &Energy::body_force, EnergyTerm::Role::supplied,
     "work of the body acceleration since t = 0"},
    {"surface_drive", &Energy::surface_drive, EnergyTerm::Role::supplied,
     "work of the motor that drives the surface since t = 0"},
    {"friction_heat", &Energy::friction_heat, EnergyTerm::Role::lost, "heat of friction since t = 0"},
    {"impact_loss", &Energy::impact_loss, EnergyTerm::Role::lost,
     "energy lost where nodes met the surface since t = 0"},
    {"damping", &Energy::damping, EnergyTerm::Role::lost, "energy lost to bulk damping since t = 0"},
    {"radiated", &Energy::radiated, EnergyTerm::Role::lost,
     "energy that left through absorbing sides since t = 0"},
    {"scheme_dissipation", &Energy::scheme_dissipation, EnergyTerm::Role::lost,
     "energy lost to the time scheme since t = 0"},
    {"residual", &Energy::residual, EnergyTerm::Role::check, "what the balance misses"},
    {"flowed", &Energy::flowed, EnergyTerm::Role::check,
     "sum of the sizes of all terms, the scale of the residual"},
}};
static_assert(sizeof(Energy) == energy_terms.size() * sizeof(double), "every term has its line");

/// Work Σ Δuᵀ[(1 − β2) f_n + β2 f_{n+1}] of one kind of force at each of a number of nodes; the part that
/// waits for f_{n+1} is kept apart.
struct NodalWork {
  std::vector<double> done, waiting;  ///< J/m

  explicit NodalWork(int nodes = 0) : done(nodes, 0), waiting(nodes, 0) {}
  /// With f_n at hand: `past` = f_n · (u_n − u_{n−1}), `next` = f_n · (u_{n+1} − u_n), J/m.
  void add(int node, double beta2, double past, double next) {
    done[node] += waiting[node] + beta2 * past;
    waiting[node] = (1 - beta2) * next;
  }
};

/// The exact discrete energy balance of the β2 scheme: with Δ = new − old and f all forces but −Ku,
///     Ê = ½vᵀMv + ½uᵀKu − (Δt²β2/4) aᵀMa,
///     ΔÊ = Δuᵀ[(1−β2) f_n + β2 f_{n+1}] − (β2−½)[ΔuᵀKΔu − (Δt²β2/2) ΔaᵀMΔa].
/// So each force works along the step before it with weight β2 and along the step after it with 1 − β2. What
/// holds for the friction of one step, τ_n (V Δt − Δu_x) ≥ 0, holds for the step after t_n, which is the one
/// that the law sees; along the step before it the node may have moved the other way. The heat of a whole run
/// is therefore positive, a single row may fall below the one before by the order of one step.
/// Works are kept by node, so that none of their bits depends on the number of ranks; sums are taken when a
/// row asks for them.
class EnergyLedger {
 public:
  /// Of a scene without boundary nodes and contact, until `start` tells what there is.
  EnergyLedger(double beta2, double time_step) : beta2_(beta2), time_step_(time_step) {}
  void start(const BulkPhysics& physics, int owned_nodes, int boundary_nodes, int contact_nodes, int plates,
             bool lifts, bool absorbs);

  /// Closes the step n−1 → n and opens n → n+1, when all forces at t_n and u_{n+1} are known.
  /// `surface_travel` is the surface's path over the coming step, m.
  void add(const BoundaryNodes& nodes, const ContactNodes& contact, const NodalState& state,
           double surface_travel);

  /// Where the free motion of the step keeps what the bulk loses, and how it counts. `first`: there is no
  /// step to close yet.
  BulkLosses bulk_losses();
  LossWeights weights(bool first) const;
  /// Corrects what free motion found for the forces at the boundary nodes.
  void correct_bulk(const BulkPhysics& physics, const Damping& damping, const StepCoefficients& step,
                    const BoundaryNodes& nodes, const ContactNodes& contact, const NodalState& state,
                    const Vector2* force, bool first);

  /// Where the surface moves up and down: its work on the body is the motor's, and no loss at the nodes.
  void add_lift(const ContactNodes& contact);

  /// What the dampers of absorbing sides have taken.
  void add_absorbed(const BoundaryNodes& nodes, const NodalState& state);

  /// The same for the mass of the plates on straight sides, which are part of what moves: their pushes on the
  /// nodes are among the loads, and with their own inertia the loads become the forces on the plates.
  void add_plates(const StraightSides& sides);

  /// What this rank adds to the works of an observed step: to an energy the sum of a list.
  struct Term {
    double Energy::*energy;
    std::span<const double> list;
  };
  std::vector<Term> works() const;
  /// Of a contact node: friction heat and impact loss, of which sums are the energies of those names, J/m.
  std::array<double, 2> contact_losses(int k) const {
    return {heat_.done[k], lifts_ ? impact_.done[k] + lift_.done[k] : impact_.done[k]};
  }

  /// Adds what later steps and rows need of the steps so far to the groups of those names, and a group for
  /// each plate, on the rank that answers for it.
  void add_state(StateGroup& nodes, StateGroup& boundary_nodes, StateGroup& contact_nodes);
  std::vector<StateGroup> plates_state(const StraightSides& sides);
  /// After the arrays were filled in. `surface_travel`: over the last step made, m.
  void resume(double surface_travel) { past_travel_ = surface_travel; }

 private:
  double beta2_, time_step_;
  BulkPhysics physics_;
  bool lifts_ = false, absorbs_ = false;           ///< of the scene, the same on all ranks
  NodalWork loads_, supports_;                     ///< by slot
  NodalWork drive_, heat_, impact_;                ///< by contact node
  NodalWork lift_;                                 ///< the same; empty where the surface does not lift
  NodalWork radiated_;                             ///< by slot; empty where no side absorbs
  NodalWork plates_;                               ///< by side, on the rank that answers for it
  LargeArray<Vector2> damping_, coming_, scheme_;  ///< by owned node, see BulkLosses
  mutable std::vector<double> bulk_done_;  ///< their sums by node; kept so that a row allocates little
  std::vector<double> plates_scheme_;      ///< by side
  double past_travel_ = 0;
  std::vector<Vector2> scratch_;  ///< all boundary forces by slot; kept so that a step allocates nothing
};

/// Fills `residual` from the other terms and adds the sizes of all but the kinetic one to `flowed`; `start`
/// is Ê at t = 0.
void close_balance(Energy& energy, double start);

}  // namespace slipscale
