#include "slipscale/relocalize/local_interfaces.hpp"

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/relocalize/boundary_layer.hpp"

namespace slipscale {
namespace {

std::vector<PetscInt> cells_of(const StressForces& forces, const RankShare& mine) {
  std::vector<PetscInt> own;
  for (const int cell : forces.cells())
    if (static_cast<std::size_t>(cell) >= mine.begin && static_cast<std::size_t>(cell) < mine.end)
      own.push_back(cell);
  return own;
}

}  // namespace

LocalInterfaces::LocalInterfaces(MPI_Comm comm, const Targets& targets, const RankShare& mine,
                                 const InterfaceChoice& choice)
    : comm_(comm),
      choice_(choice),
      mine_(mine),
      found_(find_inclusions(targets.grid, inclusions_region(choice.region, targets.grid.regions),
                             joined_points(targets.grid))),
      of_stress_(targets.grid, found_),
      gather_(comm, cells_of(of_stress_, mine)) {
  refuse_no_interface(choice.region, found_.inclusions);
  for (const PetscInt cell : cells_of(of_stress_, mine))
    own_.push_back(static_cast<int>(static_cast<std::size_t>(cell) - mine.begin));
}

std::string LocalInterfaces::describe() const {
  return format("interfaces of {} inclusions of region '{}', {} nodes\n", found_.inclusions.size(),
                choice_.region, found_.inclusions.interface.size());
}

void LocalInterfaces::open(const std::string& folder, std::size_t frames) {
  if (!is_root(comm_)) return;
  file_ = std::make_unique<InterfacesFile>(folder + "/interfaces.h5", found_.inclusions, choice_,
                                           std::vector<std::string>{"", "homogeneous"},
                                           static_cast<double>(frames));
}

std::vector<Vector2> LocalInterfaces::forces(const std::vector<PlaneTensor>& stress) const {
  std::vector<double> rows;
  rows.reserve(3 * own_.size());
  for (const int place : own_) rows.insert(rows.end(), stress[place].begin(), stress[place].end());
  const auto all = gather_(rows, 3);
  if (!is_root(comm_)) return {};
  std::vector<PlaneTensor> needed(all.size() / 3);
  for (std::size_t k = 0; k < needed.size(); ++k) needed[k] = {all[3 * k], all[3 * k + 1], all[3 * k + 2]};
  return of_stress_(needed);
}

void LocalInterfaces::add(double time, const LocalStress& local) {
  const auto relocalised = forces(local.stress()), homogeneous = forces(local.homogeneous_stress());
  if (file_) file_->write(time, {relocalised, homogeneous});
  share_fault();
}

void LocalInterfaces::share_fault() const { stop_together(comm_, file_ ? file_->series().fault() : ""); }

std::string LocalInterfaces::close(const OutputFolder& folder) {
  std::string report, shown, headline;
  if (file_) {
    report = file_->report();
    shown = file_->xdmf("interfaces.h5");
    headline = file_->headline();
    file_->series().close();
  }
  share_fault();
  folder.write_text("interfaces.yaml", report);
  folder.write_text("interfaces.xdmf", shown);
  return headline;
}

}  // namespace slipscale
