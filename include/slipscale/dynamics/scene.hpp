#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipscale/contact/law.hpp"
#include "slipscale/contact/surface.hpp"
#include "slipscale/dynamics/body_acceleration.hpp"
#include "slipscale/dynamics/conditions.hpp"
#include "slipscale/dynamics/model.hpp"
#include "slipscale/dynamics/scheme.hpp"

namespace slipscale {

/// Everything that a run models, as the user described it. What is absent costs nothing.
struct Scene {
  std::vector<BoundaryCondition> conditions;
  InitialState initial;
  Vector2 body_acceleration{};  ///< m/s²; 1 where a formula stands
  std::array<SharedFormula, 2> body_acceleration_formula{};
  Damping damping;
  double beta2 = 0.5;
  std::optional<Surface> surface;
  FrictionChoice friction;
  std::string measured;  ///< boundary where the load is measured; empty: none

  BodyAccelerationChoice acceleration() const { return {body_acceleration, body_acceleration_formula}; }
};

/// When the run ends and how it gets there.
struct TimeChoice {
  std::optional<double> step;  ///< s; absent: `auto`
  double safety = 0.9;         ///< `auto` takes this part of the stable step
  double end = 0;              ///< s
};

Schema scene_schema();
/// Collective; so are the checks of formulas in it.
Scene read_scene(const Options& options, const Mesh& mesh);
/// The options of a scene whose values vary in a way that steady sliding has no place for: everything but
/// tractions that vary along a boundary, and what belongs to the start.
std::vector<std::string> unsteady_formulas(const Scene& scene);
TimeChoice read_time(const Options& options);
Model::Storage read_storage(const Options& options);
/// Throws UserError for instructions that this processor lacks.
StiffnessKernel read_kernel(const Options& options);

struct TimeStep {
  double step = 0;        ///< s
  double limit = 0;       ///< stable step for the sharp frequency, s
  double safe_limit = 0;  ///< the same for the safe bound, s
  long count = 0;         ///< steps to the end
  FrequencyBounds frequency;
};

/// How many steps it takes to the end; times in s. Throws UserError, with `cure` at its end, for more than a
/// run has.
long steps_to(double end, double step, const std::string& cure);

/// Chooses the step, or checks the given one. Throws UserError when it is above the stability limit.
/// Collective.
TimeStep choose_step(MPI_Comm comm, const Model& model, const Scene& scene, const TimeChoice& time);

std::string describe(const TimeStep& step, const Model& model);

/// How the stiffness is worked with, and what part of the nodes it serves many at a time. Collective.
std::string describe_kernel(MPI_Comm comm, const Model& model);

}  // namespace slipscale
