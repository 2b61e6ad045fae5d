#pragma once

#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/element.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale::testing_support {

/// The same stiffness as a PETSc matrix of the given type, rows in the order of the mesh's owned nodes. Every
/// rank adds the cells it owns. Collective.
inline OwnedMat assembled_stiffness(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials,
                                    MatType type) {
  constexpr PetscInt most_neighbours = 16;
  PetscInt offset = 0, owned = mesh.nodes.owned;
  MPI_Exscan(&owned, &offset, 1, MPIU_INT, MPI_SUM, comm);
  OwnedMat matrix;
  petsc(MatCreate(comm, matrix.put()));
  petsc(MatSetSizes(matrix, 2 * owned, 2 * owned, PETSC_DETERMINE, PETSC_DETERMINE));
  petsc(MatSetBlockSize(matrix, 2));
  petsc(MatSetType(matrix, type));
  petsc(MatSeqAIJSetPreallocation(matrix, 2 * most_neighbours, nullptr));
  petsc(MatMPIAIJSetPreallocation(matrix, 2 * most_neighbours, nullptr, 2 * most_neighbours, nullptr));
  petsc(MatSeqBAIJSetPreallocation(matrix, 2, most_neighbours, nullptr));
  petsc(MatMPIBAIJSetPreallocation(matrix, 2, most_neighbours, nullptr, most_neighbours, nullptr));
  petsc(MatSetOption(matrix, MAT_ROW_ORIENTED, PETSC_FALSE));
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    if (!mesh.cells.owned[cell]) continue;
    const auto nodes = mesh.cells.nodes_of(cell);
    const int count = mesh.cells.corner_count(cell);
    const auto k =
        element_stiffness(mesh.cells.corners_of(cell), materials[mesh.cells.region[cell]].stiffness);
    std::array<PetscInt, 4> rows{};
    for (int c = 0; c < count; ++c) {
      const int node = nodes[c];
      rows[c] = node < owned ? offset + node : mesh.nodes.ghosts[node - owned];
    }
    petsc(MatSetValuesBlocked(matrix, count, rows.data(), count, rows.data(), k.data(), ADD_VALUES));
  }
  petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

}  // namespace slipscale::testing_support
