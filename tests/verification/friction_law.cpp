#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "friction_column.hpp"
#include "report.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double friction_time = 0.3;

/// The column in the state a case asks for, with one of the laws.
Column column_with(const LawName& law, double speed, double ramp = 0, double velocity = 0) {
  return {law.choice(column_friction, friction_time, speed), speed, ramp, velocity, 0, false};
}

double displacement_at(const Column& column, double end, long steps) {
  return run_column(column, end / static_cast<double>(steps), steps).back().displacement;
}

struct Response {
  double phase = 0;          ///< ωT
  double gain = 0, lag = 0;  ///< of the traction to the pressure
  double error = 0;          ///< of the two together
};

/// Traction on a bottom that is held while the top bounces on the column: p = p0 (1 + ε cos ωt). The step
/// makes a whole number of steps to the period of central difference, sin(π/N) = ωΔt/2.
Response response(const LawName& law, double time, long steps) {
  const Column column{law.choice(column_friction, time, 5), 5, 0, 0, 0.2, true};
  const double angle = 2 * std::numbers::pi / static_cast<double>(steps),
               dt = 2 * std::sin(angle / 2) / column_pressure_frequency;
  const long settle = steps * static_cast<long>(std::ceil(40 * time / (dt * static_cast<double>(steps))));
  const auto readings = run_column(column, dt, settle + steps);
  std::complex<double> traction = 0, pressure = 0;
  for (long n = settle + 1; n <= settle + steps; ++n) {
    const ColumnReading& now = readings[static_cast<std::size_t>(n)];
    const auto wave = std::polar(2.0 / static_cast<double>(steps), -angle * static_cast<double>(n));
    traction += now.traction * wave;
    pressure += now.pressure * wave;
  }
  EXPECT_NEAR(std::abs(pressure), 0.2 * column_pressure, 1e-9);
  Response found{angle / dt * time, std::abs(traction / pressure) / column_friction,
                 -std::arg(traction / pressure)};
  found.error = std::hypot(found.gain * std::hypot(1, found.phase) - 1, found.lag - std::atan(found.phase));
  return found;
}

/// How surface and body move when a case of stick and slip starts.
struct Motion {
  const char* text;
  double speed, ramp, velocity;
};

}  // namespace

/// In slip the traction is the pressure behind a first-order filter. The only error is that of the straight
/// line through the pressure over a step, (ωΔt)²/12 of the gain: 8e-5 at 200 steps a period.
TEST(FrictionLaw, FollowsAnOscillatingPressure) {
  for (const double time : {0.2, 0.7, 2.0}) {
    Response worst;
    for (const LawName& law : regularized_laws) {
      const Response found = response(law, time, 200);
      EXPECT_LE(found.error, 1e-4) << law.text << ", T = " << time;
      if (found.error >= worst.error) worst = found;
    }
    const double order = std::log2(response(regularized_laws[0], time, 50).error /
                                   response(regularized_laws[0], time, 100).error);
    EXPECT_GT(order, 1.9) << "T = " << time;
    report({"Friction law under p = p0 (1 + 0.2 cos wt), both rates, both thresholds",
            format("wT = {:.3f}: gain, lag in rad, 200 steps a period", worst.phase),
            format("{:.4f}, {:.4f} within 1e-4", 1 / std::hypot(1, worst.phase), std::atan(worst.phase)),
            format("{:.4f}, {:.4f}", worst.gain, worst.lag), format("{:.1f}", order),
            "1/sqrt(1 + w^2 T^2), atan wT"});
  }
}

/// Exact solution: m = k = μp = 1 always in slip, T = .3, from rest and no traction. Second order, the
/// phase of central difference among it: Δt² t/24.
TEST(FrictionLaw, MovesOneDegreeOfFreedom) {
  const Column column = column_with(regularized_laws[0], 5);
  for (const auto& [end, expected] : {std::pair{5.0, 1.003683570}, {10.0, 1.919520975}}) {
    EXPECT_NEAR(oscillator_displacement(column, end), expected, 1e-9);
    const long steps = std::lround(end / 1e-3);
    const double fine = displacement_at(column, end, steps), coarse = displacement_at(column, end, steps / 2);
    EXPECT_NEAR(fine, expected, 5e-7);
    const double order = std::log2((coarse - expected) / (fine - expected));
    EXPECT_GT(order, 1.9);
    report({"One degree of freedom, m = k = mu p = 1, T = 0.3 s, dt 1 ms",
            format("x({:g} s) in slip, m", end), format("{:.9f} within 5e-7", expected),
            format("{:.9f}", fine), format("{:.1f}", order), "exact solution"});
  }
}

/// Slip that begins, ends and reverses, for all four laws, against the ordinary differential equations of
/// stick and slip. A change between the two is seen up to one step late, in which things move by 1 m/s · Δt:
/// first order.
TEST(FrictionLaw, ReversesAndSticks) {
  constexpr double end = 5;
  for (const Motion& motion : {Motion{"slip reverses through stick, V = 1 m/s and mirrored", 1, 0, 1.5},
                               Motion{"stick, then slip: V on a ramp of 2 s", 1, 2, 0},
                               Motion{"slip, then stick: V = 0, T given", 0, 0, 1.2}}) {
    double worst = 0;
    for (const LawName& law : regularized_laws)
      for (const double sign : {1.0, -1.0}) {
        const Column column = column_with(law, sign * motion.speed, motion.ramp, sign * motion.velocity);
        const double expected = oscillator_displacement(column, end);
        for (const long steps : {1250, 2500, 5000}) {
          const double error = std::abs(displacement_at(column, end, steps) - expected);
          EXPECT_LE(error, end / static_cast<double>(steps)) << law.text << ", " << motion.text;
          if (steps == 5000) worst = worse(worst, error);
        }
      }
    report({"One degree of freedom, m = k = mu p = 1, T = 0.3 s, dt 1 ms",
            format("{}: largest error of x(5 s) of both rates and thresholds, m", motion.text),
            "below 1e-3 (1 m/s dt)", format("{:.1e}", worst), "",
            "equations of stick and slip, Runge-Kutta"});
  }
}

/// Slip from one direction straight into the other, |spring| > μp. With the stored strength nothing happens
/// to the memory. With the instantaneous threshold it restarts from 0 by the law; but the step in which the
/// slip changes sign may find |τ*| ≤ μp, stick for that one step and leave τ* to the memory. Where in 0 … μp
/// depends on how the step falls, however small it is: the motion lies between those two, and does not
/// converge.
TEST(FrictionLaw, ReversesFromSlipToSlip) {
  constexpr double end = 5;
  for (const LawName& law : regularized_laws) {
    const Column column = column_with(law, 1, 0, 3);
    const double restarted = oscillator_displacement(column, end),
                 kept = law.stored_strength ? restarted : oscillator_displacement(column, end, 1);
    double lowest = 1e300, highest = -1e300, miss = 1e300;
    for (int n = 0; n < 16; ++n) {
      const double x = displacement_at(column, end, 5000 + 37 * n);
      lowest = std::min(lowest, x);
      highest = std::max(highest, x);
      miss = std::min(miss, std::abs(x - restarted));
    }
    EXPECT_LE(miss, 1e-3) << law.text;  // steps that do not stick at the reversal
    EXPECT_GE(lowest, std::min(kept, restarted) - 1e-3) << law.text;
    EXPECT_LE(highest, std::max(kept, restarted) + 1e-3) << law.text;
    if (law.by_slip_rate) continue;  // the same story
    report({"One degree of freedom, slip reverses at once, 16 steps of 0.9 to 1 ms",
            std::string(law.text) + ": x(5 s), m",
            law.stored_strength ? format("{:.3f} within 1e-3", restarted)
                                : format("{:.3f} (memory kept) to {:.3f} (restarted)", kept, restarted),
            format("{:.3f} to {:.3f}", lowest, highest), "", "equations of stick and slip, Runge-Kutta"});
  }
}
