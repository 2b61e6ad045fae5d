#pragma once

#include <array>
#include <span>
#include <vector>

#include "slipscale/mesh/point_location.hpp"

namespace slipscale {

/// How a field that is given at the centres of the cells is evaluated between them.
enum class Recovery {
  element,  ///< the value of the cell that holds the point
  nodal     ///< continuous within each region: patch recovery at the nodes, shape functions between them
};

/// Values at the nodes from values at the centres of the cells around them, by superconvergent patch recovery
/// (Zienkiewicz and Zhu, Int. J. Numer. Meth. Engng 33 (1992) 1331): the value at the node of the linear
/// polynomial that fits those of the patch best (least squares). At an edge or a corner of the mesh the patch
/// grows by the neighbours of its cells until it has more cells than the polynomial has coefficients and the
/// extrapolation is well-posed, so that linear fields are exact there too (in a strip of one cell, along it).
/// Cells of another region do not belong to a patch, since the strain jumps at their interface: a point
/// between two regions has two nodes.
class PatchRecovery {
 public:
  explicit PatchRecovery(const PlaneGrid& grid);

  int nodes() const { return static_cast<int>(first_.size()) - 1; }
  /// Nodes of the corners of a cell.
  std::span<const int> nodes_of(int cell) const {
    return {corner_nodes_.data() + corner_first_[cell],
            static_cast<std::size_t>(corner_first_[cell + 1] - corner_first_[cell])};
  }

  /// From [cells] to [nodes].
  template <std::size_t N>
  void operator()(std::span<const std::array<double, N>> cells,
                  std::span<std::array<double, N>> nodes) const {
    for (std::size_t n = 0; n + 1 < first_.size(); ++n) {
      nodes[n].fill(0);
      for (int k = first_[n]; k < first_[n + 1]; ++k)
        for (std::size_t i = 0; i < N; ++i) nodes[n][i] += weight_[k] * cells[cell_[k]][i];
    }
  }

 private:
  void number_nodes(const PlaneGrid& grid);
  std::vector<int> grown(const std::vector<int>& patch) const;
  void add_node(int node, const std::vector<Vector2>& centres, const Vector2& x);

  std::vector<int> corner_first_, corner_nodes_;  ///< [cells + 1], and the node of each corner
  std::vector<int> around_first_, around_;        ///< [nodes + 1], and the cells around each, ascending
  std::vector<int> first_{0}, cell_;              ///< [nodes + 1], and the cells of each node's patch
  std::vector<double> weight_;                    ///< of each of them
};

/// A field of the cells evaluated at fixed points. Every point is computed by itself from the whole field:
/// the same bits however points are shared out.
class StrainRecovery {
 public:
  /// `places` lie in cells of `grid`.
  StrainRecovery(const PlaneGrid& grid, Recovery recovery, std::span<const CellPlace> places);

  std::size_t points() const { return element_.size() + nodal_.size(); }

  /// From [cells of the mesh] to [points]; allocates on the first call only.
  void operator()(std::span<const std::array<double, 3>> cells, std::span<std::array<double, 3>> points) {
    evaluate(cells, points, nodes3_);
  }
  void operator()(std::span<const std::array<double, 6>> cells, std::span<std::array<double, 6>> points) {
    evaluate(cells, points, nodes6_);
  }

 private:
  struct NodalPoint {
    std::array<int, 4> node{};
    std::array<double, 4> shape{};
  };

  template <std::size_t N>
  void evaluate(std::span<const std::array<double, N>> cells, std::span<std::array<double, N>> points,
                std::vector<std::array<double, N>>& nodes);

  std::vector<PatchRecovery> patches_;  ///< one, or none for `element`
  std::vector<int> element_;            ///< the cell of each point, for `element`
  std::vector<NodalPoint> nodal_;       ///< the same for `nodal`; unused corners have shape 0
  std::vector<std::array<double, 3>> nodes3_;
  std::vector<std::array<double, 6>> nodes6_;
};

}  // namespace slipscale
