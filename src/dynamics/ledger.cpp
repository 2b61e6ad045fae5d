#include "slipscale/dynamics/ledger.hpp"

#include <cmath>

namespace slipscale {
namespace {

double dot(const Vector2& a, const Vector2& b) { return a[0] * b[0] + a[1] * b[1]; }

double* numbers(LargeArray<Vector2>& rows) { return rows.empty() ? nullptr : rows[0].data(); }

void add_work(StateGroup& group, const std::string& name, const std::string& text, NodalWork& work) {
  group.arrays.push_back({name, "J/m", text + " since t = 0", 1, work.done.data()});
  group.arrays.push_back(
      {name + "_waiting", "J/m", text + " along the coming step, (1 - beta2) of it", 1, work.waiting.data()});
}

}  // namespace

void EnergyLedger::start(const BulkPhysics& physics, int owned_nodes, int boundary_nodes, int contact_nodes,
                         int plates, bool lifts, bool absorbs) {
  physics_ = physics;
  loads_ = supports_ = NodalWork(boundary_nodes);
  drive_ = heat_ = impact_ = NodalWork(contact_nodes);
  lifts_ = lifts, absorbs_ = absorbs;
  if (lifts) lift_ = NodalWork(contact_nodes);
  if (absorbs) radiated_ = NodalWork(boundary_nodes);
  plates_ = NodalWork(plates);
  plates_scheme_.assign(plates, 0);
  if (physics.mass_damping || physics.stiffness_damping) {
    damping_.assign(owned_nodes, {0, 0});
    coming_.assign(owned_nodes, {0, 0});
  }
  if (physics.numerical_dissipation) scheme_.assign(owned_nodes, {0, 0});
}

void EnergyLedger::add(const BoundaryNodes& nodes, const ContactNodes& contact, const NodalState& state,
                       double surface_travel) {
  for (int k = 0; k < nodes.size(); ++k) {
    const Vector2& u = state.displacement[nodes.node[k]];
    const Vector2 next{u[0] - nodes.displacement[k][0], u[1] - nodes.displacement[k][1]};
    loads_.add(k, beta2_, dot(nodes.load[k], nodes.past_increment[k]), dot(nodes.load[k], next));
    supports_.add(k, beta2_, dot(nodes.support[k], nodes.past_increment[k]), dot(nodes.support[k], next));
  }
  for (int k = 0; k < contact.size(); ++k) {
    const int slot = contact.slot[k];
    const Vector2 &u = state.displacement[contact.node[k]], &u_n = nodes.displacement[slot],
                  &past = nodes.past_increment[slot], &force = contact.force[k];
    drive_.add(k, beta2_, force[0] * past_travel_, force[0] * surface_travel);
    heat_.add(k, beta2_, force[0] * (past_travel_ - past[0]), force[0] * (surface_travel - (u[0] - u_n[0])));
    impact_.add(k, beta2_, -force[1] * past[1], -force[1] * (u[1] - u_n[1]));
  }
  past_travel_ = surface_travel;
}

BulkLosses EnergyLedger::bulk_losses() { return {damping_.data(), coming_.data(), scheme_.data()}; }

LossWeights EnergyLedger::weights(bool first) const {
  const double dissipation = beta2_ - 0.5;
  if (first) return {0, 1 - beta2_, 0, 0};
  return {beta2_, 1 - beta2_, dissipation, -0.5 * dissipation * beta2_ * time_step_ * time_step_};
}

void EnergyLedger::correct_bulk(const BulkPhysics& physics, const Damping& damping,
                                const StepCoefficients& step, const BoundaryNodes& nodes,
                                const ContactNodes& contact, const NodalState& state, const Vector2* force,
                                bool first) {
  std::vector<Vector2>& total = scratch_;
  total.resize(static_cast<std::size_t>(nodes.size()));
  for (int k = 0; k < nodes.size(); ++k)
    total[k] = {nodes.load[k][0] + nodes.support[k][0], nodes.load[k][1] + nodes.support[k][1]};
  for (int k = 0; k < contact.size(); ++k)
    for (int axis = 0; axis < 2; ++axis) total[contact.slot[k]][axis] += contact.force[k][axis];
  for (std::size_t k = 0; k < nodes.absorbed.size(); ++k)
    for (int axis = 0; axis < 2; ++axis) total[k][axis] += nodes.absorbed[k][axis];

  const LossWeights weight = weights(first);
  const bool damped = physics.mass_damping || physics.stiffness_damping;
  for (int k = 0; k < nodes.size(); ++k) {
    const int i = nodes.node[k];
    for (int axis = 0; axis < 2; ++axis) {
      const double pushed = total[k][axis] / nodes.mass[k];
      const double damper = damping.stiffness / step.time_step * (force[i][axis] - nodes.internal[k][axis]) +
                            damping.mass * nodes.mass[k] * nodes.predictor[k][axis];
      if (damped) {
        const double next = weight.next * damper * step.displacement * pushed;
        damping_[i][axis] += next;
        coming_[i][axis] += next;
      }
      if (physics.numerical_dissipation)
        scheme_[i][axis] += weight.inertia * total[k][axis] *
                            (2 * state.acceleration[i][axis] - pushed - 2 * nodes.acceleration[k][axis]);
    }
  }
}

void EnergyLedger::add_lift(const ContactNodes& contact) {
  for (int k = 0; k < contact.size(); ++k)
    lift_.add(k, beta2_, contact.force[k][1] * contact.past_rise[k], contact.force[k][1] * contact.rise[k]);
}

void EnergyLedger::add_absorbed(const BoundaryNodes& nodes, const NodalState& state) {
  for (int k = 0; k < nodes.size(); ++k) {
    const Vector2& u = state.displacement[nodes.node[k]];
    const Vector2 next{u[0] - nodes.displacement[k][0], u[1] - nodes.displacement[k][1]};
    radiated_.add(k, beta2_, -dot(nodes.absorbed[k], nodes.past_increment[k]), -dot(nodes.absorbed[k], next));
  }
}

void EnergyLedger::add_plates(const StraightSides& sides) {
  int k = 0;
  for (const auto& side : sides) {
    const StraightSide::Inertia& inertia = side->inertia();
    plates_.add(k, beta2_, inertia.past, inertia.next);
    plates_scheme_[k] -= (beta2_ - 0.5) * 0.5 * beta2_ * time_step_ * time_step_ * inertia.change;
    ++k;
  }
}

std::vector<EnergyLedger::Term> EnergyLedger::works() const {
  bulk_done_.resize(damping_.size() + scheme_.size());
  const std::span done(bulk_done_);
  const auto damping = done.first(damping_.size()), scheme = done.last(scheme_.size());
  for (std::size_t i = 0; i < damping.size(); ++i)
    damping[i] = (damping_[i][0] - coming_[i][0]) + (damping_[i][1] - coming_[i][1]);
  for (std::size_t i = 0; i < scheme.size(); ++i) scheme[i] = scheme_[i][0] + scheme_[i][1];
  std::vector<Term> terms{{&Energy::loads, loads_.done},
                          {&Energy::loads, plates_.done},
                          {&Energy::supports, supports_.done},
                          {&Energy::surface_drive, drive_.done},
                          {&Energy::friction_heat, heat_.done},
                          {&Energy::impact_loss, impact_.done},
                          {&Energy::damping, damping},
                          {&Energy::scheme_dissipation, scheme},
                          {&Energy::scheme_dissipation, plates_scheme_}};
  if (lifts_) {
    terms.push_back({&Energy::surface_drive, lift_.done});
    terms.push_back({&Energy::impact_loss, lift_.done});
  }
  if (absorbs_) terms.push_back({&Energy::radiated, radiated_.done});
  return terms;
}

void EnergyLedger::add_state(StateGroup& nodes, StateGroup& boundary_nodes, StateGroup& contact_nodes) {
  if (physics_.mass_damping || physics_.stiffness_damping)
    nodes.arrays.push_back({"damping", "J/m", "lost to bulk damping, of the coming step (1 - beta2) included",
                            2, numbers(damping_)});
  if (physics_.numerical_dissipation)
    nodes.arrays.push_back({"scheme_dissipation", "J/m", "lost to the time scheme", 2, numbers(scheme_)});
  add_work(boundary_nodes, "loads", "work of the tractions and plates", loads_);
  add_work(boundary_nodes, "supports", "work of the prescribed displacements", supports_);
  if (absorbs_) add_work(boundary_nodes, "radiated", "taken by absorbing sides", radiated_);
  add_work(contact_nodes, "surface_drive", "work of the motor that drives the surface", drive_);
  add_work(contact_nodes, "friction_heat", "heat of friction", heat_);
  add_work(contact_nodes, "impact_loss", "energy lost where the node met the surface", impact_);
  if (lifts_) add_work(contact_nodes, "lift", "work of the surface that moves up and down", lift_);
}

std::vector<StateGroup> EnergyLedger::plates_state(const StraightSides& sides) {
  std::vector<StateGroup> groups;
  std::size_t k = 0;
  for (const auto& side : sides) {
    StateGroup group{"plate_" + side->boundary() + "_energy", {}, 0, side->answers_for_plate(), {}};
    if (side->answers_for_plate()) group.keys = {0};
    group.arrays = {
        {"work", "J/m", "of the plate's inertia since t = 0", 1, &plates_.done[k]},
        {"work_waiting", "J/m", "along the coming step, (1 - beta2) of it", 1, &plates_.waiting[k]},
        {"scheme_dissipation", "J/m", "lost to the time scheme", 1, &plates_scheme_[k]}};
    groups.push_back(std::move(group));
    ++k;
  }
  return groups;
}

void close_balance(Energy& e, double start) {
  double supplied = 0, lost = 0, sizes = std::abs(e.strain) + std::abs(start);
  for (const EnergyTerm& term : energy_terms) {
    const double value = e.*term.value;
    if (term.role == EnergyTerm::Role::supplied) supplied += value, sizes += std::abs(value);
    if (term.role == EnergyTerm::Role::lost) lost += value, sizes += std::abs(value);
  }
  e.residual = e.kinetic + e.strain - start - supplied + lost;
  e.flowed += sizes;
}

}  // namespace slipscale
