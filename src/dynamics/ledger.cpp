#include "slipscale/dynamics/ledger.hpp"

#include <cmath>

namespace slipscale {
namespace {

double dot(const Vector2& a, const Vector2& b) { return a[0] * b[0] + a[1] * b[1]; }

}  // namespace

void EnergyLedger::add(const BoundaryNodes& nodes, const ContactNodes& contact, const NodalState& state,
                       double surface_travel) {
  double load[2] = {0, 0}, support[2] = {0, 0};
  for (int k = 0; k < nodes.size(); ++k) {
    const Vector2& u = state.displacement[nodes.node[k]];
    const Vector2 next{u[0] - nodes.displacement[k][0], u[1] - nodes.displacement[k][1]};
    load[0] += dot(nodes.load[k], nodes.past_increment[k]);
    load[1] += dot(nodes.load[k], next);
    support[0] += dot(nodes.support[k], nodes.past_increment[k]);
    support[1] += dot(nodes.support[k], next);
  }
  loads_.add(beta2_, load[0], load[1]);
  supports_.add(beta2_, support[0], support[1]);

  double tangential = 0, heat[2] = {0, 0}, impact[2] = {0, 0};
  for (int k = 0; k < contact.size(); ++k) {
    const int slot = contact.slot[k];
    const Vector2 &u = state.displacement[contact.node[k]], &u_n = nodes.displacement[slot],
                  &past = nodes.past_increment[slot], &force = contact.force[k];
    tangential += force[0];
    heat[0] += force[0] * (past_travel_ - past[0]);
    heat[1] += force[0] * (surface_travel - (u[0] - u_n[0]));
    impact[0] -= force[1] * past[1];
    impact[1] -= force[1] * (u[1] - u_n[1]);
  }
  drive_.add(beta2_, tangential * past_travel_, tangential * surface_travel);
  heat_.add(beta2_, heat[0], heat[1]);
  impact_.add(beta2_, impact[0], impact[1]);
  past_travel_ = surface_travel;
}

void EnergyLedger::add_bulk(BulkSums sums, const BulkPhysics& physics, const Damping& damping,
                            const StepCoefficients& step, const BoundaryNodes& nodes,
                            const ContactNodes& contact, const NodalState& state, const Vector2* force,
                            bool first) {
  std::vector<Vector2>& total = scratch_;
  total.resize(static_cast<std::size_t>(nodes.size()));
  for (int k = 0; k < nodes.size(); ++k)
    total[k] = {nodes.load[k][0] + nodes.support[k][0], nodes.load[k][1] + nodes.support[k][1]};
  for (int k = 0; k < contact.size(); ++k)
    for (int axis = 0; axis < 2; ++axis) total[contact.slot[k]][axis] += contact.force[k][axis];

  for (int k = 0; k < nodes.size(); ++k) {
    const int i = nodes.node[k];
    for (int axis = 0; axis < 2; ++axis) {
      const double pushed = total[k][axis] / nodes.mass[k];
      const double damper = -damping.stiffness / step.time_step * (force[i][axis] - nodes.internal[k][axis]) -
                            damping.mass * nodes.mass[k] * nodes.predictor[k][axis];
      sums.damping_next += damper * step.displacement * pushed;
      if (physics.numerical_dissipation)
        sums.increment_inertia +=
            total[k][axis] * (2 * state.acceleration[i][axis] - pushed - 2 * nodes.acceleration[k][axis]);
    }
  }
  if (first) sums.increment_force = sums.increment_inertia = sums.damping_past = 0;
  if (physics.mass_damping || physics.stiffness_damping)
    damping_.add(beta2_, -sums.damping_past, -sums.damping_next);
  if (physics.numerical_dissipation)
    scheme_ += (beta2_ - 0.5) *
               (sums.increment_force - 0.5 * beta2_ * time_step_ * time_step_ * sums.increment_inertia);
}

void EnergyLedger::add_plates(const StraightSides& sides) {
  StraightSide::Inertia sum;
  for (const auto& side : sides) {
    sum.past += side->inertia().past;
    sum.next += side->inertia().next;
    sum.change += side->inertia().change;
  }
  plates_.add(beta2_, sum.past, sum.next);
  scheme_ -= (beta2_ - 0.5) * 0.5 * beta2_ * time_step_ * time_step_ * sum.change;
}

Energy EnergyLedger::works() const {
  Energy energy;
  energy.loads = loads_.done() + plates_.done();
  energy.supports = supports_.done();
  energy.surface_drive = drive_.done();
  energy.friction_heat = heat_.done();
  energy.impact_loss = impact_.done();
  energy.damping = damping_.done();
  energy.scheme_dissipation = scheme_;
  return energy;
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
