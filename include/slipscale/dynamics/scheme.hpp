#pragma once

#include "slipscale/contact/nodal_step.hpp"

namespace slipscale {

/// Rayleigh damping: force −(a M v + b K u̇), the stiffness part lagged by one step.
struct Damping {
  double mass = 0;       ///< a, 1/s
  double stiffness = 0;  ///< b, s
};

/// One step of the explicit β2 scheme of the paper (M. G. Katona, O. C. Zienkiewicz, Int. J. Numer. Meth.
/// Engng 21 (1985) 1345; Newmark's with β = 0, γ = β2):
///     w_n     = v_{n−1} + (1 − β2) Δt a_{n−1}
///     v_n     = w_n + velocity a_n
///     u_{n+1} = u_n + time_step w_n + displacement a_n
/// The predictor alone carries the motion from step to step, w_{n+1} = w_n + predictor a_n, so that the step
/// loop moves two arrays, u and w; v_n and a_n are made for the steps that are observed.
constexpr StepCoefficients beta2_step(double time_step, double beta2) {
  return {time_step, time_step, beta2 * time_step, (beta2 + 0.5) * time_step * time_step};
}

/// The first step, from given u_0 and v_0: w_0 = v_0 stays v_0, u_1 = u_0 + Δt v_0 + ½Δt² a_0, w_1 = v_0 + (1
/// − β2)Δt a_0.
constexpr StepCoefficients first_step(double time_step, double beta2) {
  return {time_step, (1 - beta2) * time_step, 0, 0.5 * time_step * time_step};
}

/// Largest stable step [s]: aΔt + β2 Δt(Δt + 2b) ω² < 2 with the largest frequency ω [1/s]. Not a number
/// where the frequency is none.
double stable_step(double frequency, double beta2, const Damping& damping);

}  // namespace slipscale
