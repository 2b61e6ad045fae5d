#include "cell_outline.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "cell_fit.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

/// An outer edge as every rank knows it: the whole-mesh numbers of its ends, the solid on the left.
struct WholeEdge {
  PetscInt from, to;
  double x, y;  ///< along it, m
};

std::vector<WholeEdge> everywhere(MPI_Comm comm, const Mesh& mesh, const std::vector<OuterEdge>& edges) {
  std::vector<WholeEdge> mine;
  for (const OuterEdge& edge : edges)
    mine.push_back({mesh.nodes.number[edge.nodes[0]], mesh.nodes.number[edge.nodes[1]], -edge.outward[1],
                    edge.outward[0]});
  const int ranks = ranks_of(comm), bytes = static_cast<int>(mine.size() * sizeof(WholeEdge));
  std::vector<int> counts(ranks), starts(ranks + 1, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int rank = 0; rank < ranks; ++rank) starts[rank + 1] = starts[rank] + counts[rank];
  std::vector<WholeEdge> all(static_cast<std::size_t>(starts.back()) / sizeof(WholeEdge));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, comm);
  // An edge whose ends belong to two ranks comes from both.
  const auto ends = [](const WholeEdge& edge) { return std::array{edge.from, edge.to}; };
  std::ranges::sort(all, {}, ends);
  all.erase(std::ranges::unique(all, {}, ends).begin(), all.end());
  return all;
}

struct Loop {
  std::vector<PetscInt> nodes;
  double area = 0;  ///< enclosed, m²; negative around a hole, which is run through clockwise
  double rest = 0;  ///< by how much it misses its beginning: it goes around the torus, m
  double length = 0;
};

/// Walks from edge to edge until each is used. Positions are added up along the way, so that neither a seam
/// nor the distance from the origin matters.
std::vector<Loop> loops(const std::vector<WholeEdge>& edges) {
  std::multimap<PetscInt, const WholeEdge*> from;
  for (const WholeEdge& edge : edges) from.emplace(edge.from, &edge);
  std::vector<Loop> found;
  while (!from.empty()) {
    Loop loop;
    Vector2 at{};
    for (auto next = from.begin(); next != from.end(); next = from.find(loop.nodes.back())) {
      const WholeEdge& edge = *next->second;
      from.erase(next);
      loop.area += 0.5 * (at[0] * edge.y - at[1] * edge.x);
      loop.length += std::hypot(edge.x, edge.y);
      at = {at[0] + edge.x, at[1] + edge.y};
      loop.nodes.push_back(edge.to);
    }
    loop.rest = std::hypot(at[0], at[1]);
    found.push_back(std::move(loop));
  }
  return found;
}

/// Two loops that touch in a node are one outline: a notch of the outside is no hole.
bool touches(const Loop& loop, const std::vector<PetscInt>& nodes) {
  return std::ranges::any_of(loop.nodes,
                             [&](PetscInt node) { return std::ranges::binary_search(nodes, node); });
}

/// Nodes of the outside, ascending.
std::vector<PetscInt> outside_nodes(std::vector<Loop>& all) {
  std::vector<PetscInt> nodes;
  for (bool grows = true; grows;) {
    grows = false;
    for (auto loop = all.begin(); loop != all.end();)
      if (loop->area > 0 || touches(*loop, nodes)) {
        nodes.insert(nodes.end(), loop->nodes.begin(), loop->nodes.end());
        loop = all.erase(loop);
        grows = true;
      } else {
        ++loop;
      }
    std::ranges::sort(nodes);
  }
  return nodes;
}

}  // namespace

CellOutline cell_outline(MPI_Comm comm, const Mesh& mesh, CellBoundary boundary) {
  const std::vector<OuterEdge> edges = outer_edges(mesh);
  refuse_unfit(comm, mesh, boundary, edges);
  std::vector<Loop> holes = loops(everywhere(comm, mesh, edges));
  CellOutline outline;
  std::vector<PetscInt> outside;
  if (boundary != CellBoundary::periodic) {
    outside = outside_nodes(holes);
    if (outside.empty()) refuse_closed(mesh, boundary);
  }
  constexpr double nothing = 1e-9;  // of a loop's size
  for (const Loop& hole : holes) {
    if (hole.rest > nothing * hole.length || -hole.area < nothing * hole.length * hole.length)
      refuse_unpaired(mesh);
    ++outline.hole_count;
    outline.hole_area -= hole.area;
  }
  for (const OuterEdge& edge : edges)
    (std::ranges::binary_search(outside, mesh.nodes.number[edge.nodes[0]]) ? outline.outside : outline.holes)
        .push_back(edge);
  return outline;
}

}  // namespace slipscale
