#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "slipscale/base/state_group.hpp"
#include "slipscale/contact/contact_nodes.hpp"
#include "slipscale/contact/contact_sums.hpp"
#include "slipscale/dynamics/absorbing_sides.hpp"
#include "slipscale/dynamics/boundary_nodes.hpp"
#include "slipscale/dynamics/cell_damping.hpp"
#include "slipscale/dynamics/ledger.hpp"
#include "slipscale/dynamics/scene.hpp"
#include "slipscale/dynamics/straight_sides.hpp"

namespace slipscale {

/// What a body carries at one time, per metre of depth. Angular momentum is that of linear elasticity, Σ m x
/// × v with the undeformed place x of each node, which forces inside the body leave unchanged to rounding; it
/// means nothing on a periodic mesh.
struct Momentum {
  double mass = 0;     ///< kg/m
  Vector2 linear{};    ///< Σ m v, kg/s
  double angular = 0;  ///< about the middle of the block, counter-clockwise, kg m/s
};

/// What has happened at a contact node from t = 0 to t_n, over every step; by its tributary length.
struct ContactTotals {
  double friction_work = 0;  ///< J/m², as the ledger's friction heat
  double impact_loss = 0;    ///< J/m², as the ledger's
  double slip = 0;           ///< m, see ContactSums
  double pressure_slip = 0;  ///< Pa m
  double time_closed = 0;    ///< s
  double impulse = 0;        ///< Pa s, normal
  double closures = 0;
};

/// What is looked at of a step once it is made.
enum class Observed {
  nothing,
  boundary,   ///< u_n and v_n at the boundary nodes
  everything  ///< u_n, v_n, a_n, K u_n and the energies of the whole body
};

/// A deformable body that moves in explicit time, pressed on a rigid surface that slides under it.
///
/// `advance` goes from t_n to t_{n+1}. Afterwards u is u_{n+1} while all forces, tractions and works are
/// those at t_n. For a step that is observed, u_n is kept, and v_n and a_n are made.
class SlidingBody {
 public:
  /// Throws UserError for contradictory conditions and a body that starts below the surface. Collective.
  SlidingBody(MPI_Comm comm, const Model& model, const Scene& scene, double time_step);

  /// One step. One halo exchange, no allocation, and no other communication but for one
  /// small gather for each side that is kept straight.
  void advance(Observed observed);
  void advance(bool observed) { advance(observed ? Observed::everything : Observed::nothing); }

  long steps_done() const { return step_; }
  double time_step() const { return time_step_; }
  /// Time of the state that the last `advance` left: t_n, s.
  double time() const { return static_cast<double>(step_ - 1) * time_step_; }

  const Model& model() const { return model_; }
  const Scene& scene() const { return scene_; }
  MPI_Comm comm() const { return comm_; }

  /// Before the first step, or before a restart fills in what `state` lists: keeps sums over every step at
  /// the contact nodes; the damping work of each cell, where bulk damping is on. The second is collective.
  void keep_contact_sums() { sums_.start(contact_.size()); }
  void keep_cell_damping();

  // Of an observed step:
  const Vector2* displacement_n() const { return kept_.data(); }  ///< u_n, all local nodes, m
  const Vector2* velocity_n() const { return v_.data(); }         ///< v_n, owned nodes, m/s
  const Vector2* acceleration_n() const { return a_.data(); }     ///< a_n, owned nodes, m/s²
  // Of every step:
  /// K u_n, N/m; at the boundary nodes, and of an observed step at all owned nodes.
  const Vector2* internal_force_n() const { return force_.data(); }
  /// u_{n+1}, m; owned nodes only: the exchange that brings the ghosts is under way until the next step.
  const Vector2* next_displacement() const { return u_.data(); }
  const Vector2* next_predictor() const { return w_.data(); }        ///< w_{n+1}, owned nodes, m/s
  const ContactNodes& contact() const { return contact_; }           ///< at t_n
  const BoundaryNodes& boundary_nodes() const { return boundary_; }  ///< at t_n
  /// The boundaries whose nodes are the boundary nodes: with a condition, at the surface, measured; sorted.
  const std::vector<std::string>& boundary_names() const { return boundary_names_; }
  double surface_velocity() const;  ///< V at t_n, m/s
  /// Of the contact nodes: where each stands among the regions; what its sums are at t_n, where they are
  /// kept.
  const std::vector<ContactPlace>& contact_places() const { return contact_places_; }
  bool keeps_contact_sums() const { return sums_.kept(); }
  ContactTotals contact_totals(int k) const;
  /// Work of bulk damping over volume at t_n in each local cell that this rank owns, J/m³; see CellDamping.
  /// Only where it is kept. Collective.
  bool keeps_cell_damping() const { return cell_damping_ != nullptr; }
  void cell_damping(std::vector<double>& of_cells) const { cell_damping_->density(of_cells); }
  double surface_travel() const { return surface_travel_; }  ///< over the step just made, m

  /// Force of the body on its support at an owned node of a boundary, −(K u_n + stiffness damping), N/m.
  Vector2 force_on_support(int slot) const;

  const StraightSides& straight_sides() const { return *straight_; }  ///< at t_n

  /// The energy balance at t_n of an observed step, the same bits on any number of ranks. Collective.
  Energy energy() const;
  /// Mass and momenta at t_n of an observed step, without plates; the same bits on any number of ranks.
  /// Collective.
  Momentum momentum() const;
  /// Everything that the steps so far left behind, for a checkpoint to keep: the arrays are the body's own.
  /// When those of a body made anew are filled in and `resume` is called, it goes on with the same bits.
  /// Collective.
  std::vector<StateGroup> state();
  void resume();

  /// Body acceleration at t_n at an owned node, m/s².
  Vector2 body_acceleration(int node) const { return body_acceleration_.at(node); }
  /// False once a formula of time has made what is no number, or not one in its option's range. Collective.
  bool formulas_sound() const;

  /// Whether any contact node was closed at any step so far. Collective.
  bool has_touched() const;

 private:
  void free_motion(const StepCoefficients& step, Observed observed);
  void free_acceleration_at_boundary();
  void remember(Observed observed, const NodalState& moving);
  void touch_surface(bool first, const StepCoefficients& step, const NodalState& moving);
  void add_to_ledger(bool first, const StepCoefficients& step, const NodalState& moving);
  void observe_nodes(const StepCoefficients& step, int begin, int end);
  void observe_boundary(const StepCoefficients& step, Observed observed);

  void start_force();
  void set_past(NodalVector& past) const;
  void set_contact_nodes();
  bool lifts() const;                          ///< the surface moves up and down
  double clearance(int k, double time) const;  ///< of contact node k undeformed, m
  double gravity_work(int node, const Vector2& displacement) const;
  using BulkTerms = std::array<std::span<const double>, 4>;
  std::size_t moving_things() const;
  BulkTerms bulk_terms() const;
  std::int64_t largest_count() const;
  NodalState state(bool with_acceleration) const;

  MPI_Comm comm_;
  const Model& model_;
  const Scene scene_;
  const double time_step_;
  NodalVector u_, w_, v_, a_;
  LargeArray<Vector2> force_, previous_force_, kept_;
  LargeArray<Vector2>
      passing_;  ///< forces that only the free motion of their node asks for, see PairStiffness
  LargeArray<double> inverse_mass_;
  const std::vector<std::string> boundary_names_;
  BoundaryNodes boundary_;
  Loads loads_;
  std::unique_ptr<Supports> supports_;  ///< made once the initial displacement is known
  std::unique_ptr<StraightSides> straight_;
  std::unique_ptr<AbsorbingSides> absorbing_;
  ContactNodes contact_;
  std::vector<ContactPlace> contact_places_;   ///< of the contact nodes
  ContactSums sums_;                           ///< of no nodes where nobody asks
  std::unique_ptr<CellDamping> cell_damping_;  ///< null where nobody asks
  FrictionLaws law_;
  FrictionLaws start_law_;  ///< at t = 0, where no time has passed since the memory
  BodyAcceleration body_acceleration_;
  const bool formulas_of_time_;  ///< whether there may be any
  BulkPhysics physics_;
  EnergyLedger ledger_;
  double start_gravity_ = 0;          ///< Σ m g·u_0 of all ranks, J/m
  double start_energy_ = 0;           ///< Ê at t = 0 of all ranks, J/m
  mutable LargeArray<double> terms_;  ///< of sums over nodes; kept so that a row allocates nothing large
  double surface_travel_ = 0;
  bool sound_ = true;  ///< formulas, apart from those of loads and supports
  long step_ = 0;
  /// The run as a whole, for a checkpoint.
  struct Carried {
    double steps, surface_travel, start_gravity, start_energy, touched;
  } carried_{};
  std::vector<Vector2> carried_force_;  ///< K u_n at the boundary nodes, where the bulk does not need it
};

}  // namespace slipscale
