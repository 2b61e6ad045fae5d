#include "slipscale/homogenize/effective.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace slipscale {
namespace {

Eigen::Matrix3d symmetric_part(const Eigen::Matrix3d& c) { return 0.5 * (c + c.transpose()); }

/// Eigenvalues of the symmetric part, ascending.
Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& c) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric_part(c), Eigen::EigenvaluesOnly)
      .eigenvalues();
}

/// C on the orthonormal basis (xx, yy, √2 xy), on which the length of a tensor is that of its components.
Eigen::Matrix3d mandel(const Eigen::Matrix3d& c) {
  const Eigen::DiagonalMatrix<double, 3> scale(1, 1, std::sqrt(2.0));
  return scale * c * scale;
}

/// Plane isotropic C of plane bulk modulus k and shear modulus g, Pa.
Eigen::Matrix3d plane_isotropic(double k, double g) {
  Eigen::Matrix3d c;
  c << k + g, k - g, 0, k - g, k + g, 0, 0, 0, g;
  return c;
}

double plane_bulk_modulus(const Eigen::Matrix3d& c) { return 0.25 * (c(0, 0) + c(1, 1) + c(0, 1) + c(1, 0)); }

/// ⟨1/(m_i + reference)⟩⁻¹ − reference: the modulus of the mixture in a comparison solid (Walpole).
double mixed(const std::array<double, 2>& moduli, const std::array<double, 2>& fractions, double reference) {
  double compliance = 0;
  for (std::size_t i = 0; i < 2; ++i) compliance += fractions[i] / (moduli[i] + reference);
  return 1 / compliance - reference;
}

}  // namespace

std::vector<Phase> elastic_phases(const std::vector<Phase>& phases) {
  std::vector<Phase> distinct;
  for (const Phase& phase : phases) {
    const auto same = std::find_if(distinct.begin(), distinct.end(), [&](const Phase& other) {
      return other.material.stiffness == phase.material.stiffness;
    });
    if (same == distinct.end())
      distinct.push_back(phase);
    else
      same->fraction += phase.fraction;
  }
  return distinct;
}

double mean_density(const std::vector<Phase>& phases) {
  double mean = 0;
  for (const Phase& phase : phases) mean += phase.fraction * phase.material.density;
  return mean;
}

Eigen::Matrix3d voigt_bound(const std::vector<Phase>& phases) {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const Phase& phase : phases) mean += phase.fraction * phase.material.stiffness;
  return mean;
}

Eigen::Matrix3d reuss_bound(const std::vector<Phase>& phases) {
  if (std::ranges::any_of(phases, &Phase::is_empty)) return Eigen::Matrix3d::Zero();
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const Phase& phase : phases) mean += phase.fraction * phase.material.stiffness.inverse();
  return mean.inverse();
}

bool is_isotropic(const Eigen::Matrix3d& c) {
  return (c - plane_isotropic(plane_bulk_modulus(c), c(2, 2))).cwiseAbs().maxCoeff() <=
         1e-9 * c.cwiseAbs().maxCoeff();
}

double effective_friction(const std::vector<double>& fractions, const std::vector<double>& coefficients,
                          double poisson) {
  const double beta = (1 - 2 * poisson) / (2 * (1 - poisson));
  double angle = 0, whole = 0;
  for (std::size_t k = 0; k < fractions.size(); ++k) {
    angle += fractions[k] * std::atan(beta * coefficients[k]);
    whole += fractions[k];
  }
  return std::tan(angle / whole) / beta;
}

std::optional<HashinShtrikman> hashin_shtrikman(const std::vector<Phase>& phases) {
  const std::vector<Phase> distinct = elastic_phases(phases);
  if (distinct.size() != 2) return std::nullopt;
  std::array<double, 2> fraction{}, k{}, g{};
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Matrix3d& c = distinct[i].material.stiffness;
    if (!is_isotropic(c)) return std::nullopt;
    fraction[i] = distinct[i].fraction;
    k[i] = plane_bulk_modulus(c);
    g[i] = c(2, 2);
  }
  const auto [k_least, k_most] = std::minmax(k[0], k[1]);
  const auto [g_least, g_most] = std::minmax(g[0], g[1]);
  const auto reference = [](double bulk, double shear) {
    return shear > 0 ? bulk * shear / (bulk + 2 * shear) : 0;  // a hole has neither
  };
  return HashinShtrikman{mixed(k, fraction, g_least), mixed(k, fraction, g_most),
                         mixed(g, fraction, reference(k_least, g_least)),
                         mixed(g, fraction, reference(k_most, g_most))};
}

double excess(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return eigenvalues(a - b)[0] / eigenvalues(a)[2];
}

double symmetry_defect(const Eigen::Matrix3d& c) {
  return (c - c.transpose()).cwiseAbs().maxCoeff() / c.cwiseAbs().maxCoeff();
}

EngineeringConstants engineering_constants(const Eigen::Matrix3d& stiffness) {
  const Eigen::Matrix3d c = symmetric_part(stiffness), s = c.inverse();
  EngineeringConstants e;
  e.young_x = 1 / s(0, 0);
  e.young_y = 1 / s(1, 1);
  e.poisson_xy = -s(0, 1) / s(0, 0);
  e.poisson_yx = -s(0, 1) / s(1, 1);
  e.shear = 1 / s(2, 2);
  e.bulk = plane_bulk_modulus(c);
  // Half of C on the basis ((xx − yy)/√2, √2 xy) of the shears, whose eigenvalues do not change as the axes
  // turn.
  const double extension = 0.25 * (c(0, 0) + c(1, 1) - 2 * c(0, 1)), coupling = 0.5 * (c(0, 2) - c(1, 2));
  const double mean = 0.5 * (extension + c(2, 2)), radius = std::hypot(0.5 * (extension - c(2, 2)), coupling);
  e.shear_least = mean - radius;
  e.shear_most = mean + radius;
  e.poisson = (e.bulk - mean) / (2 * e.bulk);
  e.young = 2 * mean * (1 + e.poisson);
  e.anisotropy = mandel(c - plane_isotropic(e.bulk, mean)).norm() / mandel(c).norm();
  return e;
}

double two_phase_identity(const std::vector<Phase>& phases, const Eigen::Matrix3d& stiffness,
                          const Eigen::Matrix3d& mean_second) {
  // Not divided by C₂ − C₁, which is singular where the phases share a modulus.
  const Eigen::Matrix3d &first = phases[0].material.stiffness, &second = phases[1].material.stiffness;
  const Eigen::Matrix3d left = phases[1].fraction * (second - first) * mean_second;
  return (left - (stiffness - first)).norm() / std::max(left.norm(), 1e-6 * stiffness.norm());
}

Richardson richardson(const Eigen::Matrix3d& coarse, const Eigen::Matrix3d& fine) {
  const Eigen::Matrix3d error = (coarse - fine) * (4.0 / 3);
  return {error, coarse - error};
}

}  // namespace slipscale
