#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>

#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// The nodes of a cell; the places that it has no node for hold the largest number.
using CellNodes = std::array<PetscInt, 4>;
constexpr PetscInt none = std::numeric_limits<PetscInt>::max();

std::span<const PetscInt> nodes_of(const CellNodes& cell) { return {cell.data(), cell[3] == none ? 3u : 4u}; }

/// Nodes that share a cell, as compressed rows; diagonal included, as PETSc's ordering expects.
struct NodeGraph {
  std::vector<PetscInt> start, neighbours;
};

/// The cells around each node, as compressed rows.
NodeGraph cells_around(const std::vector<CellNodes>& cells, PetscInt node_count) {
  NodeGraph around;
  around.start.assign(static_cast<std::size_t>(node_count) + 1, 0);
  for (const CellNodes& cell : cells)
    for (const PetscInt node : nodes_of(cell)) ++around.start[node + 1];
  std::partial_sum(around.start.begin(), around.start.end(), around.start.begin());
  around.neighbours.resize(static_cast<std::size_t>(around.start.back()));
  std::vector<PetscInt> next = around.start;
  for (std::size_t k = 0; k < cells.size(); ++k)
    for (const PetscInt node : nodes_of(cells[k])) around.neighbours[next[node]++] = static_cast<PetscInt>(k);
  return around;
}

NodeGraph node_graph(const std::vector<CellNodes>& cells, PetscInt node_count) {
  const NodeGraph around = cells_around(cells, node_count);
  NodeGraph graph;
  graph.start.push_back(0);
  graph.neighbours.reserve(2 * around.neighbours.size());
  std::vector<PetscInt> row;
  for (PetscInt node = 0; node < node_count; ++node) {
    row.clear();
    for (PetscInt k = around.start[node]; k < around.start[node + 1]; ++k) {
      const auto nodes = nodes_of(cells[around.neighbours[k]]);
      row.insert(row.end(), nodes.begin(), nodes.end());
    }
    std::ranges::sort(row);
    const auto [end, last] = std::ranges::unique(row);
    graph.neighbours.insert(graph.neighbours.end(), row.begin(), end);
    graph.start.push_back(static_cast<PetscInt>(graph.neighbours.size()));
  }
  return graph;
}

/// Reverse Cuthill-McKee: neighbours get close numbers, so a sweep over the nodes stays in the cache.
std::vector<PetscInt> reverse_cuthill_mckee(NodeGraph& graph, PetscInt node_count) {
  std::vector<PetscScalar> values(graph.neighbours.size(), 1.0);
  OwnedMat matrix;
  petsc(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, node_count, node_count, graph.start.data(),
                                  graph.neighbours.data(), values.data(), matrix.put()));
  OwnedIS rows, columns;
  petsc(MatGetOrdering(matrix, MATORDERINGRCM, rows.put(), columns.put()));
  const PetscInt* old_of_new = nullptr;
  petsc(ISGetIndices(rows, &old_of_new));
  std::vector<PetscInt> new_of_old(static_cast<std::size_t>(node_count));
  for (PetscInt k = 0; k < node_count; ++k) new_of_old[old_of_new[k]] = k;
  petsc(ISRestoreIndices(rows, &old_of_new));
  return new_of_old;
}

}  // namespace

std::vector<PetscInt> whole_mesh_order(DM dm, const PlexGeometry& plex) {
  PetscInt points = 0, cell_begin = 0, cell_end = 0, node_begin = 0, node_end = 0;
  petsc(DMPlexGetChart(dm, nullptr, &points));
  petsc(DMPlexGetHeightStratum(dm, 0, &cell_begin, &cell_end));
  petsc(DMPlexGetDepthStratum(dm, 0, &node_begin, &node_end));
  std::vector<CellNodes> cells(static_cast<std::size_t>(cell_end - cell_begin), {none, none, none, none});
  for (PetscInt cell = cell_begin; cell < cell_end; ++cell)
    std::ranges::transform(plex.vertices(cell), cells[cell - cell_begin].begin(),
                           [&](PetscInt vertex) { return vertex - node_begin; });
  NodeGraph graph = node_graph(cells, node_end - node_begin);
  const auto node_number = reverse_cuthill_mckee(graph, node_end - node_begin);

  for (auto& cell : cells) {
    for (PetscInt& node : cell)
      if (node != none) node = node_number[node];
    std::ranges::sort(cell);
  }
  std::vector<PetscInt> sorted(cells.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::sort(sorted.begin(), sorted.end(), [&](PetscInt a, PetscInt b) { return cells[a] < cells[b]; });

  std::vector<PetscInt> number(static_cast<std::size_t>(points), -1);
  for (std::size_t k = 0; k < sorted.size(); ++k) number[cell_begin + sorted[k]] = static_cast<PetscInt>(k);
  for (PetscInt node = node_begin; node < node_end; ++node) number[node] = node_number[node - node_begin];
  return number;
}

}  // namespace slipscale::mesh_stages
