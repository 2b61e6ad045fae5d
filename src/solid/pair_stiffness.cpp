#include "slipscale/solid/pair_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

/// Neighbours of higher number of every local node, ascending by number; pairs of two ghosts are left out.
std::vector<std::vector<int>> higher_neighbours(const Mesh& mesh) {
  const auto& number = mesh.nodes.number;
  std::vector<std::vector<int>> higher(static_cast<std::size_t>(mesh.nodes.size()));
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    const int count = mesh.cells.corner_count(cell);
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < count; ++b)
        if (number[nodes[a]] < number[nodes[b]] && std::min(nodes[a], nodes[b]) < mesh.nodes.owned)
          higher[nodes[a]].push_back(nodes[b]);
  }
  for (auto& list : higher) {
    std::sort(list.begin(), list.end(), [&](int a, int b) { return number[a] < number[b]; });
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return higher;
}

}  // namespace

template <class Scalar>
PairStiffness<Scalar>::PairStiffness(const Mesh& mesh, const std::vector<Material>& materials)
    : owned_(mesh.nodes.owned), count_(mesh.nodes.size()) {
  const auto& number = mesh.nodes.number;
  const auto higher = higher_neighbours(mesh);
  std::vector<int> order(higher.size()), row_of(higher.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return number[a] < number[b]; });
  constexpr std::size_t rows_of_a_chunk = 256;
  Chunk chunk{0, 0, 0, 0, 0};
  for (int node : order) {
    row_of[node] = chunk.end++;
    rows_.push_back({node, static_cast<int>(high_.size())});
    high_.insert(high_.end(), higher[node].begin(), higher[node].end());
    for (int high : higher[node])
      if (high < owned_) chunk.touched = std::max(chunk.touched, high + 1);
    if (node < owned_) {
      chunk.complete_end = node + 1;
      chunk.touched = std::max(chunk.touched, node + 1);
    }
    if (rows_.size() % rows_of_a_chunk == 0 || rows_.size() == order.size()) {
      chunks_.push_back(chunk);
      chunk.begin = chunk.end;
      chunk.complete_begin = chunk.complete_end;
    }
  }
  rows_.push_back({-1, static_cast<int>(high_.size())});

  // Sums are taken in double precision whatever the storage.
  struct Sum {
    double xx = 0, xy = 0, yx = 0, yy = 0, size = 0;
  };
  std::vector<Sum> sums(high_.size());
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    const int count = mesh.cells.corner_count(cell);
    const auto k =
        element_stiffness(mesh.cells.corners_of(cell), materials[mesh.cells.region[cell]].stiffness);
    for (int a = 0; a < count; ++a)
      for (int b = 0; b < count; ++b) {
        const int low = nodes[a], high = nodes[b];
        if (number[low] >= number[high] || std::min(low, high) >= owned_) continue;
        int pair = rows_[row_of[low]].first;
        while (high_[pair] != high) ++pair;
        const auto block = k.block<2, 2>(2 * a, 2 * b);
        Sum& sum = sums[pair];
        sum.xx += block(0, 0), sum.xy += block(0, 1), sum.yx += block(1, 0), sum.yy += block(1, 1);
        sum.size += block.cwiseAbs().sum();
      }
  }
  store_blocks(sums);
}

template <class Scalar>
template <class Sums>
void PairStiffness<Scalar>::store_blocks(const Sums& sums) {
  // What rounding leaves of two skew parts that cancel.
  constexpr double nothing = 64 * std::numeric_limits<double>::epsilon();
  blocks_.reserve(sums.size());
  for (int row = 0; row + 1 < static_cast<int>(rows_.size()); ++row)
    for (int pair = rows_[row].first; pair < rows_[row + 1].first; ++pair) {
      const auto& sum = sums[pair];
      blocks_.push_back({static_cast<Scalar>(sum.xx), static_cast<Scalar>(0.5 * (sum.xy + sum.yx)),
                         static_cast<Scalar>(sum.yy)});
      const double skew = 0.5 * (sum.xy - sum.yx);
      if (std::abs(skew) > nothing * sum.size)
        skews_.push_back({row, high_[pair], static_cast<Scalar>(skew)});
    }
  skews_.push_back({-1, -1, 0});
}

template class PairStiffness<double>;
template class PairStiffness<float>;

}  // namespace slipscale
