#include "slipscale/dynamics/body_acceleration.hpp"

#include <cmath>

namespace slipscale {
namespace {

Vector2 value_of(const BodyAccelerationChoice& choice, const Vector2& place, double time) {
  Vector2 value = choice.value;
  for (int axis = 0; axis < 2; ++axis)
    if (choice.formula[axis]) value[axis] *= (*choice.formula[axis])(place, time);
  return value;
}

}  // namespace

BodyAcceleration::BodyAcceleration(const BodyAccelerationChoice& choice, const Mesh& mesh, double beta2,
                                   double time_step)
    : choice_(choice), beta2_(beta2), time_step_(time_step), uniform_(choice.value) {
  const auto owned = static_cast<std::size_t>(mesh.nodes.owned);
  if (choice.of_place()) {
    for (std::size_t i = 0; i < owned; ++i) field_.push_back(value_of(choice, mesh.nodes.position[i], 0));
  } else if (choice.of_time()) {
    done_.assign(owned, 0);
    waiting_.assign(owned, 0);
    follow(0);
  }
}

bool BodyAcceleration::follow(double time) {
  for (std::size_t i = 0; i < done_.size(); ++i) {
    done_[i] += waiting_[i];
    waiting_[i] = 0;
  }
  uniform_ = value_of(choice_, {}, time);
  return std::isfinite(uniform_[0]) && std::isfinite(uniform_[1]);
}

/// Δu = Δt w_{n+1} + (β2 − ½) Δt² a_n, in the first step as in every other.
void BodyAcceleration::add_work(const NodalState& state, double next_time) {
  const Vector2 next = value_of(choice_, {}, next_time);
  const Vector2 g{(1 - beta2_) * uniform_[0] + beta2_ * next[0],
                  (1 - beta2_) * uniform_[1] + beta2_ * next[1]};
  const double drift = (beta2_ - 0.5) * time_step_ * time_step_;
  for (std::size_t i = 0; i < done_.size(); ++i) {
    Vector2 increment{time_step_ * state.predictor[i][0], time_step_ * state.predictor[i][1]};
    if (drift != 0)
      for (int axis = 0; axis < 2; ++axis) increment[axis] += drift * state.acceleration[i][axis];
    waiting_[i] = g[0] * increment[0] + g[1] * increment[1];
  }
}

void BodyAcceleration::add_state(StateGroup& nodes) {
  if (!of_time()) return;
  nodes.arrays.push_back(
      {"body_force", "m^2/s^2", "work of the body acceleration since t = 0, over the mass", 1, done_.data()});
  nodes.arrays.push_back(
      {"body_force_waiting", "m^2/s^2", "the same along the coming step", 1, waiting_.data()});
}

}  // namespace slipscale
