#include "slipscale/relocalize/tiling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr double box_tolerance = 1e-6;  ///< of the block's size
constexpr double seam = 1e-9;           ///< of a period: what rounding may put on the wrong side

std::string shown(const Box& box) {
  return format("[{:.7g}, {:.7g}] x [{:.7g}, {:.7g}] m", box.lower[0], box.upper[0], box.lower[1],
                box.upper[1]);
}

bool same_box(const Box& a, const Box& b) {
  const double little = box_tolerance * std::max(b.extent(0), b.extent(1));
  for (int d = 0; d < 2; ++d)
    if (std::abs(a.lower[d] - b.lower[d]) > little || std::abs(a.upper[d] - b.upper[d]) > little)
      return false;
  return true;
}

void refuse_unless_rectangular(const PlaneGrid& micro, double hole_area, const Box& box) {
  const std::vector<double> parts = areas(micro);
  const double whole = std::accumulate(parts.begin(), parts.end(), hole_area);
  if (std::abs(whole - box.extent(0) * box.extent(1)) > box_tolerance * whole)
    throw UserError("the periodic cell of -relocalize_tensors does not fill its rectangle " + shown(box) +
                    ", so it cannot tile the block; homogenise a rectangular cell");
}

/// Before the copies are made.
void refuse_too_many(const PlaneGrid& micro, const Box& unit, const Box& block) {
  constexpr double most_copies = 1e5, most_cells = 1e8;
  const double across = block.extent(0) / unit.extent(0), up = block.extent(1) / unit.extent(1);
  if (across * up > most_copies || across * up * micro.cells() > most_cells)
    throw UserError(format(
        "the block of -relocalize_run, {:g} m by {:g} m, would hold {:.4g} by {:.4g} copies of the "
        "periodic cell of -relocalize_tensors, {:g} m by {:g} m: {:.3g} cells; draw both in metres, or "
        "relocalise a part of the run (-fields_box)",
        block.extent(0), block.extent(1), std::ceil(across), std::ceil(up), unit.extent(0), unit.extent(1),
        across * up * micro.cells()));
}

/// First and one past the last copy along an axis that reaches into the block.
std::array<int, 2> copies(const Tiling& tiling, const Box& block, int axis) {
  const double period = tiling.unit.extent(axis);
  return {static_cast<int>(std::floor((block.lower[axis] - tiling.origin[axis]) / period + seam)),
          static_cast<int>(std::ceil((block.upper[axis] - tiling.origin[axis]) / period - seam))};
}

}  // namespace

Tiling tiling(const PlaneGrid& micro, bool periodic, const Box& block, const std::optional<Vector2>& origin,
              double hole_area) {
  const Box unit = bounding_box(micro);
  if (!origin && same_box(unit, block)) return {unit, unit.lower, false};
  if (!periodic)
    throw UserError("-relocalize_tensors are those of a whole block, and their mesh " + shown(unit) +
                    " is not the block " + shown(block) +
                    (same_box(unit, block) ? " with another -relocalize_origin" : " of -relocalize_run") +
                    "; homogenise that block, or a periodic cell (-cell_boundary periodic)");
  refuse_unless_rectangular(micro, hole_area, unit);
  refuse_too_many(micro, unit, block);
  return {unit, origin.value_or(unit.lower), true};
}

Vector2 Tiling::micro_point(const Vector2& x) const {
  if (!repeats) return x;
  Vector2 local{};
  for (int d = 0; d < 2; ++d) {
    const double offset = x[d] - origin[d], period = unit.extent(d);
    local[d] = unit.lower[d] + std::clamp(offset - std::floor(offset / period) * period, 0.0, period);
  }
  return local;
}

TwoScales::TwoScales(const PlaneGrid& macro, const PlaneGrid& micro, const Tiling& tiling)
    : macro_(macro),
      micro_(micro),
      tiling_(tiling),
      block_(bounding_box(macro)),
      macro_location_(macro),
      micro_location_(micro) {}

std::optional<Site> TwoScales::site(const Vector2& x) const {
  Site site{macro_location_.find(x), micro_location_.find(tiling_.micro_point(x)).cell};
  if (site.macro.cell == CellPlace::none || site.micro_cell == CellPlace::none) return std::nullopt;
  return site;
}

Targets TwoScales::tiles() const {
  if (!tiling_.repeats) return cells_of(micro_);
  Targets targets;
  targets.grid.regions = micro_.regions;
  const std::vector<Vector2> middles = centres(micro_);
  const auto columns = copies(tiling_, block_, 0), rows = copies(tiling_, block_, 1);
  std::vector<int> kept;
  for (int j = rows[0]; j < rows[1]; ++j)
    for (int i = columns[0]; i < columns[1]; ++i) {
      const Vector2 shift{tiling_.origin[0] - tiling_.unit.lower[0] + i * tiling_.unit.extent(0),
                          tiling_.origin[1] - tiling_.unit.lower[1] + j * tiling_.unit.extent(1)};
      kept.clear();
      for (int cell = 0; cell < micro_.cells(); ++cell) {
        const CellPlace place =
            macro_location_.find({middles[cell][0] + shift[0], middles[cell][1] + shift[1]});
        if (place.cell == CellPlace::none) continue;
        kept.push_back(cell);
        targets.sites.push_back({place, cell});
      }
      append_cells(targets.grid, micro_, kept, shift);
      targets.source_cell.insert(targets.source_cell.end(), kept.begin(), kept.end());
    }
  if (targets.sites.empty())
    throw UserError("no cell of -relocalize_tensors has its centre in the block " + shown(block_) +
                    " of -relocalize_run; refine the mesh of the periodic cell");
  return targets;
}

Targets TwoScales::cells_of(const PlaneGrid& mesh) const {
  Targets targets;
  targets.grid.regions = mesh.regions;
  for (int cell = 0; cell < mesh.cells(); ++cell)
    if (const auto found = site(centre(mesh, cell))) {
      targets.sites.push_back(*found);
      targets.source_cell.push_back(cell);
    }
  if (targets.sites.empty())
    throw UserError("the mesh of -relocalize_reference " + shown(bounding_box(mesh)) +
                    " shares no place with the block " + shown(block_) +
                    " of -relocalize_run; compare runs of the same block");
  append_cells(targets.grid, mesh, targets.source_cell, {});
  return targets;
}

int count_of_other_regions(const Targets& targets, const PlaneGrid& micro) {
  int others = 0;
  for (std::size_t t = 0; t < targets.sites.size(); ++t)
    others += targets.grid.regions[targets.grid.region[t]] !=
              micro.regions[micro.region[targets.sites[t].micro_cell]];
  return others;
}

}  // namespace slipscale
