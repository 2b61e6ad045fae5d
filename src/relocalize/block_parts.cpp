#include "slipscale/relocalize/block_parts.hpp"

#include <algorithm>
#include <numeric>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

void check(const BlockZones& zones) {
  if (!(zones.layer > 0))
    throw UserError(
        format("-relocalize_layer {:g} gives the boundary layer no depth; choose a depth above 0 m, "
               "about one cell of the microstructure",
               zones.layer));
  const double side = std::min(zones.block.extent(0), zones.block.extent(1));
  if (!(zones.bulk >= 0 && 2 * zones.bulk < side))
    throw UserError(
        format("-relocalize_bulk {:g} leaves no bulk in a block whose smaller side is {:g} m; choose a "
               "distance from "
               "its edges of at least 0 and below {:g} m",
               zones.bulk, side, side / 2));
}

}  // namespace

std::vector<BlockPart> block_parts(const ComparedCells& cells, const std::vector<std::string>& regions,
                                   const BlockZones& zones) {
  check(zones);
  std::vector<BlockPart> parts{{"all", false, {}}, {"layer", false, {}}, {"bulk", false, {}}};
  const std::size_t phases = parts.size();
  const auto& [low, high] = zones.block;
  for (const std::string& region : regions) parts.push_back({region, true, {}});
  parts[0].cells.resize(cells.area.size());
  std::iota(parts[0].cells.begin(), parts[0].cells.end(), std::size_t{0});
  for (std::size_t c = 0; c < cells.area.size(); ++c) {
    const auto [x, y] = cells.centroid[c];
    const double above = y - zones.contact_height;
    const double inside = std::min({x - low[0], high[0] - x, y - low[1], high[1] - y});
    if (above > 0 && above < zones.layer) parts[1].cells.push_back(c);
    if (inside > zones.bulk) parts[2].cells.push_back(c);
    parts.at(phases + static_cast<std::size_t>(cells.region[c])).cells.push_back(c);
  }
  return parts;
}

}  // namespace slipscale
