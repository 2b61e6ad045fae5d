#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "slipscale/dynamics/model.hpp"

namespace slipscale {

/// A vector over the free components of this rank, and several of them side by side, [free, columns].
using Column = Eigen::VectorXd;
using Columns = Eigen::MatrixXd;

/// A side that a rigid plate keeps straight (see dynamics/straight_sides.hpp): its nodes move along y with U,
/// or with U + θ s, where s is the distance along x from the centre of all the mass that moves with the
/// plate, so that the mass matrix of U and θ is diagonal.
struct PlateSide {
  std::string boundary;
  bool tilts = false;
  std::vector<int> node;         ///< owned ones
  std::vector<double> arm;       ///< s of each, m
  double middle = 0;             ///< s of the side's middle, where the force acts, m
  double force = 0;              ///< along +y, N/m
  double mass = 0, inertia = 0;  ///< nodes and plate, kg/m and kg m
};

/// The components of the displacement that are free to move, as unknowns: u = C w. Those that are held have
/// no column in C; a straight side has one or two for all of its nodes, on rank 0 behind that rank's others.
class FreeComponents {
 public:
  /// `held` [2 owned nodes]: whether a component is prescribed. Collective.
  FreeComponents(MPI_Comm comm, const Model& model, const std::vector<char>& held,
                 std::vector<PlateSide> sides);

  Eigen::Index size() const { return size_; }  ///< of this rank
  PetscInt total() const { return total_; }
  /// Where the unknowns of straight sides begin, which are rank 0's last; `size()` where there are none.
  Eigen::Index side_begin() const { return side_place_; }
  /// Where a component of an owned node stands among this rank's; −1: held, or on a straight side.
  int place_of(int node, int axis) const { return place_[2 * static_cast<std::size_t>(node) + axis]; }
  /// CᵀMC with the plates, which is diagonal, kg/m (of a tilt kg m).
  const Column& mass() const { return mass_; }
  const std::vector<PlateSide>& sides() const { return sides_; }

  /// u = C w of the owned nodes; 0 where a component is held. Collective where a side is kept straight.
  void expand(const double* w, Vector2* u) const;
  /// r = Cᵀ f. Collective where a side is kept straight.
  void restrict_to(const Vector2* force, double* r) const;
  /// C, [components of all nodes, free].
  OwnedMat matrix() const;

 private:
  MPI_Comm comm_;
  int owned_;
  std::vector<int> place_;
  std::vector<PlateSide> sides_;
  Eigen::Index size_ = 0;
  Eigen::Index side_place_ = 0;  ///< on rank 0: of the first side's U
  int side_count_ = 0;           ///< unknowns of all sides
  PetscInt total_ = 0;
  Column mass_;
};

}  // namespace slipscale
