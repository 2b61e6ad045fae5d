#include "slipscale/contact/friction.hpp"

#include <algorithm>
#include <cmath>

namespace slipscale {

Relaxation relaxation(double x) {
  if (x > 0.5) {
    const double e = std::exp(-x), g = -std::expm1(-x) / x;
    return {e, 1 - g, g - e};
  }
  // 1 − g and g − e cancel for small x; their power series do not: Σ −(−x)^k/(k+1)! and Σ −k (−x)^k/(k+1)!.
  double now = 0, before = 0, term = 1;
  for (int k = 1; k <= 14; ++k) {
    term *= -x / (k + 1);
    now -= term;
    before -= k * term;
  }
  return {std::exp(-x), now, before};
}

Friction Coulomb::operator()(const FrictionDemand& demand, FrictionMemory&) const {
  const double limit = coefficient * demand.pressure;
  if (std::abs(demand.trial) <= limit) return {demand.trial, ContactStatus::stick};
  return {std::copysign(limit, demand.trial), ContactStatus::slip};
}

namespace {

/// Of a law whose memory is the traction: sticks up to `still` p, and slips with what relaxes to `slipping`
/// p.
Friction instantaneous(const FrictionDemand& demand, const Relaxation& step, double still, double slipping,
                       FrictionMemory& memory) {
  Friction answer{demand.trial, ContactStatus::stick};
  if (std::abs(demand.trial) > still * demand.pressure) {
    // A memory that opposes the present direction restarts from zero.
    const double kept = std::max(0.0, std::copysign(1.0, demand.trial) * memory.traction);
    const double strength =
        step.keep * kept + slipping * (step.now * demand.pressure + step.before * memory.pressure);
    if (strength < std::abs(demand.trial))
      answer = {std::copysign(strength, demand.trial), ContactStatus::slip};
  }
  memory = {answer.traction, demand.pressure};
  return answer;
}

}  // namespace

Friction RegularisedInstantaneous::operator()(const FrictionDemand& demand, FrictionMemory& memory) const {
  return instantaneous(demand, step, coefficient, coefficient, memory);
}

double exponential_coefficient(double still, double kinetic, double over, double slip_rate) {
  return kinetic + (still - kinetic) * std::exp(-std::abs(slip_rate) / over);
}

double exponential_slope(double still, double kinetic, double over, double slip_rate) {
  return -(still - kinetic) / over * std::exp(-std::abs(slip_rate) / over);
}

Friction Exponential::operator()(const FrictionDemand& demand, FrictionMemory& memory) const {
  const double mu = exponential_coefficient(coefficient, kinetic, slip_rate, demand.slip_rate);
  return instantaneous(demand, step, coefficient, mu, memory);
}

Friction RegularisedStrength::operator()(const FrictionDemand& demand, FrictionMemory& memory) const {
  const double strength = step.keep * memory.traction +
                          coefficient * (step.now * demand.pressure + step.before * memory.pressure);
  memory = {strength, demand.pressure};
  if (std::abs(demand.trial) <= strength) return {demand.trial, ContactStatus::stick};
  return {std::copysign(strength, demand.trial), ContactStatus::slip};
}

}  // namespace slipscale
