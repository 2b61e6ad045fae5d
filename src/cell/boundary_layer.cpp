#include "slipscale/cell/boundary_layer.hpp"

#include <petscksp.h>

#include <algorithm>
#include <numeric>

#include "slipscale/base/error.hpp"
#include "slipscale/base/petsc.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

using OwnedKSP = Owned<KSP, KSPDestroy>;
using OwnedScatter = Owned<VecScatter, VecScatterDestroy>;

/// Numbers coordinates along one axis, those closer than `tolerance` alike.
std::vector<int> levels(const PlaneGrid& grid, int axis, double tolerance) {
  std::vector<int> order(grid.points.size()), level(grid.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int point) { return grid.points[point][axis]; });
  for (std::size_t k = 1; k < order.size(); ++k) {
    const double step = grid.points[order[k]][axis] - grid.points[order[k - 1]][axis];
    level[order[k]] = level[order[k - 1]] + (step > tolerance ? 1 : 0);
  }
  return level;
}

/// Stress less the macroscopic one.
Eigen::Vector3d excess(const PlaneTensor& stress, const PlaneTensor& macroscopic) {
  return {stress[0] - macroscopic[0], stress[1] - macroscopic[1], stress[2] - macroscopic[2]};
}

void add(PlaneTensor& sum, const Eigen::Vector3d& part) {
  for (int i = 0; i < 3; ++i) sum[i] += part[i];
}

}  // namespace

std::vector<int> joined_points(const PlaneGrid& grid) {
  const BoundingBox box = bounding_box(grid);
  const double tolerance = 1e-10 * std::max(box.extent(0), box.extent(1));
  const std::vector<int> x = levels(grid, 0, tolerance), y = levels(grid, 1, tolerance);
  std::vector<int> order(grid.points.size()), first(grid.points.size()), joint(grid.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto place = [&](int point) { return std::array{x[point], y[point], point}; };
  std::ranges::sort(order, {}, place);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && x[order[k]] == x[order[k - 1]] && y[order[k]] == y[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  int count = 0;
  for (std::size_t p = 0; p < joint.size(); ++p)
    joint[p] = first[p] == static_cast<int>(p) ? count++ : joint[first[p]];
  return joint;
}

struct BoundaryLayer::Strip {
  MPI_Comm comm;
  const PlaneGrid& grid;
  std::vector<Eigen::Matrix3d> stiffness;
  RankShare mine;
  std::vector<char> inside;       ///< [cells], of the strip
  std::vector<PetscInt> unknown;  ///< [points] first of its two; −1 where w = 0 or beyond the strip
  PetscInt count = 0;             ///< unknowns
  OwnedMat matrix;
  OwnedVec force, w, everywhere;  ///< `everywhere`: w whole on each rank
  OwnedScatter scatter;
  OwnedKSP ksp;

  Strip(MPI_Comm on, const PlaneGrid& mesh, std::span<const Eigen::Matrix3d> c, RankShare share)
      : comm(on), grid(mesh), stiffness(c.begin(), c.end()), mine(share) {}

  void choose_cells(double depth) {
    const BoundingBox box = bounding_box(grid);
    inside.resize(static_cast<std::size_t>(grid.cells()));
    for (int cell = 0; cell < grid.cells(); ++cell)
      inside[cell] = centre(grid, cell)[1] < box.lower[1] + depth;
    const auto cells = std::ranges::count(inside, 1);
    if (cells == 0 || cells == grid.cells())
      throw UserError(
          format("-relocalize_strip of %g m holds %s of the mesh, which is %g m high; give the "
                 "strip a few diameters of the inclusions, and leave something above it",
                 depth, cells == 0 ? "no cell" : "all cells", box.extent(1)));
  }

  /// Of the points of the strip, except those that it shares with the cells above it.
  void number_unknowns() {
    const std::vector<int> joint = joined_points(grid);
    std::vector<char> below(grid.points.size(), 0), above(grid.points.size(), 0);  // by joint
    for (int cell = 0; cell < grid.cells(); ++cell)
      for (int k = grid.first[cell]; k < grid.first[cell + 1]; ++k)
        (inside[cell] ? below : above)[joint[grid.corners[k]]] = 1;
    std::vector<PetscInt> of_joint(grid.points.size(), -1);
    unknown.assign(grid.points.size(), -1);
    for (std::size_t point = 0; point < grid.points.size(); ++point) {
      const int j = joint[point];
      if (below[j] && !above[j] && of_joint[j] < 0) {
        of_joint[j] = count;
        count += 2;
      }
      unknown[point] = of_joint[j];
    }
  }

  /// The unknowns of a cell, corner-wise (x, y); −1 is skipped by PETSc.
  std::array<PetscInt, 8> rows(int cell) const {
    std::array<PetscInt, 8> found{};
    for (int k = 0; k < grid.corner_count(cell); ++k) {
      const PetscInt first = unknown[grid.corners[grid.first[cell] + k]];
      found[2 * k] = first;
      found[2 * k + 1] = first < 0 ? -1 : first + 1;
    }
    return found;
  }

  /// Calls `visit(cell, place)` for this rank's cells of the strip, `place` counted in its share.
  template <class Visit>
  void for_cells(const Visit& visit) const {
    for (std::size_t cell = mine.begin; cell < mine.end; ++cell)
      if (inside[cell]) visit(static_cast<int>(cell), cell - mine.begin);
  }

  void assemble() {
    petsc(MatCreate(comm, matrix.put()));
    petsc(MatSetSizes(matrix, PETSC_DECIDE, PETSC_DECIDE, count, count));
    petsc(MatSetType(matrix, MATAIJ));
    constexpr PetscInt row = 60;  // a node and some thirty neighbours; more cost time, not the answer
    petsc(MatSeqAIJSetPreallocation(matrix, row, nullptr));
    petsc(MatMPIAIJSetPreallocation(matrix, row, nullptr, row, nullptr));
    petsc(MatSetOption(matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
    petsc(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
    for_cells([&](int cell, std::size_t) {
      ElementStiffness k = element_stiffness(grid.corners_of(cell), stiffness[grid.region[cell]]);
      const auto indices = rows(cell);
      petsc(MatSetValues(matrix, static_cast<PetscInt>(k.rows()), indices.data(),
                         static_cast<PetscInt>(k.cols()), indices.data(), k.data(), ADD_VALUES));
    });
    petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  }

  void factorise() {
    petsc(MatCreateVecs(matrix, w.put(), force.put()));
    petsc(VecSetOption(force, VEC_IGNORE_NEGATIVE_INDICES, PETSC_TRUE));
    petsc(VecScatterCreateToAll(w, scatter.put(), everywhere.put()));
    petsc(KSPCreate(comm, ksp.put()));
    petsc(KSPSetOptionsPrefix(ksp, "relocalize_"));
    petsc(KSPSetOperators(ksp, matrix, matrix));
    petsc(KSPSetType(ksp, KSPPREONLY));
    PC pc = nullptr;
    petsc(KSPGetPC(ksp, &pc));
    petsc(PCSetType(pc, PCCHOLESKY));
    petsc(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
    petsc(KSPSetFromOptions(ksp));
    petsc(KSPSetUp(ksp));
  }

  /// force = −∫ ε(φ) : excess dA
  void load(std::span<const PlaneTensor> macroscopic, std::span<const PlaneTensor> stress) {
    petsc(VecSet(force, 0));
    for_cells([&](int cell, std::size_t place) {
      const StrainDisplacement b = centre_strain_displacement(grid.corners_of(cell));
      const Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1> f =
          -area(grid, cell) * b.transpose() * excess(stress[place], macroscopic[place]);
      petsc(VecSetValues(force, static_cast<PetscInt>(f.size()), rows(cell).data(), f.data(), ADD_VALUES));
    });
    petsc(VecAssemblyBegin(force));
    petsc(VecAssemblyEnd(force));
  }

  void solve() {
    petsc(KSPSolve(ksp, force, w));
    KSPConvergedReason reason;
    petsc(KSPGetConvergedReason(ksp, &reason));
    if (reason < 0)
      throw UserError(std::string("the correction next to the contact did not converge (KSP ") +
                      KSPConvergedReasons[reason] +
                      "); leave the options -relocalize_ksp_ and -relocalize_pc_ out");
    petsc(VecScatterBegin(scatter, w, everywhere, INSERT_VALUES, SCATTER_FORWARD));
    petsc(VecScatterEnd(scatter, w, everywhere, INSERT_VALUES, SCATTER_FORWARD));
  }

  void add_corrector(std::span<PlaneTensor> strain, std::span<PlaneTensor> stress) {
    const PetscScalar* values = nullptr;
    petsc(VecGetArrayRead(everywhere, &values));
    for_cells([&](int cell, std::size_t place) {
      const StrainDisplacement b = centre_strain_displacement(grid.corners_of(cell));
      const auto indices = rows(cell);
      Eigen::Vector3d e = Eigen::Vector3d::Zero();
      for (Eigen::Index k = 0; k < b.cols(); ++k)
        if (indices[k] >= 0) e += values[indices[k]] * b.col(k);
      add(strain[place], e);
      add(stress[place], stiffness[grid.region[cell]] * e);
    });
    petsc(VecRestoreArrayRead(everywhere, &values));
  }
};

BoundaryLayer::BoundaryLayer(MPI_Comm comm, const PlaneGrid& grid, std::span<const Eigen::Matrix3d> stiffness,
                             RankShare mine, double depth)
    : strip_(std::make_unique<Strip>(comm, grid, stiffness, mine)) {
  strip_->choose_cells(depth);
  strip_->number_unknowns();
  strip_->assemble();
  strip_->factorise();
}

BoundaryLayer::~BoundaryLayer() = default;

void BoundaryLayer::correct(std::span<const PlaneTensor> macroscopic, std::span<PlaneTensor> strain,
                            std::span<PlaneTensor> stress) {
  strip_->load(macroscopic, stress);
  strip_->solve();
  strip_->add_corrector(strain, stress);
}

long BoundaryLayer::unknowns() const { return strip_->count; }
long BoundaryLayer::cells() const { return static_cast<long>(std::ranges::count(strip_->inside, 1)); }

}  // namespace slipscale
