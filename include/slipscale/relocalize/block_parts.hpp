#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "slipscale/mesh/plane_grid.hpp"

namespace slipscale {

/// The cells, or one rank's share of them, on which stresses are compared.
struct ComparedCells {
  std::vector<double> area;       ///< [cells], m²
  std::vector<Vector2> centroid;  ///< [cells], m
  std::vector<int> region;        ///< [cells], index of the region's name
};

/// Where the block lies and what counts as its boundary layer and its bulk.
struct BlockZones {
  Box block;
  double contact_height = 0;  ///< y of the contact boundary, m
  double layer = 0;  ///< depth of the boundary layer, m: 0 < y − contact_height < layer (-relocalize_layer)
  double bulk = 0;   ///< the bulk lies farther than this from every edge, m (-relocalize_bulk)
};

/// A part of the block by the numbers of its cells. A cell may lie in several parts.
struct BlockPart {
  std::string name;
  bool phase = false;  ///< named by the mesh: a region
  std::vector<std::size_t> cells;
};

/// `all`, `layer`, `bulk`, then one part for each region name: the same parts on every rank, some of them
/// without cells there. A cell belongs where its centroid lies. Throws UserError when the layer has no depth
/// or no bulk is left; the same on every rank.
std::vector<BlockPart> block_parts(const ComparedCells& cells, const std::vector<std::string>& regions,
                                   const BlockZones& zones);

}  // namespace slipscale
