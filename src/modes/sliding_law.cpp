#include "slipscale/modes/sliding_law.hpp"

#include <algorithm>
#include <cmath>

namespace slipscale {
namespace {

/// e^x − 1 without cancellation.
Complex minus_one(Complex x) {
  const double half = std::sin(0.5 * x.imag()), grows = std::expm1(x.real());
  return {grows * std::cos(x.imag()) - 2 * half * half, (1 + grows) * std::sin(x.imag())};
}

SlidingLaw::Value continuous(const SlidingLaw& law, Complex p) {
  const double a = law.damping.mass, b = law.damping.stiffness;
  const Complex phi = 1.0 / (1.0 + p * law.time);
  return {p * (p + a) / (1.0 + b * p), law.coefficient / (1.0 + p * law.time), p * phi / (1.0 + b * p)};
}

SlidingLaw::Value discrete(const SlidingLaw& law, Complex p) {
  const double step = law.scheme->step, a = law.damping.mass, b = law.damping.stiffness;
  const Complex change = minus_one(p * step), z = 1.0 + change;  // z − 1
  const Complex lag = 1.0 + b / step * (change / z);
  const Complex acceleration = change / (step * step * (1.0 + (law.scheme->beta2 + 0.5) * change));
  const Complex q = acceleration * (change + a * step) / lag;
  const Complex predicted = change / (step * (1.0 + (law.scheme->beta2 + 0.5) * change)) / lag;  // w_n over κ
  if (law.time == 0) return {q, law.coefficient, predicted};
  const double x = step / law.time;
  const Relaxation memory = relaxation(x);
  // z − e without cancellation.
  const Complex forgets = change - std::expm1(-x);
  return {q, law.coefficient * (memory.now * z + memory.before) / forgets,
          predicted * (-std::expm1(-x) * z / forgets)};
}

}  // namespace

SlidingLaw::Value SlidingLaw::at(Complex p) const {
  return scheme ? discrete(*this, p) : continuous(*this, p);
}

SlidingLaw::Value SlidingLaw::slope_at(Complex p) const {
  const double reach = 1e-5 * std::abs(p);
  const Value after = at(p + reach), before = at(p - reach);
  return {(after.inertia - before.inertia) / (2 * reach), (after.friction - before.friction) / (2 * reach),
          (after.slip - before.slip) / (2 * reach)};
}

SlidingLaw sliding_law(const Scene& scene) {
  SlidingLaw law;
  law.coefficient = reference_coefficient(scene);
  law.damping = scene.damping;
  if (scene.friction.remembers()) law.time = shortest_memory(scene.friction, scene.surface->speed);
  return law;
}

double reference_coefficient(const Scene& scene) {
  const FrictionChoice& friction = scene.friction;
  if (friction.phases.empty() && !friction.coefficient_formula &&
      friction.law == FrictionChoice::Law::exponential)
    return steady_coefficient(scene, {}).value;
  if (!friction.varies()) return friction.coefficient;
  double most = friction.phases.empty() ? friction.coefficient : 0;
  for (const FrictionConstants& phase : friction.phases)
    most = std::max({most, phase.coefficient.number, phase.kinetic.number});
  return most;
}

SteadyCoefficient steady_coefficient(const Scene& scene, const ContactPlace& node) {
  const FrictionChoice own = friction_at(scene.friction, node, 0);
  if (own.law != FrictionChoice::Law::exponential) return {own.coefficient, 0};
  const double kinetic = own.kinetic.number, speed = scene.surface->speed;
  return {exponential_coefficient(own.coefficient, kinetic, own.slip_rate, speed),
          exponential_slope(own.coefficient, kinetic, own.slip_rate, speed)};
}

}  // namespace slipscale
