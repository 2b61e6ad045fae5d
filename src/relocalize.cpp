#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "commit.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/log.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/files/progress.hpp"
#include "slipscale/relocalize/comparison_report.hpp"
#include "slipscale/relocalize/fields_reader.hpp"
#include "slipscale/relocalize/local_histories.hpp"
#include "slipscale/relocalize/local_stress.hpp"
#include "slipscale/relocalize/localisation_reader.hpp"
#include "slipscale/relocalize/relocalisation_choice.hpp"
#include "slipscale/relocalize/relocalisation_report.hpp"
#include "slipscale/relocalize/relocalised_file.hpp"
#include "slipscale/relocalize/relocalised_statistics.hpp"
#include "slipscale/relocalize/stress_comparison.hpp"

using namespace slipscale;

namespace {

RankShare share_of(MPI_Comm comm, const Targets& targets) {
  const int rank = rank_of(comm), ranks = ranks_of(comm);
  return rank_share(static_cast<std::size_t>(targets.grid.cells()), rank, ranks);
}

/// A strip has to end at the contact, and there in a straight edge: not so where frames leave the contact out
/// (-fields_box) or tiles overhang.
void refuse_strip_off_contact(const FieldsReader& run, const Targets& targets) {
  const double contact = run.block().lower[1], lowest = bounding_box(targets.grid).lower[1];
  if (std::abs(lowest - contact) > 1e-6 * run.block().extent(1))
    throw UserError(format(
        "-relocalize_correction strip: the stress is relocalised from y = {:g} m on, and the contact is "
        "at y = {:g} m; let an edge of the microstructure and of -fields_box lie on the contact",
        lowest, contact));
}

/// Of a run that took them. Throws UserError when they are damaged.
std::optional<StatisticsReader> statistics_of(MPI_Comm comm, const std::string& folder,
                                              const std::string& option) {
  if (!has_statistics(comm, folder)) return std::nullopt;
  return std::optional<StatisticsReader>(std::in_place, comm, folder, option);
}

void relocalize(Options& options) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const RelocalisationChoice choice = read_relocalisation(options);
  end_reading(options);

  // Both scales, and where their meshes meet.
  const FieldsReader run(comm, choice.run);
  run.require("strain");
  const LocalisationTensors tensors = read_localisation(comm, choice.tensors);
  std::optional<FieldsReader> reference;
  if (choice.reference) reference.emplace(comm, choice.reference->folder, "relocalize_reference");
  const TwoScales scales(run.grid(), tensors.grid,
                         tiling(tensors.grid, tensors.boundary == "periodic", run.block(), choice.origin));
  const Targets targets = reference ? scales.cells_of(reference->grid()) : scales.tiles();
  const RankShare mine = share_of(comm, targets);
  if (choice.strip) refuse_strip_off_contact(run, targets);
  LocalStress local(comm, tensors, run.grid(), choice.recovery, targets, mine, choice.strip);
  LocalHistories histories(comm, targets, mine, choice.points);
  std::optional<StressComparison> comparison;
  if (reference) comparison.emplace(comm, *reference, targets, mine, run.times(), *choice.reference);
  const auto statistics = statistics_of(comm, run.folder(), "relocalize_run");
  const auto expected_statistics = statistics && reference
                                       ? statistics_of(comm, reference->folder(), "relocalize_reference")
                                       : std::optional<StatisticsReader>();
  std::optional<StrainStatistics> mean_strain;
  if (statistics) mean_strain = strain_statistics(*statistics, run.grid());
  if (expected_statistics) StressComparison::refuse_other_window(*expected_statistics, *statistics);
  options.refuse_unknown();
  print(describe(run, tensors, targets, local));
  if (statistics && reference && !expected_statistics)
    print("note: the heterogeneous run has no statistics.h5, so statistics are not compared\n");

  const OutputFolder folder(comm, choice.folder,
                            {"relocalized.h5", "relocalized.xdmf", "relocalized_statistics.h5",
                             "relocalized_statistics.xdmf", "comparison.yaml"});
  RelocalisedFile file(comm, targets.grid, mine, folder.path());
  std::vector<PlaneTensor> macro_strain(static_cast<std::size_t>(run.grid().cells()));
  Progress progress(choice.progress, 0, static_cast<double>(run.times().size()));
  for (std::size_t frame = 0; frame < run.times().size(); ++frame) {
    const double time = run.times()[frame];
    run.read(frame, "strain", macro_strain);
    local.update(macro_strain);
    file.write(time, local.stress(), local.strain(), local.homogeneous_stress());
    const auto* expected = comparison ? comparison->reference_stress(frame) : nullptr;
    if (expected) comparison->add_frame(local);
    histories.add(time, local, expected);
    progress.step(static_cast<std::int64_t>(frame), static_cast<double>(frame + 1));
  }
  progress.finish();
  file.close(histories.all());

  if (statistics)
    write_relocalised_statistics(comm, *statistics, *mean_strain, targets.grid, mine, local, folder.path());
  if (expected_statistics) comparison->add_statistics(*expected_statistics, *mean_strain, local);
  if (comparison) {
    Comparison found = comparison->finish();
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
