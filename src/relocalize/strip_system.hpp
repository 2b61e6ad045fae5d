#pragma once

#include <petscksp.h>

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "slipscale/base/petsc.hpp"
#include "slipscale/mesh/plane_grid.hpp"
#include "slipscale/solid/element.hpp"

namespace slipscale {

using OwnedKSP = Owned<KSP, KSPDestroy>;
using OwnedScatter = Owned<VecScatter, VecScatterDestroy>;

/// The points of a strip of cells at the lower side of a mesh: joined where copies of a cell touch, apart
/// from those of the inner edge, and those on the lower side, which may touch the surface.
class StripPoints {
 public:
  /// `inside` [cells]: of the strip.
  StripPoints(const PlaneGrid& grid, const std::vector<char>& inside);

  std::size_t count() const { return free_count_; }  ///< without those of the inner edge
  std::size_t contact_count() const { return contact_count_; }

  /// Of a corner of a cell; −1 on the inner edge, or off the contact.
  int free_node(int cell, int corner) const { return free_[grid_.corners[grid_.first[cell] + corner]]; }
  int contact_node(int cell, int corner) const { return contact_[grid_.corners[grid_.first[cell] + corner]]; }
  bool touches_contact(int cell) const;

  /// The contact node of each free node, or −1; [count].
  const std::vector<int>& contact_of_free() const { return contact_of_free_; }
  const std::vector<int>& free_of_contact() const { return free_of_contact_; }

 private:
  const PlaneGrid& grid_;
  std::vector<int> free_, contact_;  ///< [points]
  std::vector<int> contact_of_free_, free_of_contact_;
  std::size_t free_count_ = 0, contact_count_ = 0;
};

/// Linear elasticity of the strip, all of its contact nodes free: factorised once, solved often. Every rank
/// adds its own cells. All members but those that only look are collective.
class StripSystem {
 public:
  StripSystem(MPI_Comm comm, const PlaneGrid& grid, const StripPoints& points);

  void add_cell(int cell, const ElementStiffness& stiffness);
  void factorise();

  using CellVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1>;
  void clear_force();
  void add_force(int cell, const CellVector& force);    ///< N/m, corner-wise (x, y)
  void add_contact(const std::vector<Vector2>& force);  ///< [contact nodes] N/m, the same on every rank
  void solve();
  CellVector displacement(int cell) const;            ///< m, of the last solution
  std::vector<Vector2> contact_displacement() const;  ///< [contact nodes] m, of the last solution

  /// Displacement of all contact nodes under a force of 1 N/m along y at each of `contacts` alone,
  /// [contacts][contact nodes], m per N/m.
  std::vector<std::vector<Vector2>> responses(const std::vector<int>& contacts) const;

  PetscInt unknowns() const { return count_; }

 private:
  std::array<PetscInt, 8> rows(int cell) const;
  PetscInt row(int contact, int axis) const { return 2 * points_.free_of_contact()[contact] + axis; }

  MPI_Comm comm_;
  const PlaneGrid& grid_;
  const StripPoints& points_;
  PetscInt count_;  ///< x and y of each free node in turn
  OwnedMat matrix_;
  OwnedVec force_, solution_, everywhere_;  ///< the last: the solution, whole on each rank
  OwnedScatter scatter_;
  OwnedKSP ksp_;
  std::vector<double> values_;
};

}  // namespace slipscale
