#include <metis.h>
#include <petscpartitioner.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "slipscale/base/parallel.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

using OwnedPartitioner = Owned<PetscPartitioner, PetscPartitionerDestroy>;

/// Finds the cell on the other side of an edge. That cell runs through it the other way, from `b` to `a`, so
/// it is among the cells around `a`. No edge's answer is looked for twice.
void find_beyond(CellSide side, const std::vector<CellVertices>& cells, const Rows& around,
                 std::vector<CellVertices>& beyond) {
  PetscInt& answer = beyond[side.cell][side.corner];
  if (answer >= 0) return;
  const auto corners = corners_of(cells[side.cell]);
  const PetscInt a = corners[side.corner], b = corners[(side.corner + 1) % corners.size()];
  for (const PetscInt other : around[a]) {
    if (other == side.cell) continue;
    const auto others = corners_of(cells[other]);
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (others[k] != b || others[(k + 1) % others.size()] != a) continue;
      answer = other;
      beyond[other][k] = side.cell;
      return;
    }
  }
}

/// Cells that share an edge, ascending. Rank 0.
Rows cell_graph(const std::vector<CellVertices>& cells, const Rows& around) {
  std::vector<CellVertices> beyond(cells.size(), {-1, -1, -1, -1});
  Rows graph;
  graph.start.reserve(cells.size() + 1);
  graph.start.push_back(0);
  graph.entries.reserve(around.entries.size());
  for (PetscInt cell = 0; cell < static_cast<PetscInt>(cells.size()); ++cell) {
    for (int k = 0; k < static_cast<int>(corners_of(cells[cell]).size()); ++k)
      find_beyond({cell, k}, cells, around, beyond);
    std::ranges::copy_if(beyond[cell], std::back_inserter(graph.entries),
                         [](PetscInt other) { return other >= 0; });
    std::sort(graph.entries.begin() + graph.start.back(), graph.entries.end());
    graph.start.push_back(static_cast<PetscInt>(graph.entries.size()));
  }
  return graph;
}

/// The rank of each cell, by METIS; the seed is fixed, so the same mesh is cut the same way every time.
std::vector<PetscInt> metis_parts(Rows graph, int ranks) {
  std::vector<idx_t> xadj(graph.start.begin(), graph.start.end()),
      adjncy(graph.entries.begin(), graph.entries.end());
  idx_t count = static_cast<idx_t>(xadj.size()) - 1, constraints = 1, parts = ranks, cut = 0,
        options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> part(static_cast<std::size_t>(count), 0);
  const auto method = ranks <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int code = method(&count, &constraints, xadj.data(), adjncy.data(), nullptr, nullptr, nullptr, &parts,
                          nullptr, nullptr, options, &cut, part.data());
  if (code != METIS_OK)
    throw LibraryError("METIS could not partition the mesh (code " + std::to_string(code) + ")");
  return {part.begin(), part.end()};
}

/// The same by PT-Scotch, in PETSc's hands. Collective.
std::vector<PetscInt> ptscotch_parts(MPI_Comm comm, Rows graph, int ranks) {
  const auto count = static_cast<PetscInt>(graph.start.empty() ? 0 : graph.start.size() - 1);
  OwnedPartitioner partitioner;
  OwnedSection sizes;
  OwnedIS cells;
  petsc(PetscPartitionerCreate(comm, partitioner.put()));
  petsc(PetscPartitionerSetType(partitioner, PETSCPARTITIONERPTSCOTCH));
  petsc(PetscSectionCreate(comm, sizes.put()));
  petsc(PetscPartitionerPartition(partitioner, ranks, count, graph.start.data(), graph.entries.data(),
                                  nullptr, nullptr, sizes, cells.put()));
  std::vector<PetscInt> part(static_cast<std::size_t>(count));
  const PetscInt* cell = nullptr;
  petsc(ISGetIndices(cells, &cell));
  const PetscInt* next = cell;
  for (PetscInt rank = 0; rank < ranks; ++rank) {
    PetscInt size = 0;
    petsc(PetscSectionGetDof(sizes, rank, &size));
    for (; size > 0; --size) part[*next++] = rank;
  }
  petsc(ISRestoreIndices(cells, &cell));
  return part;
}

/// Equal runs of our own cell order, which is compact; gmsh's order is not.
std::vector<PetscInt> runs_of_the_order(int ranks, const std::vector<PetscInt>& cell_number) {
  const auto cells = static_cast<PetscInt64>(cell_number.size());
  std::vector<PetscInt> part(cell_number.size());
  std::ranges::transform(cell_number, part.begin(),
                         [&](PetscInt64 number) { return static_cast<PetscInt>(number * ranks / cells); });
  return part;
}

}  // namespace

std::vector<PetscInt> cell_parts(MPI_Comm comm, Partitioner partitioner, int ranks, const Whole& whole) {
  if (partitioner == Partitioner::simple) return runs_of_the_order(ranks, whole.cell_number);
  const auto& cells = whole.plain.cells;
  Rows graph;
  if (!cells.empty()) graph = cell_graph(cells, whole.around);
  if (partitioner == Partitioner::ptscotch) return ptscotch_parts(comm, std::move(graph), ranks);
  return cells.empty() ? std::vector<PetscInt>{} : metis_parts(std::move(graph), ranks);
}

void set_partition(MPI_Comm comm, DM dm, Partitioner partitioner, const Whole& whole) {
  const int ranks = ranks_of(comm);
  if (ranks == 1) return;
  const std::vector<PetscInt> part = cell_parts(comm, partitioner, ranks, whole);
  std::vector<PetscInt> sizes(static_cast<std::size_t>(ranks), 0), points(part.size());
  for (PetscInt rank : part) ++sizes[rank];
  std::iota(points.begin(), points.end(), 0);
  std::stable_sort(points.begin(), points.end(), [&](PetscInt a, PetscInt b) { return part[a] < part[b]; });
  PetscPartitioner shell = nullptr;
  petsc(DMPlexGetPartitioner(dm, &shell));
  petsc(PetscPartitionerSetType(shell, PETSCPARTITIONERSHELL));
  petsc(PetscPartitionerShellSetPartition(shell, ranks, sizes.data(), points.data()));
}

}  // namespace slipscale::mesh_stages
