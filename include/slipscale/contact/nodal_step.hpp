#pragma once

#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// What an acceleration does over one step of the β2 scheme (see dynamics/scheme.hpp):
///     u_{n+1} = u_n + time_step w_n + displacement a_n
///     w_{n+1} = w_n + predictor a_n
///     v_n     = w_n + velocity a_n
struct StepCoefficients {
  double time_step;     ///< Δt, s
  double predictor;     ///< Δt, s
  double velocity;      ///< β2 Δt, s
  double displacement;  ///< (β2 + ½) Δt², s²
};

/// u_{n+1} − u_n. `Value` is a component or both of them.
template <class Value>
Value displacement_increment(const StepCoefficients& step, Value predictor, Value acceleration) {
  return step.time_step * predictor + step.displacement * acceleration;
}

/// w_{n+1}.
template <class Value>
Value next_predictor(const StepCoefficients& step, Value predictor, Value acceleration) {
  return predictor + step.predictor * acceleration;
}

/// The state arrays of a rank during a step, by local node: as free motion left them, and after each force
/// from outside as that force leaves them.
struct NodalState {
  Vector2* displacement;  ///< û, the prediction of u_{n+1}, m
  Vector2* predictor;     ///< w_{n+1}, the velocity the next step starts with, m/s
  Vector2* acceleration;  ///< a_n, m/s²; null when the step does not keep it
};

/// Adds to a_n at a node what one more force makes of it, and to u_{n+1} and w_{n+1} what follows: both are
/// linear in a_n, so forces may come one after the other.
inline void accelerate(const NodalState& state, const StepCoefficients& step, int node, int axis,
                       double acceleration) {
  if (state.acceleration) state.acceleration[node][axis] += acceleration;
  double& w = state.predictor[node][axis];
  w = next_predictor(step, w, acceleration);
  state.displacement[node][axis] += step.displacement * acceleration;
}

}  // namespace slipscale
