#include "assembled_stiffness.hpp"

#include <algorithm>
#include <array>

#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

/// An empty matrix with room for every pair of nodes that share a cell.
OwnedMat empty_matrix(MPI_Comm comm, const Mesh& mesh) {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(mesh.nodes.owned));
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    for (const int row : nodes)
      if (row < mesh.nodes.owned) neighbours[row].insert(neighbours[row].end(), nodes.begin(), nodes.end());
  }
  std::vector<PetscInt> here, beyond;
  for (auto& list : neighbours) {
    std::ranges::sort(list);
    list.erase(std::ranges::unique(list).begin(), list.end());
    const auto ghosts = std::ranges::lower_bound(list, mesh.nodes.owned);
    here.push_back(static_cast<PetscInt>(ghosts - list.begin()));
    beyond.push_back(static_cast<PetscInt>(list.end() - ghosts));
  }
  OwnedMat matrix;
  petsc(MatCreate(comm, matrix.put()));
  petsc(MatSetSizes(matrix, 2 * mesh.nodes.owned, 2 * mesh.nodes.owned, PETSC_DETERMINE, PETSC_DETERMINE));
  petsc(MatSetBlockSize(matrix, 2));
  petsc(MatSetType(matrix, MATAIJ));
  petsc(MatXAIJSetPreallocation(matrix, 2, here.data(), beyond.data(), nullptr, nullptr));
  petsc(MatSetOption(matrix, MAT_IGNORE_OFF_PROC_ENTRIES, PETSC_TRUE));
  petsc(MatSetOption(matrix, MAT_ROW_ORIENTED, PETSC_FALSE));
  return matrix;
}

}  // namespace

OwnedMat assembled_stiffness(MPI_Comm comm, const Model& model) {
  const Mesh& mesh = model.mesh;
  PetscInt owned = mesh.nodes.owned, offset = 0;
  MPI_Exscan(&owned, &offset, 1, MPIU_INT, MPI_SUM, comm);
  OwnedMat matrix = empty_matrix(comm, mesh);
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    const auto count = static_cast<PetscInt>(nodes.size());
    const auto shape = mesh.shape_of(cell);
    const auto k = element_stiffness({shape.data(), nodes.size()},
                                     model.materials[mesh.cells.region[cell]].at(cell).stiffness);
    std::array<PetscInt, 4> rows{}, columns{};
    for (PetscInt c = 0; c < count; ++c) {
      const bool own = nodes[c] < mesh.nodes.owned;
      columns[c] = own ? offset + nodes[c] : mesh.nodes.ghosts[nodes[c] - mesh.nodes.owned];
      rows[c] = own ? columns[c] : -1;  // their owners add them
    }
    petsc(MatSetValuesBlocked(matrix, count, rows.data(), count, columns.data(), k.data(), ADD_VALUES));
  }
  petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

}  // namespace slipscale
