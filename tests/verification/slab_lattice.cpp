#include "slab_lattice.hpp"

#include <algorithm>
#include <cmath>

namespace slipscale::testing_support {
namespace {

using Layer = Eigen::Matrix4cd;  ///< x and y at the lower, then at the upper nodes of a layer

/// Stiffness of one layer of square elements for the wave; their side cancels. 2 × 2 Gauss points.
Layer layer_stiffness(const Eigen::Matrix3d& c, double phase) {
  const Complex right = std::polar(1.0, phase);
  Layer stiffness = Layer::Zero();
  for (const double x : {0.5 - std::sqrt(3) / 6, 0.5 + std::sqrt(3) / 6})
    for (const double y : {0.5 - std::sqrt(3) / 6, 0.5 + std::sqrt(3) / 6}) {
      Eigen::Matrix<Complex, 3, 4> strain = Eigen::Matrix<Complex, 3, 4>::Zero();
      for (int upper = 0; upper < 2; ++upper) {
        const double along = upper ? y : 1 - y, rise = upper ? 1 : -1;
        const Complex dx = (right - 1.0) * along, dy = ((1 - x) + x * right) * rise;
        strain(0, 2 * upper) = strain(2, 2 * upper + 1) = dx;
        strain(1, 2 * upper + 1) = strain(2, 2 * upper) = dy;
      }
      stiffness += 0.25 * strain.adjoint() * c * strain;
    }
  return stiffness;
}

}  // namespace

std::vector<Complex> lattice_modes(const SlabLattice& lattice) {
  const SlidingSlab& slab = lattice.slab;
  const double h = lattice.spacing;
  const Layer layer = layer_stiffness(slab.stiffness, slab.wave_number * h);
  const auto layers = static_cast<Eigen::Index>(std::lround(slab.height / h)), size = 2 * layers;
  // Rows (x, y) of the nodes from the bottom up; the top is held.
  Eigen::MatrixXcd stiffness = Eigen::MatrixXcd::Zero(size + 2, size + 2);
  for (Eigen::Index j = 0; j < layers; ++j) stiffness.block<4, 4>(2 * j, 2 * j) += layer;
  Eigen::VectorXd inverse_mass = Eigen::VectorXd::Constant(size, 1 / (slab.density * h * h));
  inverse_mass.head<2>() *= 2;

  // The bottom's y row is the contact force; its place in the state goes to the friction force φ.
  const Eigen::Index friction = 1;
  Eigen::MatrixXcd internal = stiffness.topLeftCorner(size, size);
  internal.col(friction).setZero();
  const Eigen::RowVectorXcd push = slab.friction * internal.row(friction);
  internal.row(friction).setZero();
  if (slab.relaxation_time == 0) internal.row(0) -= push;
  Eigen::MatrixXcd motion = Eigen::MatrixXcd::Zero(2 * size, 2 * size);
  motion.topRightCorner(size, size).setIdentity();
  motion.bottomLeftCorner(size, size) = -(inverse_mass.asDiagonal() * internal);
  motion.row(friction).setZero();
  if (slab.relaxation_time > 0) {
    motion.row(friction).head(size) = push / slab.relaxation_time;
    motion(friction, friction) = -1 / slab.relaxation_time;
    motion(size, friction) = inverse_mass(0);
  }
  const Eigen::VectorXcd modes = motion.eigenvalues();
  return {modes.begin(), modes.end()};
}

Complex fastest(const std::vector<Complex>& modes) {
  return *std::max_element(modes.begin(), modes.end(),
                           [](const Complex& a, const Complex& b) { return a.real() < b.real(); });
}

Complex with_time_step(Complex p, double time_step) {
  return 2.0 / time_step * std::asinh(0.5 * p * time_step);
}

}  // namespace slipscale::testing_support
