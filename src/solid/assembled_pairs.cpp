#include "assembled_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

/// Calls `visit(a, b)` for the corners of a cell that make a pair, the first that of lower number.
template <class Visit>
void for_pairs(const Mesh& mesh, int cell, Visit&& visit) {
  const auto nodes = mesh.cells.nodes_of(cell);
  const auto& number = mesh.nodes.number;
  for (int a = 0; a < static_cast<int>(nodes.size()); ++a)
    for (int b = 0; b < static_cast<int>(nodes.size()); ++b)
      if (number[nodes[a]] < number[nodes[b]] && std::min(nodes[a], nodes[b]) < mesh.nodes.owned) visit(a, b);
}

template <class Scalar>
void find_pairs(const Mesh& mesh, AssembledPairs<Scalar>& pairs) {
  const auto& number = mesh.nodes.number;
  pairs.node.resize(number.size());
  std::iota(pairs.node.begin(), pairs.node.end(), 0);
  std::sort(pairs.node.begin(), pairs.node.end(), [&](int a, int b) { return number[a] < number[b]; });
  // By local node, as often as cells have the pair.
  std::vector<int> start(number.size() + 1, 0), entries;
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    for_pairs(mesh, cell, [&](int a, int) { ++start[mesh.cells.nodes_of(cell)[a] + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  entries.resize(static_cast<std::size_t>(start.back()));
  std::vector<int> next(start.begin(), start.end() - 1);
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    for_pairs(mesh, cell, [&](int a, int b) {
      const auto nodes = mesh.cells.nodes_of(cell);
      entries[next[nodes[a]]++] = nodes[b];
    });
  pairs.first.push_back(0);
  for (const int node : pairs.node) {
    const auto begin = entries.begin() + start[node], end = entries.begin() + start[node + 1];
    std::sort(begin, end, [&](int a, int b) { return number[a] < number[b]; });
    pairs.high.insert(pairs.high.end(), begin, std::unique(begin, end));
    pairs.first.push_back(static_cast<int>(pairs.high.size()));
  }
}

}  // namespace

template <class Scalar>
AssembledPairs<Scalar> assemble_pairs(const Mesh& mesh, const std::vector<Material>& materials) {
  AssembledPairs<Scalar> pairs;
  find_pairs(mesh, pairs);
  std::vector<int> row_of(pairs.node.size());
  for (int row = 0; row < pairs.rows(); ++row) row_of[pairs.node[row]] = row;

  struct Sum {
    double xx = 0, xy = 0, yx = 0, yy = 0, size = 0;
  };
  std::vector<Sum> sums(pairs.high.size());
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    const auto shape = mesh.shape_of(cell);
    const auto k =
        element_stiffness({shape.data(), nodes.size()}, materials[mesh.cells.region[cell]].stiffness);
    for_pairs(mesh, cell, [&](int a, int b) {
      int pair = pairs.first[row_of[nodes[a]]];
      while (pairs.high[pair] != nodes[b]) ++pair;
      const auto block = k.template block<2, 2>(2 * a, 2 * b);
      Sum& sum = sums[pair];
      sum.xx += block(0, 0), sum.xy += block(0, 1), sum.yx += block(1, 0), sum.yy += block(1, 1);
      sum.size += block.cwiseAbs().sum();
    });
  }

  // What rounding leaves of two skew parts that cancel.
  constexpr double nothing = 64 * std::numeric_limits<double>::epsilon();
  pairs.block.reserve(sums.size());
  for (const Sum& sum : sums) {
    const double skew = 0.5 * (sum.xy - sum.yx);
    pairs.block.push_back({static_cast<Scalar>(sum.xx), static_cast<Scalar>(0.5 * (sum.xy + sum.yx)),
                           static_cast<Scalar>(sum.yy), std::abs(skew) > nothing * sum.size ? skew : 0});
  }
  return pairs;
}

template AssembledPairs<double> assemble_pairs(const Mesh&, const std::vector<Material>&);
template AssembledPairs<float> assemble_pairs(const Mesh&, const std::vector<Material>&);

}  // namespace slipscale
