// What is looked at of a body: velocities, forces on supports, energies, momenta.
#include "slipscale/base/log.hpp"
#include "slipscale/base/order_free_sum.hpp"
#include "slipscale/dynamics/sliding_body.hpp"

namespace slipscale {

/// The velocity at t_n of owned nodes, and the terms of the energies, J/m: ½vᵀMv, the scheme's correction of
/// it (Δt²β2/4) aᵀMa, ½uᵀKu, the work of gravity.
void SlidingBody::observe_nodes(const StepCoefficients& step, int begin, int end) {
  const std::size_t moving = moving_things();
  double *const kinetic = terms_.data(), *const correction = kinetic + moving,
                *const strain = correction + moving, *const gravity = strain + model_.mass.size();
  const SeenNodes seen{w_.data() + begin,     a_.data() + begin,   kept_.data() + begin,
                       force_.data() + begin, &model_.mass[begin], v_.data() + begin,
                       kinetic + begin,       correction + begin,  strain + begin};
  // v_n = w_n + velocity a_n = w_{n+1} − back a_n
  see(seen, end - begin, step.predictor - step.velocity, 0.25 * time_step_ * time_step_ * scene_.beta2,
      model_.kernel.instructions);
  if (scene_.body_acceleration != Vector2{})
    for (int i = begin; i < end; ++i) gravity[i] = gravity_work(i, kept_[i]);
}

/// Where loads, supports and the surface have acted since the free motion.
void SlidingBody::observe_boundary(const StepCoefficients& step, Observed observed) {
  static const LogEvent event("ObservedState");
  const LogEvent::Scope scope(event);
  const double back = step.predictor - step.velocity;
  for (const int i : boundary_.node)
    if (observed == Observed::everything)
      observe_nodes(step, i, i + 1);
    else
      for (int axis = 0; axis < 2; ++axis)
        v_.data()[i][axis] = w_.data()[i][axis] - back * a_.data()[i][axis];
}

Vector2 SlidingBody::force_on_support(int slot) const {
  const Vector2 &now = force_[boundary_.node[slot]], &before = boundary_.internal[slot];
  const double lag = scene_.damping.stiffness / time_step_;
  return {-(now[0] + lag * (now[0] - before[0])), -(now[1] + lag * (now[1] - before[1]))};
}

ContactTotals SlidingBody::contact_totals(int k) const {
  const double length = contact_.tributary_length[k];
  const ContactSums::Sums& sums = sums_.at(k);
  const auto losses = ledger_.contact_losses(k);
  return {losses[0] / length,
          losses[1] / length,
          sums.slip,
          sums.pressure_slip / length,
          sums.closed * time_step_,
          sums.force * time_step_ / length,
          sums.closures};
}

double SlidingBody::gravity_work(int node, const Vector2& displacement) const {
  return body_acceleration_.work(node, model_.mass[node], displacement);
}

/// Nodes and plates.
std::size_t SlidingBody::moving_things() const { return model_.mass.size() + straight_->size(); }

/// What this rank adds to the sums that `observe_nodes` has made the terms of; plates are added here.
SlidingBody::BulkTerms SlidingBody::bulk_terms() const {
  const double correction = 0.25 * time_step_ * time_step_ * scene_.beta2;
  const std::size_t owned = model_.mass.size(), moving = moving_things();
  const std::span all(terms_);
  const auto velocity = all.first(moving), acceleration = all.subspan(moving, moving),
             strain = all.subspan(2 * moving, owned), work = all.subspan(2 * moving + owned);
  std::size_t plate = owned;
  for (const auto& side : *straight_) {
    const auto energies = side->energies();
    velocity[plate] = energies[0];
    acceleration[plate++] = 2 * correction * energies[1];
  }
  return {velocity, acceleration, strain, work};
}

/// Not less than the number of terms of any sum that are not zero.
std::int64_t SlidingBody::largest_count() const {
  return model_.mesh.nodes.total + static_cast<std::int64_t>(straight_->size());
}

Energy SlidingBody::energy() const {
  const BulkTerms bulk = bulk_terms();
  const auto works = ledger_.works();
  std::vector<std::span<const double>> lists(bulk.begin(), bulk.end());
  for (const auto& work : works) lists.push_back(work.list);
  const auto sums = order_free_sums(comm_, lists, largest_count());
  Energy energy;
  energy.kinetic = sums[0] - sums[1];
  energy.flowed = sums[0] + sums[1];  // the two may cancel to rounding
  energy.strain = sums[2];
  energy.body_force = sums[3] - start_gravity_;
  for (std::size_t k = 0; k < works.size(); ++k) energy.*works[k].energy += sums[bulk.size() + k];
  close_balance(energy, start_energy_);
  return energy;
}

Momentum SlidingBody::momentum() const {
  const Mesh& mesh = model_.mesh;
  const Vector2 middle{0.5 * (mesh.lower[0] + mesh.upper[0]), 0.5 * (mesh.lower[1] + mesh.upper[1])};
  std::vector<double> mass = model_.mass, x, y, angular;
  for (int i = 0; i < mesh.nodes.owned; ++i) {
    const Vector2 &v = v_.data()[i], &place = mesh.nodes.position[i];
    x.push_back(mass[i] * v[0]);
    y.push_back(mass[i] * v[1]);
    angular.push_back(mass[i] * ((place[0] - middle[0]) * v[1] - (place[1] - middle[1]) * v[0]));
  }
  const auto sums = order_free_sums(comm_, {mass, x, y, angular}, mesh.nodes.total);
  return {sums[0], {sums[1], sums[2]}, sums[3]};
}

}  // namespace slipscale
