// The time step that a scene takes, and what is said of it before the first one.
#include <algorithm>
#include <cmath>

#include "slipscale/base/print.hpp"
#include "slipscale/dynamics/scene.hpp"

namespace slipscale {
namespace {

/// Far above what anybody can wait for, far below where steps can no longer be counted.
constexpr double most_steps = 1e15;

}  // namespace

long steps_to(double end, double step, const std::string& cure) {
  const double count = std::ceil(end / step * (1 - 1e-12));
  if (!(count <= most_steps))  // nor is it a number where the step is next to nothing
    throw UserError(
        format("-time_end is {:g} s, which takes {:g} steps of {:g} s; a run has at most {:g} steps", end,
               count, step, most_steps) +
        cure);
  return static_cast<long>(count);
}

TimeStep choose_step(MPI_Comm comm, const Model& model, const Scene& scene, const TimeChoice& time) {
  TimeStep choice;
  choice.frequency = largest_frequency(comm, model);
  choice.limit = stable_step(choice.frequency.sharp, scene.beta2, scene.damping);
  choice.safe_limit = stable_step(choice.frequency.safe, scene.beta2, scene.damping);
  if (!std::isfinite(choice.frequency.sharp))
    throw UserError(
        "the largest frequency of the body cannot be computed: the stiffness or the mass of a cell is beyond "
        "double precision; check the stiffness and density of the materials, and the unit of the mesh, which "
        "is read in m");
  if (!(choice.limit > 0))
    throw UserError(
        format("-damping_mass {:g} 1/s and -damping_stiffness {:g} s leave no stable step; give less damping",
               scene.damping.mass, scene.damping.stiffness));
  choice.step = time.step ? *time.step : std::min(time.safety * choice.limit, time.end);
  if (!(choice.step <= choice.limit))
    throw UserError(
        format("-time_step is {} s, above the stable step of {:.6g} s for this mesh, beta2 and damping; "
               "use at most {:.4g} or auto",
               apart_from(choice.limit, choice.step, 6), choice.limit, 0.99 * choice.limit));
  choice.count = steps_to(time.end, choice.step,
                          time.step ? ", so give a longer -time_step, or auto"
                                    : "; where the step is far too short, look for the cause in the "
                                      "materials, in -damping_stiffness or in the unit of the mesh");
  return choice;
}

std::string describe_kernel(MPI_Comm comm, const Model& model) {
  const double repeating = model.repeating(comm);
  if (!model.kernel.runs) return "stiffness: every pair of nodes is visited\n";
  return format(
      "stiffness: the rows of {:.1f} % of the nodes repeat and are summed together ({} instructions)\n",
      100 * repeating, name_of(model.kernel.instructions));
}

namespace {

/// What sets the step, what the mesh loses by it, and what helps.
std::string describe_critical(const TimeStep& step, const Mesh& mesh) {
  const CriticalCell& cell = step.frequency.critical;
  // The bound that a cell makes is sharp where all are alike; the body's own limit lies above that of its
  // worst.
  const double sharper = step.limit / step.safe_limit, loss = std::min(1.0, cell.of_median * sharper),
               in_region = std::min(1.0, cell.of_median_in_region * sharper);
  constexpr double even = 0.8;
  std::string text = format(
      "the step is set by cell {} at ({}, {}) in region '{}', angles {:.0f} to {:.0f} degrees; it is "
      "{:.2f} of what the median cell allows",
      cell.number, engineering(cell.centre[0], "m"), engineering(cell.centre[1], "m"),
      mesh.regions[cell.region].name, cell.smallest_angle, cell.largest_angle, loss);
  if (loss >= even) return text + "\n";
  if (in_region >= even)
    return text + format(
                      " and {:.2f} of what the median cell of the region does: cells {:.1f} times as large "
                      "in this region would cost no more steps than the others\n",
                      in_region, 1 / loss);
  return text +
         format(": more even cells, as of morphology -cell grid, need up to {:.1f} times fewer steps\n",
                1 / loss);
}

}  // namespace

std::string describe(const TimeStep& step, const Model& model) {
  const Mesh& mesh = model.mesh;
  const Vector2 size{mesh.upper[0] - mesh.lower[0], mesh.upper[1] - mesh.lower[1]};
  std::string text = "block " + engineering(size[0], "m") + " x " + engineering(size[1], "m") +
                     ", shortest edge " + engineering(mesh.shortest_edge, "m") + "\n";
  for (std::size_t r = 0; r < model.materials.size(); ++r) {
    const Material& material = model.materials[r];
    const WaveSpeeds speeds = wave_speeds(material, 0, 1);
    text += format("  waves along y in {}: {:.5g} and {:.5g} m/s, crossing the height in {}",
                   mesh.regions[r].name, speeds.fast, speeds.slow, engineering(size[1] / speeds.fast, "s"));
    if (material.grading) {
      const WaveSpeeds most = wave_speeds(material.grading->fastest, 0, 1);
      text += format(" where they are slowest; {:.5g} and {:.5g} m/s, {}, where fastest", most.fast,
                     most.slow, engineering(size[1] / most.fast, "s"));
    }
    text += "\n";
  }
  text += format("largest frequency: {:.4g} 1/s (Lanczos), at most {:.4g} 1/s (largest element)\n",
                 step.frequency.sharp, step.frequency.safe);
  text += "stable step: " + engineering(step.limit, "s") + " (Lanczos), " +
          engineering(step.safe_limit, "s") +
          " (largest element); step used: " + engineering(step.step, "s") +
          format(" ({:.3f} of the limit), {} steps\n", step.step / step.limit, step.count);
  return text + describe_critical(step, mesh);
}

}  // namespace slipscale
