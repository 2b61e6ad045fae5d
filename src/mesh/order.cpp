#include <algorithm>
#include <numeric>

#include "stages.hpp"

namespace slipscale::mesh_stages {

Rows cells_around(const std::vector<CellVertices>& cells, PetscInt vertices) {
  Rows around;
  around.start.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const CellVertices& cell : cells)
    for (const PetscInt vertex : corners_of(cell)) ++around.start[vertex + 1];
  std::partial_sum(around.start.begin(), around.start.end(), around.start.begin());
  around.entries.resize(static_cast<std::size_t>(around.start.back()));
  std::vector<PetscInt> next = around.start;
  for (std::size_t k = 0; k < cells.size(); ++k)
    for (const PetscInt vertex : corners_of(cells[k]))
      around.entries[next[vertex]++] = static_cast<PetscInt>(k);
  return around;
}

namespace {

/// Nodes that share a cell, ascending; the node itself included, as PETSc's ordering expects.
Rows node_graph(const std::vector<CellVertices>& cells, const Rows& around, PetscInt node_count) {
  Rows graph;
  graph.start.reserve(static_cast<std::size_t>(node_count) + 1);
  graph.start.push_back(0);
  graph.entries.reserve(2 * around.entries.size());
  std::vector<PetscInt> last_seen_by(static_cast<std::size_t>(node_count), -1);
  for (PetscInt node = 0; node < node_count; ++node) {
    for (const PetscInt cell : around[node])
      for (const PetscInt other : corners_of(cells[cell])) {
        if (last_seen_by[other] == node) continue;
        last_seen_by[other] = node;
        graph.entries.push_back(other);
      }
    std::sort(graph.entries.begin() + graph.start.back(), graph.entries.end());
    graph.start.push_back(static_cast<PetscInt>(graph.entries.size()));
  }
  return graph;
}

/// The same of the lines that the nodes lie on: lines that share a cell.
Rows line_graph(const Rows& nodes, const Rows& lines) {
  const auto count = static_cast<PetscInt>(lines.start.size()) - 1;
  std::vector<PetscInt> line_of(lines.entries.size()), last_seen_by(static_cast<std::size_t>(count), -1);
  for (PetscInt line = 0; line < count; ++line)
    for (const PetscInt node : lines[line]) line_of[node] = line;
  Rows graph;
  graph.start.push_back(0);
  for (PetscInt line = 0; line < count; ++line) {
    for (const PetscInt node : lines[line])
      for (const PetscInt other : nodes[node]) {
        const PetscInt beside = line_of[other];
        if (last_seen_by[beside] == line) continue;
        last_seen_by[beside] = line;
        graph.entries.push_back(beside);
      }
    std::sort(graph.entries.begin() + graph.start.back(), graph.entries.end());
    graph.start.push_back(static_cast<PetscInt>(graph.entries.size()));
  }
  return graph;
}

/// Reverse Cuthill-McKee: neighbours get close numbers, so a sweep over the nodes stays in the cache.
std::vector<PetscInt> reverse_cuthill_mckee(Rows& graph, PetscInt node_count) {
  std::vector<PetscScalar> values(graph.entries.size(), 1.0);
  OwnedMat matrix;
  petsc(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, node_count, node_count, graph.start.data(),
                                  graph.entries.data(), values.data(), matrix.put()));
  OwnedIS rows, columns;
  petsc(MatGetOrdering(matrix, MATORDERINGRCM, rows.put(), columns.put()));
  const PetscInt* old_of_new = nullptr;
  petsc(ISGetIndices(rows, &old_of_new));
  std::vector<PetscInt> new_of_old(static_cast<std::size_t>(node_count));
  for (PetscInt k = 0; k < node_count; ++k) new_of_old[old_of_new[k]] = k;
  petsc(ISRestoreIndices(rows, &old_of_new));
  return new_of_old;
}

/// The nodes of a line one after the other, the lines as their graph orders them: along a line of a grid
/// nodes have their neighbours at the same distances.
std::vector<PetscInt> number_by_lines(const Rows& graph, const Rows& lines) {
  Rows between = line_graph(graph, lines);
  const auto count = static_cast<PetscInt>(lines.start.size()) - 1;
  const std::vector<PetscInt> place = reverse_cuthill_mckee(between, count);
  std::vector<PetscInt> line_at(place.size()), number(lines.entries.size());
  for (PetscInt line = 0; line < count; ++line) line_at[place[line]] = line;
  PetscInt next = 0;
  for (const PetscInt line : line_at)
    for (const PetscInt node : lines[line]) number[node] = next++;
  return number;
}

/// The cells by their node numbers, the lowest first: sorted within bins of one lowest number each.
std::vector<PetscInt> number_cells(std::vector<CellVertices> cells,
                                   const std::vector<PetscInt>& node_number) {
  Rows bins;  // the cells of each lowest number
  bins.start.assign(node_number.size() + 1, 0);
  for (CellVertices& cell : cells) {
    const std::size_t n = corners_of(cell).size();
    for (std::size_t k = 0; k < n; ++k) cell[k] = node_number[cell[k]];
    std::sort(cell.begin(), cell.begin() + n);
    if (n == 3) cell[3] = PETSC_MAX_INT;  // behind a quadrilateral that begins alike
    ++bins.start[cell[0] + 1];
  }
  std::partial_sum(bins.start.begin(), bins.start.end(), bins.start.begin());
  bins.entries.resize(cells.size());
  std::vector<PetscInt> next = bins.start;
  for (std::size_t k = 0; k < cells.size(); ++k) bins.entries[next[cells[k][0]]++] = static_cast<PetscInt>(k);
  for (std::size_t bin = 0; bin < node_number.size(); ++bin)
    std::sort(bins.entries.begin() + bins.start[bin], bins.entries.begin() + bins.start[bin + 1],
              [&](PetscInt a, PetscInt b) { return cells[a] < cells[b]; });
  std::vector<PetscInt> number(cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k) number[bins.entries[k]] = static_cast<PetscInt>(k);
  return number;
}

}  // namespace

void number_whole(Whole& whole) {
  Rows graph = node_graph(whole.plain.cells, whole.around, whole.node_count);
  const Rows lines = grid_lines(whole.plain, whole.node_count, whole.periodic);
  whole.node_number =
      lines.entries.empty() ? reverse_cuthill_mckee(graph, whole.node_count) : number_by_lines(graph, lines);
  whole.cell_number = number_cells(whole.plain.cells, whole.node_number);
}

}  // namespace slipscale::mesh_stages
