#include "slipscale/relocalize/relocalisation_sources.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/relocalize/localisation_reader.hpp"
#include "slipscale/relocalize/run_record.hpp"
#include "slipscale/relocalize/stress_comparison.hpp"

namespace slipscale {
namespace {

/// Of a run that took them. Throws UserError when they are damaged.
void read_statistics(MPI_Comm comm, const FieldsReader& run, const std::string& option,
                     std::optional<StatisticsReader>& found) {
  if (has_statistics(comm, run.folder())) found.emplace(comm, run.folder(), option);
}

/// Largest |σ − C : ε| over the largest |σ| of the last frame, `stiffness` by region; absent without both.
std::optional<double> distance_of_material(const FieldsReader& run,
                                           const std::vector<Eigen::Matrix3d>& stiffness) {
  if (!run.has("stress") || !run.has("strain")) return std::nullopt;
  std::vector<PlaneTensor> strain(static_cast<std::size_t>(run.grid().cells())), stress(strain.size());
  run.read(run.times().size() - 1, "strain", strain);
  run.read(run.times().size() - 1, "stress", stress);
  double most = 0, apart = 0;
  for (std::size_t cell = 0; cell < strain.size(); ++cell) {
    const Eigen::Map<const Eigen::Vector3d> e(strain[cell].data()), s(stress[cell].data());
    most = std::max(most, s.cwiseAbs().maxCoeff());
    apart = std::max(apart, (s - stiffness[run.grid().region[cell]] * e).cwiseAbs().maxCoeff());
  }
  return most > 0 ? std::optional<double>(apart / most) : std::nullopt;
}

/// Of the regions of a run, those of the tensors that have their names; none where one has not.
std::vector<Eigen::Matrix3d> stiffness_by_name(const FieldsReader& run, const LocalisationTensors& tensors) {
  std::vector<Eigen::Matrix3d> found;
  for (const std::string& region : run.grid().regions) {
    const auto at = std::ranges::find(tensors.grid.regions, region);
    if (at == tensors.grid.regions.end()) return {};
    found.push_back(tensors.stiffness[static_cast<std::size_t>(at - tensors.grid.regions.begin())]);
  }
  return found;
}

void compare_materials(const RelocalisationSources& sources, std::vector<std::string>& notes) {
  constexpr double same = 1e-3;
  const std::vector<Eigen::Matrix3d> effective(sources.run.grid().regions.size(), sources.tensors.effective);
  if (const auto apart = distance_of_material(sources.run, effective); apart && *apart > same)
    notes.push_back(
        format("the stress of -relocalize_run is not C_eff : strain of -relocalize_tensors, by {:.2g} % of "
               "the largest: it ran with another material than these tensors belong to (-material_file)",
               100 * *apart));
  if (!sources.reference) return;
  const auto phases = stiffness_by_name(*sources.reference, sources.tensors);
  if (phases.empty()) return;
  if (const auto apart = distance_of_material(*sources.reference, phases); apart && *apart > same)
    notes.push_back(
        format("the stress of -relocalize_reference is not C : strain of the phases of -relocalize_tensors, "
               "by {:.2g} % of the largest: its phases are of other materials",
               100 * *apart));
}

void repeat_doubts(const RunRecord& record, const std::string& option, std::vector<std::string>& notes) {
  for (const std::string& doubt : doubts_of(record))
    notes.push_back("-" + option + " ran with a homogenised material that is doubtful, that " + doubt);
}

void compare_records(MPI_Comm comm, const RelocalisationSources& sources, std::vector<std::string>& notes) {
  const RunRecord run = read_run_record(comm, sources.run.folder());
  repeat_doubts(run, "relocalize_run", notes);
  if (!sources.reference) return;
  const RunRecord reference = read_run_record(comm, sources.reference->folder());
  repeat_doubts(reference, "relocalize_reference", notes);
  std::string differences;
  for (const std::string& each : differences_of_scene(run, reference))
    differences += (differences.empty() ? "" : ", ") + each;
  if (!differences.empty())
    notes.push_back("-relocalize_run and -relocalize_reference are runs of different scenes: " + differences);
  const auto checksum = reference.find("run_mesh_checksum");
  if (sources.tensors.boundary != "periodic" && checksum != reference.end() &&
      !sources.tensors.mesh_checksum.empty() && checksum->second != sources.tensors.mesh_checksum)
    notes.push_back(
        "-relocalize_tensors and -relocalize_reference come from different mesh files: where they draw the "
        "interfaces differently, so do their stresses");
}

}  // namespace

RelocalisationSources::RelocalisationSources(MPI_Comm comm, const RelocalisationChoice& choice)
    : run(comm, choice.run), tensors(read_localisation(comm, choice.tensors)) {
  run.require("strain");
  if (choice.reference) reference.emplace(comm, choice.reference->folder, "relocalize_reference");
  read_statistics(comm, run, "relocalize_run", statistics);
  if (!statistics) return;
  mean_strain = strain_statistics(*statistics, run.grid());
  if (!reference) return;
  read_statistics(comm, *reference, "relocalize_reference", reference_statistics);
  if (reference_statistics) StressComparison::refuse_other_window(*reference_statistics, *statistics);
}

Targets RelocalisationSources::targets(const RelocalisationChoice& choice) const {
  const TwoScales scales(
      run.grid(), tensors.grid,
      tiling(tensors.grid, tensors.boundary == "periodic", run.block(), choice.origin, tensors.hole_area));
  return reference ? scales.cells_of(reference->grid()) : scales.tiles();
}

std::vector<std::string> misfits(MPI_Comm comm, const RelocalisationSources& sources) {
  std::vector<std::string> notes;
  compare_materials(sources, notes);
  compare_records(comm, sources, notes);
  if (sources.statistics && sources.reference && !sources.reference_statistics)
    notes.push_back("the heterogeneous run has no statistics.h5, so statistics are not compared");
  return notes;
}

void refuse_strip_off_contact(const FieldsReader& run, const Targets& targets) {
  const double contact = run.block().lower[1], lowest = bounding_box(targets.grid).lower[1];
  if (std::abs(lowest - contact) > 1e-6 * run.block().extent(1))
    throw UserError(format(
        "-relocalize_correction strip: the stress is relocalised from y = {:g} m on, and the contact is "
        "at y = {:g} m; let an edge of the microstructure and of -fields_box lie on the contact",
        lowest, contact));
}

}  // namespace slipscale
