#include "cell_system.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/homogenize/effective.hpp"

namespace slipscale {

CellCorners seen_corners(const Mesh& mesh, int element) {
  CellCorners seen;
  const int first = mesh.cells.first[element];
  for (; seen.count < static_cast<std::size_t>(mesh.cells.corner_count(element)); ++seen.count) {
    const Vector2& x = mesh.cells.corners[first + static_cast<int>(seen.count)];
    seen.x[seen.count] = {x[0] - mesh.cells.corners[first][0], x[1] - mesh.cells.corners[first][1]};
  }
  return seen;
}

CellSystem::CellSystem(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials)
    : comm_(comm),
      mesh_(mesh),
      materials_(materials),
      held_(2 * static_cast<std::size_t>(mesh.nodes.owned)),
      external_(static_cast<std::size_t>(mesh.nodes.owned)),
      cancelling_(2 * static_cast<std::size_t>(mesh.nodes.owned)) {
  PetscInt owned = mesh.nodes.owned;
  MPI_Exscan(&owned, &offset_, 1, MPIU_INT, MPI_SUM, comm);
  for (int i = 0; i < mesh.nodes.owned; ++i) index_.push_back(offset_ + i);
  index_.insert(index_.end(), mesh.nodes.ghosts.begin(), mesh.nodes.ghosts.end());
  for (const Material& material : materials) {
    locks_.push_back(nearly_incompressible(material.stiffness));
    scale_ = std::max(scale_, material.stiffness.diagonal().maxCoeff());
  }
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

bool CellSystem::is_nearly_incompressible() const { return std::ranges::count(locks_, 1) > 0; }

ElementStiffness CellSystem::stiffness(int element) const {
  const int region = mesh_.cells.region[element];
  const CellCorners seen = corners(element);
  return locks_[region] ? mean_dilatation_stiffness(seen, materials_[region].stiffness)
                        : element_stiffness(seen, materials_[region].stiffness);
}

Vector2 CellSystem::homogeneous(const Vector2& corner) const {
  return {strain_[0] * corner[0] + 0.5 * strain_[2] * corner[1],
          0.5 * strain_[2] * corner[0] + strain_[1] * corner[1]};
}

OwnedMat CellSystem::matrix() const {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(mesh_.nodes.owned));
  for (int element = 0; element < mesh_.cells.size(); ++element) {
    const auto nodes = mesh_.cells.nodes_of(element);
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

void CellSystem::add_to_residual(int element, const PetscScalar* u, PetscScalar* force) {
  const int count = mesh_.cells.corner_count(element);
  const int* nodes = mesh_.cells.corner_nodes.data() + mesh_.cells.first[element];
  const CellCorners seen = corners(element);
  Displacements relative(2 * count), size(2 * count);
  for (int c = 0; c < count; ++c) {
    const Vector2 of_strain = homogeneous(seen.x[c]);
    for (int axis = 0; axis < 2; ++axis) {
      const PetscScalar here = u[2 * nodes[c] + axis];
      relative[2 * c + axis] = here - u[2 * nodes[0] + axis] + of_strain[axis];
      size[2 * c + axis] = std::abs(here) + std::abs(of_strain[axis]);
    }
  }
  const ElementStiffness k = stiffness(element);
  const Displacements forces = k * relative, sizes = k.cwiseAbs() * size;
  for (int c = 0; c < count; ++c)
    if (nodes[c] < mesh_.nodes.owned)
      for (int axis = 0; axis < 2; ++axis) {
        force[2 * nodes[c] + axis] += forces[2 * c + axis];
        cancelling_[2 * nodes[c] + axis] += sizes[2 * c + axis];
      }
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
  std::ranges::fill(cancelling_, 0.0);
  for (int element = 0; element < mesh_.cells.size(); ++element) add_to_residual(element, values, force);
  for (std::size_t k = 0; k < held_.size(); ++k)
    if (held_[k]) force[k] = cancelling_[k] = 0;
  PetscCall(VecRestoreArrayWrite(out, &force));
  PetscCall(VecRestoreArrayRead(local_, &values));
  PetscFunctionReturn(PetscErrorCode{});
}

PetscErrorCode CellSystem::cancelling_forces(PetscReal* size) const {
  PetscFunctionBeginUser;
  double squares = 0;
  for (const double force : cancelling_) squares += force * force;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &squares, 1, MPI_DOUBLE, MPI_SUM, comm_));
  *size = std::sqrt(squares);
  PetscFunctionReturn(PetscErrorCode{});
}

PetscErrorCode CellSystem::jacobian(Mat matrix) const {
  PetscFunctionBeginUser;
  PetscCall(MatZeroEntries(matrix));
  for (int element = 0; element < mesh_.cells.size(); ++element) {
    const int first = mesh_.cells.first[element], count = mesh_.cells.corner_count(element);
    const ElementStiffness k = stiffness(element);
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
    for (int axis = 0; axis < 2; ++axis)
      x[2 * i + axis] = mesh_.nodes.position[i][axis] - 0.5 * (mesh_.lower[axis] + mesh_.upper[axis]);
  petsc(VecRestoreArrayWrite(coordinates, &x));
  OwnedMatNullSpace motions;
  petsc(MatNullSpaceCreateRigidBody(coordinates, motions.put()));
  return motions;
}

CellSystem::Displacements CellSystem::displacements(int element) const {
  const int count = mesh_.cells.corner_count(element);
  const int* nodes = mesh_.cells.corner_nodes.data() + mesh_.cells.first[element];
  const CellCorners seen = corners(element);
  Displacements relative(2 * count);
  for (int c = 0; c < count; ++c) {
    const Vector2 of_strain = homogeneous(seen.x[c]);
    for (int axis = 0; axis < 2; ++axis)
      relative[2 * c + axis] = loaded_[nodes[c]][axis] - loaded_[nodes[0]][axis] + of_strain[axis];
  }
  return relative;
}

}  // namespace slipscale
