#include "slipscale/modes/sliding_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "real_modes.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr double beyond = 1.4;  ///< real modes are taken up to this many times the highest frequency

/// The same modes under the scheme's own law, in the order of `modes`; those that are lost stay empty.
void find_scheme_modes(ModesBasis& basis, SlidingLaw law, const SchemeStep& step, double tolerance,
                       std::vector<ReportedMode>& modes) {
  law.scheme = step;
  std::vector<SlidingMode> start;
  for (const ReportedMode& each : modes) start.push_back(each.mode);
  const ModesFound found = improve(basis, law, std::move(start), tolerance);
  for (std::size_t k = 0; k < modes.size(); ++k)
    if (std::isfinite(std::norm(found.modes[k].exponent))) modes[k].scheme = found.modes[k];
}

}  // namespace

ModesBasis basis_of_real_modes(const SteadySliding& state, const ModesChoice& choice) {
  const PetscInt unknowns = state.body->free().total();
  if (choice.count > unknowns)
    throw UserError(format("-modes_count is {}, but the body has only {} free components; give at most that",
                           choice.count, unknowns));
  ModesBasis basis(*state.body);
  basis.add(real_modes(*state.body, beyond * 2 * std::numbers::pi * choice.to, choice.basis).shape, 1e-6);
  return basis;
}

ModesReport find_sliding_modes(ModesBasis& basis, const SteadySliding& state, const Scene& scene,
                               const ModesChoice& choice, const std::optional<SchemeStep>& step) {
  const Model& model = state.body->model();
  const SlidingLaw law = sliding_law(scene);
  ModesReport report;
  report.regions = model.mesh.region_names();
  report.time = law.time;
  report.unknowns = state.body->free().total();
  report.ranks = ranks_of(state.body->comm());
  report.basis_start = static_cast<PetscInt>(basis.size());
  report.search = find_modes(basis, law, {choice.to, choice.count, choice.tolerance});
  for (SlidingMode& mode : report.search.modes) report.modes.push_back({std::move(mode), {}, {}});
  report.search.modes.clear();
  if (step) {
    report.step = step->step;
    find_scheme_modes(basis, law, *step, choice.tolerance, report.modes);
  }
  const ModeMeasurement measurement(*state.body, *model.mesh.find_boundary(scene.surface->boundary));
  for (ReportedMode& each : report.modes) {
    each.mode.vector.conservativeResizeLike(Eigen::VectorXcd::Zero(basis.size()));
    each.measures = measurement.measure(basis, law, each.mode);
  }
  report.basis_end = static_cast<PetscInt>(basis.size());
  return report;
}

std::vector<std::string> remarks_on_modes(MPI_Comm comm, const Model& model, const Scene& scene) {
  const SlidingLaw law = sliding_law(scene);
  if (law.coefficient == 0) return {};
  double speed = 0, edge = std::numeric_limits<double>::infinity();
  for (const Material& material : model.materials) speed = std::max(speed, wave_speeds(material, 1, 0).slow);
  for (const BoundaryEdge& each : model.mesh.find_boundary(scene.surface->boundary)->edges)
    edge = std::min(edge, std::hypot(each.outward[0], each.outward[1]));
  MPI_Allreduce(MPI_IN_PLACE, &edge, 1, MPI_DOUBLE, MPI_MIN, comm);
  constexpr double edges = 2;
  const double reach = speed * law.time;
  if (reach >= edges * edge) return {};
  const std::string what =
      law.time == 0 ? "friction has no memory (Coulomb's law)"
                    : format("the memory of friction is short beside the mesh (c_s T is {}, an edge {})",
                             engineering(reach, "m"), engineering(edge, "m"));
  return {
      what +
      ": the waves that grow fastest may be those at grid scale, which are the mesh's and not the body's, "
      "and grow twice as fast on a mesh twice as fine; a relaxation time of two edges over the shear wave "
      "speed removes them"};
}

}  // namespace slipscale
