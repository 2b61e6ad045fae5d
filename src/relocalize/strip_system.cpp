#include "strip_system.hpp"

#include <algorithm>

#include "slipscale/base/error.hpp"
#include "slipscale/base/factorisation.hpp"
#include "slipscale/relocalize/boundary_layer.hpp"

namespace slipscale {
namespace {

[[noreturn]] void refuse_singular() {
  throw UserError(
      "the strip next to the contact cannot be solved (-relocalize_correction strip): it is singular, so "
      "parts "
      "of it hang on nothing, or its stiffnesses differ too much; give another -relocalize_strip, or leave "
      "the "
      "correction out");
}

}  // namespace

StripPoints::StripPoints(const PlaneGrid& grid, const std::vector<char>& inside)
    : grid_(grid), free_(grid.points.size(), -1), contact_(grid.points.size(), -1) {
  const std::vector<int> joint = joined_points(grid);
  const Box box = bounding_box(grid);
  const double lowest = box.lower[1] + 1e-9 * box.extent(1);
  std::vector<char> below(grid.points.size(), 0), above(grid.points.size(), 0);  // by joint
  for (int cell = 0; cell < grid.cells(); ++cell)
    for (int k = grid.first[cell]; k < grid.first[cell + 1]; ++k)
      (inside[cell] ? below : above)[joint[grid.corners[k]]] = 1;
  std::vector<int> known(grid.points.size(), -1);  // by joint
  for (std::size_t point = 0; point < grid.points.size(); ++point) {
    const int j = joint[point];
    if (!below[j] || above[j]) continue;
    if (known[j] < 0) {
      known[j] = static_cast<int>(free_count_++);
      const bool touches = grid.points[point][1] <= lowest;
      contact_of_free_.push_back(touches ? static_cast<int>(contact_count_++) : -1);
      if (touches) free_of_contact_.push_back(known[j]);
    }
    free_[point] = known[j];
    contact_[point] = contact_of_free_[known[j]];
  }
}

bool StripPoints::touches_contact(int cell) const {
  for (int k = 0; k < grid_.corner_count(cell); ++k)
    if (contact_node(cell, k) >= 0) return true;
  return false;
}

StripSystem::StripSystem(MPI_Comm comm, const PlaneGrid& grid, const StripPoints& points)
    : comm_(comm), grid_(grid), points_(points), count_(2 * static_cast<PetscInt>(points.count())) {
  petsc(MatCreate(comm, matrix_.put()));
  petsc(MatSetSizes(matrix_, PETSC_DECIDE, PETSC_DECIDE, count_, count_));
  petsc(MatSetType(matrix_, MATAIJ));
  constexpr PetscInt row = 60;  // a node and up to thirty neighbours; more cost time, not the answer
  petsc(MatSeqAIJSetPreallocation(matrix_, row, nullptr));
  petsc(MatMPIAIJSetPreallocation(matrix_, row, nullptr, row, nullptr));
  petsc(MatSetOption(matrix_, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  petsc(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
  petsc(MatCreateVecs(matrix_, solution_.put(), force_.put()));
  petsc(VecSetOption(force_, VEC_IGNORE_NEGATIVE_INDICES, PETSC_TRUE));
  petsc(VecScatterCreateToAll(solution_, scatter_.put(), everywhere_.put()));
  values_.resize(static_cast<std::size_t>(count_));
}

/// −1 is skipped by PETSc.
std::array<PetscInt, 8> StripSystem::rows(int cell) const {
  std::array<PetscInt, 8> found{};
  for (int k = 0; k < grid_.corner_count(cell); ++k) {
    const int node = points_.free_node(cell, k);
    for (int i = 0; i < 2; ++i) found[2 * k + i] = node < 0 ? -1 : 2 * node + i;
  }
  return found;
}

void StripSystem::add_cell(int cell, const ElementStiffness& stiffness) {
  const auto indices = rows(cell);
  const auto size = static_cast<PetscInt>(stiffness.rows());
  petsc(MatSetValues(matrix_, size, indices.data(), size, indices.data(), stiffness.data(), ADD_VALUES));
}

void StripSystem::factorise() {
  petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  petsc(KSPCreate(comm_, ksp_.put()));
  petsc(KSPSetOperators(ksp_, matrix_, matrix_));
  petsc(KSPSetType(ksp_, KSPPREONLY));
  PC pc = nullptr;
  petsc(KSPGetPC(ksp_, &pc));
  petsc(PCSetType(pc, PCCHOLESKY));
  petsc(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  do petsc(KSPSetUp(ksp_));
  while (enlarge_workspace(ksp_));
  PCFailedReason reason = PC_NOERROR;
  petsc(PCGetFailedReason(pc, &reason));
  if (reason != PC_NOERROR) refuse_singular();
}

void StripSystem::clear_force() { petsc(VecSet(force_, 0)); }

void StripSystem::add_force(int cell, const CellVector& force) {
  petsc(
      VecSetValues(force_, static_cast<PetscInt>(force.size()), rows(cell).data(), force.data(), ADD_VALUES));
}

void StripSystem::add_contact(const std::vector<Vector2>& force) {
  PetscInt begin = 0, end = 0;
  petsc(VecGetOwnershipRange(force_, &begin, &end));
  for (std::size_t contact = 0; contact < force.size(); ++contact)
    for (int i = 0; i < 2; ++i) {
      const PetscInt place = row(static_cast<int>(contact), i);
      if (place >= begin && place < end) petsc(VecSetValue(force_, place, force[contact][i], ADD_VALUES));
    }
}

void StripSystem::solve() {
  petsc(VecAssemblyBegin(force_));
  petsc(VecAssemblyEnd(force_));
  petsc(KSPSolve(ksp_, force_, solution_));
  KSPConvergedReason reason;
  petsc(KSPGetConvergedReason(ksp_, &reason));
  if (reason < 0) refuse_singular();
  petsc(VecScatterBegin(scatter_, solution_, everywhere_, INSERT_VALUES, SCATTER_FORWARD));
  petsc(VecScatterEnd(scatter_, solution_, everywhere_, INSERT_VALUES, SCATTER_FORWARD));
  const PetscScalar* values = nullptr;
  petsc(VecGetArrayRead(everywhere_, &values));
  std::copy_n(values, values_.size(), values_.begin());
  petsc(VecRestoreArrayRead(everywhere_, &values));
}

std::vector<Vector2> StripSystem::contact_displacement() const {
  std::vector<Vector2> found;
  for (std::size_t k = 0; k < points_.contact_count(); ++k)
    found.push_back({values_[row(static_cast<int>(k), 0)], values_[row(static_cast<int>(k), 1)]});
  return found;
}

std::vector<std::vector<Vector2>> StripSystem::responses(const std::vector<int>& contacts) const {
  constexpr std::size_t at_once = 32;  // right-hand sides of one pair of triangular solves
  const std::size_t width = points_.contact_count();
  std::vector<std::vector<Vector2>> found(contacts.size(), std::vector<Vector2>(width, Vector2{}));
  PetscInt begin = 0, end = 0;
  petsc(VecGetOwnershipRange(force_, &begin, &end));
  const auto is_mine = [&](PetscInt place) { return place >= begin && place < end; };
  for (std::size_t first = 0; first < contacts.size(); first += at_once) {
    const auto columns = static_cast<PetscInt>(std::min(at_once, contacts.size() - first));
    OwnedMat force, moved;
    petsc(MatCreateDense(comm_, end - begin, PETSC_DECIDE, count_, columns, nullptr, force.put()));
    for (PetscInt c = 0; c < columns; ++c)
      if (const PetscInt place = row(contacts[first + c], 1); is_mine(place))
        petsc(MatSetValue(force, place, c, 1, INSERT_VALUES));
    petsc(MatAssemblyBegin(force, MAT_FINAL_ASSEMBLY));
    petsc(MatAssemblyEnd(force, MAT_FINAL_ASSEMBLY));
    petsc(MatDuplicate(force, MAT_DO_NOT_COPY_VALUES, moved.put()));
    petsc(KSPMatSolve(ksp_, force, moved));
    const PetscScalar* values = nullptr;
    PetscInt stride = 0;
    petsc(MatDenseGetLDA(moved, &stride));
    petsc(MatDenseGetArrayRead(moved, &values));
    for (PetscInt c = 0; c < columns; ++c)
      for (std::size_t k = 0; k < width; ++k)
        for (int i = 0; i < 2; ++i)
          if (const PetscInt place = row(static_cast<int>(k), i); is_mine(place))
            found[first + c][k][i] = values[c * stride + place - begin];
    petsc(MatDenseRestoreArrayRead(moved, &values));
    for (PetscInt c = 0; c < columns; ++c)
      MPI_Allreduce(MPI_IN_PLACE, found[first + c].data(), static_cast<int>(2 * width), MPI_DOUBLE, MPI_SUM,
                    comm_);
  }
  return found;
}

StripSystem::CellVector StripSystem::displacement(int cell) const {
  const auto indices = rows(cell);
  CellVector found(2 * grid_.corner_count(cell));
  for (Eigen::Index k = 0; k < found.size(); ++k) found[k] = indices[k] < 0 ? 0 : values_[indices[k]];
  return found;
}

}  // namespace slipscale
