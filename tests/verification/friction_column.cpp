#include "friction_column.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace slipscale::testing_support {

const std::vector<LawName> regularized_laws = {{"rate surface, threshold instantaneous", false, false},
                                               {"rate surface, threshold regularized", false, true},
                                               {"rate slip, threshold instantaneous", true, false},
                                               {"rate slip, threshold regularized", true, true}};

FrictionChoice LawName::choice(double coefficient, double time, double usual) const {
  return {FrictionChoice::Law::regularized,          coefficient,   by_slip_rate, stored_strength, time,
          time * (std::abs(usual) + rate_reference), rate_reference};
}

std::vector<ColumnReading> run_column(const Column& column, double time_step, long steps) {
  Block block;
  block.nx = 3;
  block.ny = 1;
  block.width = 3;
  block.shape = Shape::quadrilaterals;
  block.periodic_x = true;
  const std::string path = scratch("column.msh");
  write_block(block, path);
  Scene scene;
  scene.conditions = {{"top", {0.0, std::nullopt}, column_pressure, 0, 0}};
  if (column.held) scene.conditions.push_back({"bottom", {0.0, std::nullopt}, 0, 0, 0});
  scene.initial.velocity = {column.velocity, 0};
  scene.initial.pressure = column_pressure * (1 + column.excess_pressure);
  scene.initial.shear = column.shear;
  scene.surface = Surface{"bottom", 0, column.speed, column.ramp};
  scene.friction = column.friction;
  Simulation simulation(PETSC_COMM_WORLD, {path}, {isotropic(2, 0, 2)}, scene, time_step);
  const SlidingBody& body = simulation.body;
  std::vector<ColumnReading> readings;
  for (long n = 0; n <= steps; ++n) {
    simulation.body.advance(false);
    // All contact nodes do the same, but a rank may have none.
    double reading[3];
    std::fill_n(reading, 3, -std::numeric_limits<double>::infinity());
    for (int k = 0; k < body.contact().size(); ++k) {
      const double values[3] = {body.boundary_nodes().displacement[body.contact().slot[k]][0],
                                body.contact().traction[k], body.contact().pressure[k]};
      for (int q = 0; q < 3; ++q) reading[q] = std::max(reading[q], values[q]);
    }
    MPI_Allreduce(MPI_IN_PLACE, reading, 3, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
    readings.push_back({reading[0], reading[1], reading[2]});
  }
  return readings;
}

namespace {

/// m = k = 1 and μp = 1, of falling friction at rest. The direction of slip is +1, −1, or 0 in stick.
class Oscillator {
 public:
  Oscillator(const Column& column, double kept)
      : column_(column),
        surface_{"", 0, column.speed, column.ramp},
        kept_(kept),
        now_{column.shear, column.velocity, std::abs(column.shear)} {
    const double slip = slip_rate(now_, 0);
    direction_ = slip > 0 ? 1 : slip < 0 ? -1 : 0;
  }

  double displacement_at(double end) {
    constexpr double step = 1e-3;
    for (double& t = time_; t < end;) {
      double part = std::min(step, end - t);
      State next = advanced(t, part);
      if (changes(next, t + part)) {
        double before = 0;
        for (int halving = 0; halving < 60; ++halving) {
          const double middle = 0.5 * (before + part);
          (changes(advanced(t, middle), t + middle) ? part : before) = middle;
        }
        next = advanced(t, part);
        now_ = next;
        change(t + part);
      } else {
        now_ = next;
      }
      t = part == end - t ? end : t + part;
    }
    return now_.x;
  }

 private:
  struct State {
    double x, v, s;  ///< displacement, velocity, strength
  };

  double slip_rate(const State& state, double t) const { return surface_.velocity(t) - state.v; }
  bool stored() const { return column_.friction.stored_strength; }
  /// Traction that sticking needs: it carries the spring and the surface's acceleration.
  double demand(const State& state, double t) const {
    constexpr double d = 1e-6;
    return state.x + (surface_.velocity(t + d) - surface_.velocity(t - d)) / (2 * d);
  }
  double limit(const State& state) const { return stored() ? state.s : 1; }
  /// μp in slip.
  double target(double slip) const {
    const FrictionChoice& law = column_.friction;
    if (law.law != FrictionChoice::Law::exponential) return 1;
    const double kinetic = law.kinetic.number;
    return column_pressure *
           (kinetic + (law.coefficient - kinetic) * std::exp(-std::abs(slip) / law.slip_rate));
  }

  bool changes(const State& state, double t) const {
    if (direction_ == 0) return std::abs(demand(state, t)) > limit(state);
    return direction_ * slip_rate(state, t) < 0;
  }

  void change(double t) {
    const double wanted = demand(now_, t), sign = std::copysign(1, wanted);
    if (direction_ == 0) {
      if (!stored()) now_.s = std::abs(wanted);
      direction_ = sign;
    } else if (std::abs(wanted) <= limit(now_)) {
      direction_ = 0;
    } else {
      if (!stored() && sign != direction_) now_.s = kept_;
      direction_ = sign;
    }
  }

  State rate(const State& state, double t) const {
    const FrictionChoice& law = column_.friction;
    const double slip = direction_ == 0 ? 0 : std::abs(slip_rate(state, t));
    const double time = law.by_slip_rate ? law.length / (slip + law.rate_reference) : law.time;
    const double strengthening = (target(slip) - state.s) / time;
    if (direction_ == 0) return {surface_.velocity(t), 0, strengthening};
    return {state.v, direction_ * state.s - state.x, strengthening};
  }

  State advanced(double t, double dt) const {
    const auto moved = [&](const State& k, double by) {
      return State{now_.x + by * k.x, now_.v + by * k.v, now_.s + by * k.s};
    };
    const State a = rate(now_, t), b = rate(moved(a, dt / 2), t + dt / 2),
                c = rate(moved(b, dt / 2), t + dt / 2), d = rate(moved(c, dt), t + dt);
    State next =
        moved({a.x + 2 * b.x + 2 * c.x + d.x, a.v + 2 * b.v + 2 * c.v + d.v, a.s + 2 * b.s + 2 * c.s + d.s},
              dt / 6);
    if (direction_ == 0) next.v = surface_.velocity(t + dt);
    return next;
  }

  const Column& column_;
  const Surface surface_;
  const double kept_;
  State now_;
  double time_ = 0;
  double direction_ = 0;
};

}  // namespace

double oscillator_displacement(const Column& column, double end, double kept) {
  return Oscillator(column, kept).displacement_at(end);
}

std::vector<double> oscillator_path(const Column& column, double end, int count) {
  Oscillator oscillator(column, 0);
  std::vector<double> path;
  for (int k = 1; k <= count; ++k) path.push_back(oscillator.displacement_at(end * k / count));
  return path;
}

FrictionChoice falling_friction(double time) {
  FrictionChoice choice;
  choice.law = FrictionChoice::Law::exponential;
  choice.coefficient = column_friction;
  choice.kinetic = {0.2};
  choice.slip_rate = 1;
  choice.time = time;
  return choice;
}

}  // namespace slipscale::testing_support
