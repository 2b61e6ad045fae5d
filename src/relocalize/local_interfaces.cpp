#include "slipscale/relocalize/local_interfaces.hpp"

#include <algorithm>
#include <cmath>

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

/// The grid with its points moved into the block, those of the far side of a seam onto the near one.
PlaneGrid wrapped(PlaneGrid grid, const Seam& seam) {
  constexpr double rounding = 1e-9;  // of a period
  for (Vector2& point : grid.points)
    for (int axis = 0; axis < 2; ++axis)
      if (const double period = seam.period[axis]; period > 0)
        point[axis] -= std::floor((point[axis] - seam.lower[axis]) / period + rounding) * period;
  return grid;
}

/// Whether each of the edges (ascending) is one of a cell of another region.
std::vector<char> beside_others(const PlaneGrid& grid, int region, const std::vector<int>& node,
                                const std::vector<std::array<int, 2>>& edges) {
  std::vector<char> mark(edges.size(), 0);
  for (int cell = 0; cell < grid.cells(); ++cell) {
    const int begin = grid.first[cell], count = grid.corner_count(cell);
    for (int k = 0; k < count && grid.region[cell] != region; ++k) {
      const int a = node[grid.corners[begin + k]], b = node[grid.corners[begin + (k + 1) % count]];
      const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
      const auto found = std::ranges::lower_bound(edges, ends);
      if (found != edges.end() && *found == ends) mark[found - edges.begin()] = 1;
    }
  }
  return mark;
}

}  // namespace

RegionInclusions inclusions_across(const PlaneGrid& grid, int region, const Seam& seam) {
  if (seam.period[0] == 0 && seam.period[1] == 0) return find_inclusions(grid, region, joined_points(grid));
  const std::vector<int> node = joined_points(wrapped(grid, seam));
  RegionInclusions found = find_inclusions(grid, region, node);
  found.cells.period = seam.period;
  found.cells.lower = seam.lower;
  found.inclusions =
      find_inclusions(found.cells, beside_others(grid, region, node, outline_edges(found.cells)));
  return found;
}

LocalInterfaces::LocalInterfaces(MPI_Comm comm, const Targets& targets, const RankShare& mine,
                                 const InterfaceChoice& choice, const Seam& seam)
    : comm_(comm),
      choice_(choice),
      mine_(mine),
      found_(inclusions_across(targets.grid, inclusions_region(choice.region, targets.grid.regions), seam)),
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

std::vector<std::string> LocalInterfaces::notes() const {
  const std::string doubt = doubt_about(choice_.region, found_.inclusions);
  return doubt.empty() ? std::vector<std::string>{} : std::vector{doubt};
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
