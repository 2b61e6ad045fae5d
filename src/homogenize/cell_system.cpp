#include "cell_system.hpp"

#include <algorithm>
#include <span>

#include "slipscale/solid/element.hpp"

namespace slipscale {
CellSystem::CellSystem(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials)
    : comm_(comm),
      mesh_(mesh),
      materials_(materials),
      held_(2 * static_cast<std::size_t>(mesh.nodes.owned)),
      external_(static_cast<std::size_t>(mesh.nodes.owned)) {
  PetscInt owned = mesh.nodes.owned;
  MPI_Exscan(&owned, &offset_, 1, MPIU_INT, MPI_SUM, comm);
  for (int i = 0; i < mesh.nodes.owned; ++i) index_.push_back(offset_ + i);
  index_.insert(index_.end(), mesh.nodes.ghosts.begin(), mesh.nodes.ghosts.end());
  for (const Material& material : materials)
    scale_ = std::max(scale_, material.stiffness.diagonal().maxCoeff());
  local_ = vector();
}

OwnedVec CellSystem::vector() const {
  OwnedVec vec;
  petsc(VecCreateGhostBlock(comm_, 2, 2 * mesh_.nodes.owned, PETSC_DECIDE,
                            static_cast<PetscInt>(mesh_.nodes.ghosts.size()), mesh_.nodes.ghosts.data(),
                            vec.put()));
  petsc(VecSet(vec, 0));
  return vec;
}

OwnedMat CellSystem::matrix() const {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(mesh_.nodes.owned));
  for (int cell = 0; cell < mesh_.cells.size(); ++cell) {
    const auto nodes = mesh_.cells.nodes_of(cell);
    for (const int row : nodes)
      if (row < mesh_.nodes.owned) neighbours[row].insert(neighbours[row].end(), nodes.begin(), nodes.end());
  }
  std::vector<PetscInt> here, beyond;
  for (auto& list : neighbours) {
    std::ranges::sort(list);
    list.erase(std::ranges::unique(list).begin(), list.end());
    const auto ghosts = std::ranges::lower_bound(list, mesh_.nodes.owned);
    here.push_back(static_cast<PetscInt>(ghosts - list.begin()));
    beyond.push_back(static_cast<PetscInt>(list.end() - ghosts));
  }
  OwnedMat matrix;
  petsc(MatCreate(comm_, matrix.put()));
  petsc(MatSetSizes(matrix, 2 * mesh_.nodes.owned, 2 * mesh_.nodes.owned, PETSC_DETERMINE, PETSC_DETERMINE));
  petsc(MatSetBlockSize(matrix, 2));
  petsc(MatSetType(matrix, MATAIJ));
  petsc(MatXAIJSetPreallocation(matrix, 2, here.data(), beyond.data(), nullptr, nullptr));
  petsc(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  petsc(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
  petsc(MatSetOption(matrix, MAT_IGNORE_OFF_PROC_ENTRIES, PETSC_TRUE));
  petsc(MatSetOption(matrix, MAT_ROW_ORIENTED, PETSC_FALSE));
  petsc(MatSetOption(matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE));
  return matrix;
}

void CellSystem::load(Vec u) {
  petsc(VecCopy(u, local_));
  petsc(VecGhostUpdateBegin(local_, INSERT_VALUES, SCATTER_FORWARD));
  petsc(VecGhostUpdateEnd(local_, INSERT_VALUES, SCATTER_FORWARD));
  const PetscScalar* values = nullptr;
  petsc(VecGetArrayRead(local_, &values));  // the ghosts lie behind the owned values
  loaded_.resize(static_cast<std::size_t>(mesh_.nodes.size()));
  for (int i = 0; i < mesh_.nodes.size(); ++i) loaded_[i] = {values[2 * i], values[2 * i + 1]};
  petsc(VecRestoreArrayRead(local_, &values));
}

PetscErrorCode CellSystem::residual(Vec u, Vec out) {
  PetscFunctionBeginUser;
  PetscCall(VecCopy(u, local_));
  PetscCall(VecGhostUpdateBegin(local_, INSERT_VALUES, SCATTER_FORWARD));
  PetscCall(VecGhostUpdateEnd(local_, INSERT_VALUES, SCATTER_FORWARD));
  const PetscScalar* values = nullptr;
  PetscScalar* force = nullptr;
  PetscCall(VecGetArrayRead(local_, &values));
  PetscCall(VecGetArrayWrite(out, &force));
  for (int i = 0; i < mesh_.nodes.owned; ++i)
    for (int axis = 0; axis < 2; ++axis) force[2 * i + axis] = -external_[i][axis];
  Eigen::Matrix<double, 8, 1> displacement, element;
  for (int cell = 0; cell < mesh_.cells.size(); ++cell) {
    const int first = mesh_.cells.first[cell], count = mesh_.cells.corner_count(cell);
    for (int c = 0; c < count; ++c) {
      const Vector2& x = mesh_.cells.corners[first + c];
      const PetscScalar* node = values + 2 * mesh_.cells.corner_nodes[first + c];
      displacement[2 * c] = node[0] + strain_[0] * x[0] + 0.5 * strain_[2] * x[1];
      displacement[2 * c + 1] = node[1] + 0.5 * strain_[2] * x[0] + strain_[1] * x[1];
    }
    element.head(2 * count).noalias() =
        element_stiffness(mesh_.cells.corners_of(cell), materials_[mesh_.cells.region[cell]].stiffness) *
        displacement.head(2 * count);
    for (int c = 0; c < count; ++c)
      if (const int node = mesh_.cells.corner_nodes[first + c]; node < mesh_.nodes.owned)
        for (int axis = 0; axis < 2; ++axis) force[2 * node + axis] += element[2 * c + axis];
  }
  for (std::size_t k = 0; k < held_.size(); ++k)
    if (held_[k]) force[k] = 0;
  PetscCall(VecRestoreArrayWrite(out, &force));
  PetscCall(VecRestoreArrayRead(local_, &values));
  PetscFunctionReturn(PetscErrorCode{});
}

PetscErrorCode CellSystem::jacobian(Mat matrix) const {
  PetscFunctionBeginUser;
  PetscCall(MatZeroEntries(matrix));
  for (int cell = 0; cell < mesh_.cells.size(); ++cell) {
    const int first = mesh_.cells.first[cell], count = mesh_.cells.corner_count(cell);
    const ElementStiffness k =
        element_stiffness(mesh_.cells.corners_of(cell), materials_[mesh_.cells.region[cell]].stiffness);
    std::array<PetscInt, 4> rows{}, columns{};
    for (int c = 0; c < count; ++c) {
      const int node = mesh_.cells.corner_nodes[first + c];
      columns[c] = index_[node];
      rows[c] = node < mesh_.nodes.owned ? index_[node] : -1;  // their owners add them
    }
    PetscCall(MatSetValuesBlocked(matrix, count, rows.data(), count, columns.data(), k.data(), ADD_VALUES));
  }
  PetscCall(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  std::vector<PetscInt> rows;
  for (std::size_t k = 0; k < held_.size(); ++k)
    if (held_[k]) rows.push_back(2 * offset_ + static_cast<PetscInt>(k));
  PetscCall(
      MatZeroRowsColumns(matrix, static_cast<PetscInt>(rows.size()), rows.data(), scale_, nullptr, nullptr));
  PetscFunctionReturn(PetscErrorCode{});
}

OwnedMatNullSpace CellSystem::rigid_motions() const {
  OwnedVec coordinates = vector();
  PetscScalar* x = nullptr;
  petsc(VecGetArrayWrite(coordinates, &x));
  for (int i = 0; i < mesh_.nodes.owned; ++i)
    for (int axis = 0; axis < 2; ++axis) x[2 * i + axis] = mesh_.nodes.position[i][axis];
  petsc(VecRestoreArrayWrite(coordinates, &x));
  OwnedMatNullSpace motions;
  petsc(MatNullSpaceCreateRigidBody(coordinates, motions.put()));
  return motions;
}

Vector2 CellSystem::displacement(int corner) const {
  const Vector2& x = mesh_.cells.corners[corner];
  const Vector2& u = loaded_[mesh_.cells.corner_nodes[corner]];
  return {u[0] + strain_[0] * x[0] + 0.5 * strain_[2] * x[1],
          u[1] + 0.5 * strain_[2] * x[0] + strain_[1] * x[1]};
}

}  // namespace slipscale
