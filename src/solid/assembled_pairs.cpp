#include "assembled_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "by_shape.hpp"
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

void find_pairs(const Mesh& mesh, AssembledPairs& pairs) {
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
  std::size_t count = 0;
  for (std::size_t node = 0; node < number.size(); ++node) {
    const auto begin = entries.begin() + start[node], end = entries.begin() + start[node + 1];
    std::sort(begin, end, [&](int a, int b) { return number[a] < number[b]; });
    next[node] = static_cast<int>(std::unique(begin, end) - entries.begin());
    count += static_cast<std::size_t>(next[node] - start[node]);
  }
  pairs.high.reserve(count);
  pairs.first.reserve(number.size() + 1);
  pairs.first.push_back(0);
  for (const int node : pairs.node) {
    pairs.high.insert(pairs.high.end(), entries.begin() + start[node], entries.begin() + next[node]);
    pairs.first.push_back(static_cast<int>(pairs.high.size()));
  }
}

/// A number as it is stored. Never inlined: where GCC 12 vectorises two of these conversions to float and
/// back, it leaves them out.
template <class Scalar>
[[gnu::noinline]] double rounded(double x) {
  return static_cast<double>(static_cast<Scalar>(x));
}

double largest_modulus(const std::vector<Material>& materials) {
  double largest = 0;
  for (const Material& material : materials)
    largest = std::max(
        largest, material.grading ? material.grading->modulus : material.stiffness.cwiseAbs().maxCoeff());
  return largest;
}

}  // namespace

template <class Scalar>
AssembledPairs assemble_pairs(const Mesh& mesh, const std::vector<Material>& materials) {
  AssembledPairs pairs;
  find_pairs(mesh, pairs);
  std::vector<int> row_of(pairs.node.size());
  for (int row = 0; row < pairs.rows(); ++row) row_of[pairs.node[row]] = row;

  // Blocks are summed where they stay, for a mesh has several times as many of them as of anything else.
  // Until they are complete, `yy` and `skew` of a block are its yx and yy.
  pairs.block.assign(pairs.high.size(), {0, 0, 0, 0});
  // Of the terms, over the largest modulus; to tell what rounding leaves.
  std::vector<float> size(pairs.high.size(), 0);
  const double modulus = largest_modulus(materials);
  ByShape<ElementStiffness> stiffness;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    const Solid solid = materials[mesh.cells.region[cell]].at(cell);
    const ElementStiffness& k = stiffness.of(mesh, cell, solid, [&](std::span<const Vector2> shape) {
      return element_stiffness(shape, solid.stiffness);
    });
    for_pairs(mesh, cell, [&](int a, int b) {
      int pair = pairs.first[row_of[nodes[a]]];
      while (pairs.high[pair] != nodes[b]) ++pair;
      const auto part = k.template block<2, 2>(2 * a, 2 * b);
      auto& [xx, xy, yx, yy] = pairs.block[pair];
      xx += part(0, 0), xy += part(0, 1), yx += part(1, 0), yy += part(1, 1);
      size[pair] += static_cast<float>(part.cwiseAbs().sum() / modulus);
    });
  }

  // What rounding leaves of two skew parts that cancel.
  const double nothing = 64 * std::numeric_limits<double>::epsilon() * modulus;
  for (std::size_t pair = 0; pair < pairs.block.size(); ++pair) {
    const auto [xx, xy, yx, yy] = pairs.block[pair];
    const double skew = 0.5 * (xy - yx);
    pairs.block[pair] = {rounded<Scalar>(xx), rounded<Scalar>(0.5 * (xy + yx)), rounded<Scalar>(yy),
                         std::abs(skew) > nothing * static_cast<double>(size[pair]) ? skew : 0};
  }
  return pairs;
}

template AssembledPairs assemble_pairs<double>(const Mesh&, const std::vector<Material>&);
template AssembledPairs assemble_pairs<float>(const Mesh&, const std::vector<Material>&);

}  // namespace slipscale
