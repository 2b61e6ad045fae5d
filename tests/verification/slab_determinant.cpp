#include "slab_determinant.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace slipscale::testing_support {
namespace {

constexpr Complex i{0, 1};

/// The matrix of Christoffel's equation at one η, and the displacement it leaves free.
struct Christoffel {
  Christoffel(const Eigen::Matrix3cd& c, Complex inertia, Complex eta)
      : xx(c(0, 0) + eta * (2.0 * c(0, 2) + eta * c(2, 2)) + inertia),
        xy(c(0, 2) + eta * (c(0, 1) + c(2, 2) + eta * c(1, 2))) {}
  Complex xx, xy;
  Eigen::Vector2cd displacement() const { return {-xy, xx}; }
};

/// The four η with det = 0: eigenvalues of the quartic's companion matrix.
Eigen::Vector4cd vertical_wave_numbers(const Eigen::Matrix3cd& c, Complex inertia) {
  const std::array<Complex, 3> xx{c(0, 0) + inertia, 2.0 * c(0, 2), c(2, 2)},
      yy{c(2, 2) + inertia, 2.0 * c(1, 2), c(1, 1)}, xy{c(0, 2), c(0, 1) + c(2, 2), c(1, 2)};
  std::array<Complex, 5> quartic{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) quartic[a + b] += xx[a] * yy[b] - xy[a] * xy[b];
  Eigen::Matrix4cd companion = Eigen::Matrix4cd::Zero();
  for (int row = 0; row < 4; ++row) {
    if (row > 0) companion(row, row - 1) = 1;
    companion(row, 3) = -quartic[static_cast<std::size_t>(row)] / quartic[4];
  }
  return companion.eigenvalues();
}

/// Zero where xx and xy vanish at one η, so that `displacement` is no longer an eigenvector: the resultant of
/// the two quadratics.
Complex without_displacement(const Eigen::Matrix3cd& c, Complex inertia) {
  const std::array<Complex, 3> a{c(0, 0) + inertia, 2.0 * c(0, 2), c(2, 2)},
      b{c(0, 2), c(0, 1) + c(2, 2), c(1, 2)};
  const Complex outer = a[2] * b[0] - a[0] * b[2];
  return outer * outer - (a[2] * b[1] - a[1] * b[2]) * (a[1] * b[0] - a[0] * b[1]);
}

Complex transmitted(const SlidingSlab& slab, Complex p) {
  return slab.friction / (1.0 + p * slab.relaxation_time);
}

}  // namespace

double SlidingSlab::shear_speed() const { return std::sqrt(stiffness(2, 2) / density); }

Complex slab_determinant(const SlidingSlab& slab, Complex p) {
  const double k = slab.wave_number;
  const Eigen::Matrix3cd c = slab.stiffness.cast<Complex>() * (1.0 + slab.damping * p);
  const Complex inertia = slab.density * p * p / (k * k);
  const Eigen::Vector4cd eta = vertical_wave_numbers(c, inertia);
  Eigen::Matrix4cd rows;
  Complex coincidence = 1;
  for (int j = 0; j < 4; ++j) {
    const Eigen::Vector2cd u = Christoffel(c, inertia, eta(j)).displacement();
    const Eigen::Vector3cd strain{u(0), eta(j) * u(1), eta(j) * u(0) + u(1)};  // over ik
    const Eigen::Vector3cd stress = c * strain;
    const Complex top = std::exp(i * k * eta(j) * slab.height);
    rows.col(j) << top * u(0), top * u(1), u(1), stress(2) - transmitted(slab, p) * stress(1);
    for (int other = 0; other < j; ++other) coincidence *= eta(j) - eta(other);
  }
  return rows.determinant() / (coincidence * without_displacement(c, inertia));
}

Complex potential_determinant(const SlidingSlab& slab, Complex p) {
  const double k = slab.wave_number;
  const Complex factor = 1.0 + slab.damping * p, shear = slab.stiffness(2, 2) * factor,
                lame = slab.stiffness(0, 1) * factor;
  const Complex inertia = slab.density * p * p;
  const Complex d = std::sqrt(k * k + inertia / (lame + 2.0 * shear)), s = std::sqrt(k * k + inertia / shear);
  // u = ∇φ + (∂ψ/∂y, −∂ψ/∂x) with φ ~ exp(±dy), ψ ~ exp(±sy).
  Eigen::Matrix4cd rows;
  int column = 0;
  for (const double sign : {1.0, -1.0}) {
    const Complex y = sign * d, top = std::exp(y * slab.height);
    const Complex normal = (lame + 2.0 * shear) * y * y - lame * k * k, tangential = 2.0 * shear * i * k * y;
    rows.col(column++) << top * i * k, top * y, y, tangential - transmitted(slab, p) * normal;
  }
  for (const double sign : {1.0, -1.0}) {
    const Complex y = sign * s, top = std::exp(y * slab.height);
    const Complex normal = -2.0 * shear * i * k * y, tangential = shear * (y * y + k * k);
    rows.col(column++) << top * y, -top * i * k, -i * k, tangential - transmitted(slab, p) * normal;
  }
  return rows.determinant();
}

Complex zero_near(const std::function<Complex(Complex)>& function, Complex start) {
  std::array<Complex, 3> x{start * 0.999, start * 1.001, start}, f{};
  for (std::size_t n = 0; n < 3; ++n) f[n] = function(x[n]);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Complex last = (f[2] - f[1]) / (x[2] - x[1]), before = (f[1] - f[0]) / (x[1] - x[0]);
    const Complex bend = (last - before) / (x[2] - x[0]), slope = last + (x[2] - x[1]) * bend;
    const Complex root = std::sqrt(slope * slope - 4.0 * f[2] * bend);
    const Complex larger = std::abs(slope + root) > std::abs(slope - root) ? slope + root : slope - root;
    const Complex next = x[2] - 2.0 * f[2] / larger;
    if (std::abs(next - x[2]) <= 1e-13 * std::abs(next) || f[2] == 0.0) return next;
    x = {x[1], x[2], next};
    f = {f[1], f[2], function(next)};
  }
  return {std::numeric_limits<double>::quiet_NaN(), 0};
}

Complex scaled_mode(const SlidingSlab& slab, Complex start) {
  const double unit = slab.wave_number * slab.shear_speed();
  return zero_near([&](Complex s) { return slab_determinant(slab, s * unit); }, start);
}

}  // namespace slipscale::testing_support
