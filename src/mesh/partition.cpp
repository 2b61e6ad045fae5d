#include <metis.h>

#include <algorithm>
#include <numeric>

#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// The rank of each cell, by METIS on the graph of cells that share an edge; the seed is fixed, so the same
/// mesh is cut the same way every time. Collective, for PETSc makes the graph together.
std::vector<PetscInt> metis_parts(DM dm, int ranks) {
  PetscInt cells = 0, *start = nullptr, *neighbours = nullptr;
  petsc(DMPlexCreatePartitionerGraph(dm, 0, &cells, &start, &neighbours, nullptr));
  std::vector<idx_t> xadj(start, start + cells + 1), adjncy(neighbours, neighbours + start[cells]);
  petsc(PetscFree(start));
  petsc(PetscFree(neighbours));
  // METIS is not asked for one part: its bisection cuts all the same.
  if (cells == 0 || ranks == 1) return std::vector<PetscInt>(static_cast<std::size_t>(cells), 0);
  idx_t count = cells, constraints = 1, parts = ranks, cut = 0, options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> part(static_cast<std::size_t>(cells), 0);
  const auto method = ranks <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int code = method(&count, &constraints, xadj.data(), adjncy.data(), nullptr, nullptr, nullptr, &parts,
                          nullptr, nullptr, options, &cut, part.data());
  if (code != METIS_OK)
    throw LibraryError("METIS could not partition the mesh (code " + std::to_string(code) + ")");
  return {part.begin(), part.end()};
}

/// Equal runs of our own cell order, which is compact; gmsh's order is not.
std::vector<PetscInt> runs_of_the_order(PetscInt cells, int ranks, const PetscInt* cell_number) {
  std::vector<PetscInt> part(static_cast<std::size_t>(cells));
  for (PetscInt cell = 0; cell < cells; ++cell)
    part[cell] = static_cast<PetscInt>(static_cast<PetscInt64>(cell_number[cell]) * ranks / cells);
  return part;
}

}  // namespace

void set_partition(DM dm, Partitioner partitioner, const std::vector<PetscInt>& number) {
  PetscPartitioner petsc_partitioner = nullptr;
  petsc(DMPlexGetPartitioner(dm, &petsc_partitioner));
  if (partitioner == Partitioner::ptscotch) {
    petsc(PetscPartitionerSetType(petsc_partitioner, PETSCPARTITIONERPTSCOTCH));
    return;
  }
  int ranks = 1;
  MPI_Comm_size(PetscObjectComm(reinterpret_cast<PetscObject>(dm)), &ranks);
  PetscInt begin = 0, end = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  const std::vector<PetscInt> part = partitioner == Partitioner::metis
                                         ? metis_parts(dm, ranks)
                                         : runs_of_the_order(end - begin, ranks, number.data() + begin);
  std::vector<PetscInt> sizes(static_cast<std::size_t>(ranks), 0), points(part.size());
  for (PetscInt rank : part) ++sizes[rank];
  std::iota(points.begin(), points.end(), 0);
  std::stable_sort(points.begin(), points.end(), [&](PetscInt a, PetscInt b) { return part[a] < part[b]; });
  petsc(PetscPartitionerSetType(petsc_partitioner, PETSCPARTITIONERSHELL));
  petsc(PetscPartitionerShellSetPartition(petsc_partitioner, ranks, sizes.data(), points.data()));
}

}  // namespace slipscale::mesh_stages
