#pragma once

#include <vector>

#include "scenes.hpp"

namespace slipscale::testing_support {

/// The four regularised laws: both rates, both thresholds. With `rate: slip`, L and V* make the same T at the
/// slip rate `usual`.
struct LawName {
  const char* text;
  bool by_slip_rate, stored_strength;
  FrictionChoice choice(double coefficient, double time, double usual) const;
};
extern const std::vector<LawName> regularized_laws;

/// V* of `rate: slip` in these tests, m/s.
constexpr double rate_reference = 0.25;

/// One layer of elements, periodic in x, top held along x: an oscillator of mass 1 kg/m² and stiffness 1 Pa/m
/// along x, and of stiffness 2 Pa/m along y. The surface drags it with μp = 1 Pa (of a coefficient
/// that depends on the slip rate: at rest).
struct Column {
  FrictionChoice friction;
  double speed = 5, ramp = 0;  ///< of the surface, m/s and s
  double velocity = 0;         ///< of the body at t = 0, m/s
  double excess_pressure = 0;  ///< at t = 0, relative: the pressure oscillates by it
  bool held = false;           ///< the bottom as well is held along x
  double shear = 0;            ///< τ of the uniform state at t = 0, Pa
};

constexpr double column_friction = 0.5, column_pressure = 2;
constexpr double column_pressure_frequency = 1.4142135623730951;  ///< of the pressure's oscillation, 1/s

/// What the surface sees at t_n, the same on every rank.
struct ColumnReading {
  double displacement, traction, pressure;  ///< u_x of the bottom in m, Pa
};

/// Readings at t_0 … t_steps.
std::vector<ColumnReading> run_column(const Column& column, double time_step, long steps);

/// Displacement of the same oscillator at `end` s from the ordinary differential equations of stick and slip,
/// by Runge-Kutta with the changes between them located to rounding. `kept`: traction that a reversal from
/// slip to slip leaves to the instantaneous threshold, 0 by the law.
double oscillator_displacement(const Column& column, double end, double kept = 0);
/// The same at `count` equal steps of time, the last at `end`.
std::vector<double> oscillator_path(const Column& column, double end, int count);

/// Falling friction: from μ_s = .5 to μ_k = .2 over 1 m/s.
FrictionChoice falling_friction(double time);

}  // namespace slipscale::testing_support
