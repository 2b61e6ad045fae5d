#include <algorithm>
#include <numeric>

#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// Nodes that share a cell, as compressed rows; diagonal included, as PETSc's ordering expects.
struct NodeGraph {
  std::vector<PetscInt> start, neighbours;
};

NodeGraph node_graph(const std::vector<std::vector<PetscInt>>& cells, PetscInt node_count) {
  std::vector<std::pair<PetscInt, PetscInt>> pairs;
  pairs.reserve(cells.size() * 9);
  for (const auto& cell : cells)
    for (PetscInt a : cell)
      for (PetscInt b : cell) pairs.emplace_back(a, b);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  NodeGraph graph;
  graph.start.assign(static_cast<std::size_t>(node_count) + 1, 0);
  graph.neighbours.reserve(pairs.size());
  for (const auto& [a, b] : pairs) {
    ++graph.start[a + 1];
    graph.neighbours.push_back(b);
  }
  std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
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

std::vector<PetscInt> whole_mesh_order(DM dm) {
  PetscInt points = 0, cell_begin = 0, cell_end = 0, node_begin = 0, node_end = 0;
  petsc(DMPlexGetChart(dm, nullptr, &points));
  petsc(DMPlexGetHeightStratum(dm, 0, &cell_begin, &cell_end));
  petsc(DMPlexGetDepthStratum(dm, 0, &node_begin, &node_end));
  std::vector<std::vector<PetscInt>> cells;
  for (PetscInt cell = cell_begin; cell < cell_end; ++cell) {
    cells.push_back(cell_vertices(dm, cell));
    for (PetscInt& vertex : cells.back()) vertex -= node_begin;
  }
  NodeGraph graph = node_graph(cells, node_end - node_begin);
  const auto node_number = reverse_cuthill_mckee(graph, node_end - node_begin);

  for (auto& cell : cells) {
    for (PetscInt& node : cell) node = node_number[node];
    std::sort(cell.begin(), cell.end());
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
