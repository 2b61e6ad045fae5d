#include <optional>

#include "commit.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/files/progress.hpp"
#include "slipscale/relocalize/comparison_report.hpp"
#include "slipscale/relocalize/local_histories.hpp"
#include "slipscale/relocalize/local_interfaces.hpp"
#include "slipscale/relocalize/local_stress.hpp"
#include "slipscale/relocalize/relocalisation_report.hpp"
#include "slipscale/relocalize/relocalisation_sources.hpp"
#include "slipscale/relocalize/relocalised_file.hpp"
#include "slipscale/relocalize/run_record.hpp"
#include "slipscale/relocalize/stress_comparison.hpp"

using namespace slipscale;

namespace {

/// As run.yaml tells it, without which nothing is periodic.
Seam seam_of(MPI_Comm comm, const FieldsReader& run) {
  const RunRecord record = read_run_record(comm, run.folder());
  const auto along = record.find("run_periodic");
  Seam seam{{}, run.block().lower};
  if (along == record.end()) return seam;
  for (int axis = 0; axis < 2; ++axis)
    if (along->second.find("xy"[axis]) != std::string::npos) seam.period[axis] = run.block().extent(axis);
  return seam;
}

void relocalize(Options& options) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const RelocalisationChoice choice = read_relocalisation(options);
  end_reading(options);

  // Both scales, and where their meshes meet.
  const RelocalisationSources sources(comm, choice);
  const FieldsReader& run = sources.run;
  const Targets targets = sources.targets(choice);
  const RankShare mine =
      rank_share(static_cast<std::size_t>(targets.grid.cells()), rank_of(comm), ranks_of(comm));
  if (choice.strip) refuse_strip_off_contact(run, targets);
  LocalStress local(comm, sources.tensors, run.grid(), choice.recovery, targets, mine, choice.strip);
  LocalHistories histories(comm, targets, mine, choice.points);
  std::optional<LocalInterfaces> interfaces;
  if (choice.interfaces) interfaces.emplace(comm, targets, mine, *choice.interfaces, seam_of(comm, run));
  std::optional<StressComparison> comparison;
  if (sources.reference)
    comparison.emplace(comm, *sources.reference, targets, mine, run.times(), *choice.reference);
  options.refuse_unknown();
  print(describe(run, sources.tensors, targets, local) + (interfaces ? interfaces->describe() : ""));
  const std::vector<std::string> notes = misfits(comm, sources);
  print_notes(notes);
  if (interfaces) print_notes(interfaces->notes());

  const OutputFolder folder(
      comm, choice.folder,
      {"relocalized.h5", "relocalized.xdmf", "relocalized_statistics.h5", "relocalized_statistics.xdmf",
       "comparison.yaml", "interfaces.h5", "interfaces.xdmf", "interfaces.yaml"});
  RelocalisedFile file(comm, targets.grid, mine, folder.path(), notes);
  if (interfaces) interfaces->open(folder.path(), run.times().size());
  std::vector<PlaneTensor> macro_strain(static_cast<std::size_t>(run.grid().cells()));
  Progress progress(choice.progress, 0, static_cast<double>(run.times().size()));
  for (std::size_t frame = 0; frame < run.times().size(); ++frame) {
    const double time = run.times()[frame];
    run.read(frame, "strain", macro_strain);
    local.update(macro_strain);
    file.write(time, local.stress(), local.strain(), local.homogeneous_stress());
    if (interfaces) interfaces->add(time, local);
    const auto* expected = comparison ? comparison->reference_stress(frame) : nullptr;
    if (expected) comparison->add_frame(local);
    histories.add(time, local, expected);
    progress.step(static_cast<std::int64_t>(frame), static_cast<double>(frame + 1));
  }
  progress.finish();
  file.close(histories.all());
  if (interfaces) print("\n" + interfaces->close(folder) + "\n");

  if (sources.statistics)
    write_relocalised_statistics(comm, *sources.statistics, *sources.mean_strain, targets.grid, mine, local,
                                 folder.path());
  if (sources.reference_statistics)
    comparison->add_statistics(*sources.reference_statistics, *sources.mean_strain, local);
  if (comparison) {
    Comparison found = comparison->finish();
    found.notes = notes;
    found.probes = histories.agreements(targets.grid.regions);
    folder.write_text("comparison.yaml", comparison_yaml(found));
    print("\n" + describe(found));
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(
      argc, argv,
      {"relocalize",
       "Stress and strain of the phases over time, C : A : E, from a homogeneous run of slide and the "
       "localisation tensors of homogenize; compared with a heterogeneous run where there is one.",
       relocalisation_schema(), relocalize, commit});
}
