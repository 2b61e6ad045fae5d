#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "scenes.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale::testing_support {

/// u = amplitude · direction · cos(k·x − ωt + offset).
struct TravellingWave {
  double amplitude;     ///< m
  Vector2 direction;    ///< of the motion
  Vector2 wave_number;  ///< k, 1/m
  double frequency;     ///< ω, 1/s
  double offset = 0;    ///< rad
  double phase(const Vector2& at, double time) const {
    return wave_number[0] * at[0] + wave_number[1] * at[1] - frequency * time + offset;
  }
};

/// The sum of some waves: as numbers, and as the formulas that a scene starts from.
struct WaveField {
  std::vector<TravellingWave> waves;

  Vector2 displacement(const Vector2& at, double time) const {
    Vector2 u{};
    for (const TravellingWave& wave : waves)
      for (int axis = 0; axis < 2; ++axis)
        u[axis] += wave.amplitude * wave.direction[axis] * std::cos(wave.phase(at, time));
    return u;
  }

  /// Displacement (`rate` false) or velocity along an axis, at t or at the start.
  std::string text(int axis, bool rate, const std::string& time) const {
    std::string sum = "0";
    for (const TravellingWave& wave : waves)
      sum += format(" + {:.17g}*{}({:.17g}*x + ({:.17g})*y - {:.17g}*{} + ({:.17g}))",
                    wave.amplitude * wave.direction[axis] * (rate ? wave.frequency : 1), rate ? "sin" : "cos",
                    wave.wave_number[0], wave.wave_number[1], wave.frequency, time, wave.offset);
    return sum;
  }
  SharedFormula formula(const std::string& text, const std::string& variables) const {
    return std::make_shared<const Formula>(text, variables, Formula::Names{}, "formula of a wave");
  }

  /// The scene starts from the field.
  void start(Scene& scene) const {
    for (int axis = 0; axis < 2; ++axis) {
      scene.initial.displacement[axis] = {1, formula(text(axis, false, "0"), "xy")};
      scene.initial.velocity[axis] = 1;
      scene.initial.velocity_formula[axis] = formula(text(axis, true, "0"), "xy");
    }
  }
  /// A boundary that follows it from there.
  BoundaryCondition follow(const std::string& boundary) const {
    BoundaryCondition condition;
    condition.boundary = boundary;
    condition.displacement = {1.0, 1.0};
    for (int axis = 0; axis < 2; ++axis)
      condition.displacement_formula[axis] =
          formula(text(axis, false, "t") + " - (" + text(axis, false, "0") + ")", "xyt");
    return condition;
  }
};

/// Relative L2 error of an observed u against the field and a state beside it, both [place]. Collective.
template <class Beside>
double relative_error(const SlidingBody& body, const WaveField& field, Beside beside) {
  const Nodes& nodes = body.model().mesh.nodes;
  double sums[2] = {0, 0};
  for (int i = 0; i < nodes.owned; ++i) {
    const Vector2 exact = field.displacement(nodes.position[i], body.time()),
                  rest = beside(nodes.position[i]);
    for (int axis = 0; axis < 2; ++axis) {
      sums[0] += std::pow(body.displacement_n()[i][axis] - rest[axis] - exact[axis], 2);
      sums[1] += std::pow(exact[axis], 2);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return std::sqrt(sums[0] / sums[1]);
}

/// A strip of width 1, periodic along x.
inline Block wave_strip(double height, int across, Shape shape) {
  Block block;
  block.width = 1;
  block.height = height;
  block.nx = across;
  block.ny = static_cast<int>(std::lround(across * height));
  block.shape = shape;
  block.periodic_x = true;
  return block;
}

/// Steps to `end`, as long as a part of the stable one allows.
inline long steps_to_end(const Model& model, double end, double safety) {
  const double stable = stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, 0.5, {});
  return std::lround(std::ceil(end / (safety * stable)));
}

}  // namespace slipscale::testing_support
