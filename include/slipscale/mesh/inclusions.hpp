#pragma once

#include <array>
#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/mesh/plane_grid.hpp"

namespace slipscale {

/// The cells of one region of a whole mesh, in the order of their numbers, whichever rank holds them.
struct RegionCells {
  std::vector<int> number;         ///< [cells] in the whole mesh, ascending
  std::vector<int> first{0};       ///< [cells + 1] where a cell's corners start in the next two
  std::vector<int> node;           ///< number of each corner's node: cells that share it have the same
  std::vector<Vector2> corner;     ///< counter-clockwise, unwrapped across a periodic seam, m
  std::array<double, 2> period{};  ///< of a periodic mesh along x and y, m; 0: none
  Vector2 lower{};                 ///< lower left corner of the block, m

  int size() const { return static_cast<int>(number.size()); }
};

/// A node of an inclusion's outline where another region begins.
struct InterfaceNode {
  int inclusion, node;
  Vector2 position{};  ///< undeformed, m; across a periodic seam beside the rest of the inclusion
  Vector2 normal{};    ///< unit, out of the inclusion: the mean of the two edges that meet here
  double length = 0;   ///< of the boundary that belongs to the node, m: |∫ N n ds|
  double angle = 0;    ///< about the inclusion's centre from +x counter-clockwise, in [0, 2π), rad
  bool outer = false;  ///< also on the outer boundary of the body, whose loads it may carry
};

/// Normal (tension > 0) and shear traction, Pa, that a nodal force [N/m] on the inclusion makes: along the
/// normal out of the inclusion, and along what lies counter-clockwise of it.
std::array<double, 2> tractions(const InterfaceNode& node, const Vector2& force);

/// The inclusions of a composite: the parts of a region that hang together across edges of cells, across a
/// periodic seam as well. In the order of their centres, from the bottom upwards and from left to right where
/// centres are equally high (to a millionth of the region's extent).
struct Inclusions {
  std::vector<int> of_cell;              ///< [cells of the region]
  std::vector<Vector2> centre;           ///< of area, m; on a periodic mesh within the block
  std::vector<double> area;              ///< m²
  std::vector<char> outer;               ///< 1 where a node of the interface is `outer`
  std::vector<InterfaceNode> interface;  ///< by inclusion, angle, node

  int size() const { return static_cast<int>(area.size()); }
};

/// Ends (low, high) of the edges that one cell of the region has alone, ascending.
std::vector<std::array<int, 2>> outline_edges(const RegionCells& cells);

/// `others` tells of each outline edge whether a cell of another region lies beyond it.
Inclusions find_inclusions(const RegionCells& cells, const std::vector<char>& others);

/// The region and its inclusions, the same on every rank; nodes are whole-mesh numbers. Every rank holds the
/// region's cells while it looks. Collective.
struct RegionInclusions {
  RegionCells cells;
  Inclusions inclusions;
};
RegionInclusions find_inclusions(const Mesh& mesh, int region);

/// Of a mesh that every rank holds whole. `node` [points]: numbers that are equal for points that are one.
RegionInclusions find_inclusions(const PlaneGrid& grid, int region, const std::vector<int>& node);

}  // namespace slipscale
