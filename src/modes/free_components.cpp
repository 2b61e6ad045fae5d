#include "slipscale/modes/free_components.hpp"

#include "slipscale/base/parallel.hpp"

namespace slipscale {

FreeComponents::FreeComponents(MPI_Comm comm, const Model& model, const std::vector<char>& held,
                               std::vector<PlateSide> sides)
    : comm_(comm),
      owned_(model.mesh.nodes.owned),
      place_(2 * static_cast<std::size_t>(owned_), 0),
      sides_(std::move(sides)) {
  for (std::size_t k = 0; k < place_.size(); ++k)
    if (held[k]) place_[k] = -1;
  for (const PlateSide& side : sides_) {
    for (const int i : side.node) place_[2 * static_cast<std::size_t>(i) + 1] = -1;
    side_count_ += side.tilts ? 2 : 1;
  }
  for (int& place : place_)
    if (place == 0) place = static_cast<int>(size_++);
  side_place_ = size_;
  if (is_root(comm)) size_ += side_count_;
  auto own = static_cast<PetscInt>(size_);
  MPI_Allreduce(&own, &total_, 1, MPIU_INT, MPI_SUM, comm);
  mass_.resize(size_);
  for (int i = 0; i < owned_; ++i)
    for (int axis = 0; axis < 2; ++axis)
      if (const int k = place_of(i, axis); k >= 0) mass_[k] = model.mass[i];
  Eigen::Index k = side_place_;
  if (is_root(comm))
    for (const PlateSide& side : sides_) {
      mass_[k++] = side.mass;
      if (side.tilts) mass_[k++] = side.inertia;
    }
}

void FreeComponents::expand(const double* w, Vector2* u) const {
  for (int i = 0; i < owned_; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      const int k = place_of(i, axis);
      u[i][axis] = k >= 0 ? w[k] : 0;
    }
  if (sides_.empty()) return;
  std::vector<double> motion(static_cast<std::size_t>(side_count_));
  if (is_root(comm_)) std::copy_n(w + side_place_, side_count_, motion.data());
  MPI_Bcast(motion.data(), side_count_, MPI_DOUBLE, 0, comm_);
  std::size_t at = 0;
  for (const PlateSide& side : sides_) {
    const double lift = motion[at++], tilt = side.tilts ? motion[at++] : 0;
    for (std::size_t n = 0; n < side.node.size(); ++n) u[side.node[n]][1] = lift + tilt * side.arm[n];
  }
}

void FreeComponents::restrict_to(const Vector2* force, double* r) const {
  for (int i = 0; i < owned_; ++i)
    for (int axis = 0; axis < 2; ++axis)
      if (const int k = place_of(i, axis); k >= 0) r[k] = force[i][axis];
  if (sides_.empty()) return;
  std::vector<double> sums;
  for (const PlateSide& side : sides_) {
    double sum = 0, moment = 0;
    for (std::size_t n = 0; n < side.node.size(); ++n) {
      sum += force[side.node[n]][1];
      moment += force[side.node[n]][1] * side.arm[n];
    }
    sums.push_back(sum);
    if (side.tilts) sums.push_back(moment);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), side_count_, MPI_DOUBLE, MPI_SUM, comm_);
  if (is_root(comm_)) std::copy(sums.begin(), sums.end(), r + side_place_);
}

OwnedMat FreeComponents::matrix() const {
  OwnedMat c;
  petsc(MatCreateAIJ(comm_, 2 * owned_, static_cast<PetscInt>(size_), PETSC_DETERMINE, PETSC_DETERMINE, 2,
                     nullptr, 2, nullptr, c.put()));
  PetscInt row = 0, column = 0, side_column = static_cast<PetscInt>(side_place_);
  petsc(MatGetOwnershipRange(c, &row, nullptr));
  petsc(MatGetOwnershipRangeColumn(c, &column, nullptr));
  MPI_Bcast(&side_column, 1, MPIU_INT, 0, comm_);
  for (int i = 0; i < owned_; ++i)
    for (int axis = 0; axis < 2; ++axis)
      if (const int k = place_of(i, axis); k >= 0)
        petsc(MatSetValue(c, row + 2 * i + axis, column + k, 1, INSERT_VALUES));
  for (const PlateSide& side : sides_) {
    for (std::size_t n = 0; n < side.node.size(); ++n) {
      petsc(MatSetValue(c, row + 2 * side.node[n] + 1, side_column, 1, INSERT_VALUES));
      if (side.tilts)
        petsc(MatSetValue(c, row + 2 * side.node[n] + 1, side_column + 1, side.arm[n], INSERT_VALUES));
    }
    side_column += side.tilts ? 2 : 1;
  }
  petsc(MatAssemblyBegin(c, MAT_FINAL_ASSEMBLY));
  petsc(MatAssemblyEnd(c, MAT_FINAL_ASSEMBLY));
  return c;
}

}  // namespace slipscale
