#include "slipscale/modes/reduced_problem.hpp"

#include <petscblaslapack.h>

#include <cmath>
#include <limits>

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

constexpr int most_steps = 30;
constexpr double converged = 1e-14;   ///< change of p, relative
constexpr double as_good = 1e-11;     ///< the same, where rounding allows no less
constexpr int most_corrections = 12;  ///< with one factorisation
constexpr double helps = 0.1;         ///< what a correction must leave of the one before

/// All eigenvalues of a matrix, by LAPACK, which is several times faster than Eigen. The matrix is used up.
std::vector<Complex> eigenvalues(Eigen::MatrixXd& matrix) {
  const auto n = static_cast<PetscBLASInt>(matrix.rows());
  std::vector<double> real(static_cast<std::size_t>(n)), imaginary(real), work(1);
  PetscBLASInt room = -1, one = 1, info = 0;
  for (int pass = 0; pass < 2; ++pass) {  // the first one asks for room
    LAPACKgeev_("N", "N", &n, matrix.data(), &n, real.data(), imaginary.data(), nullptr, &one, nullptr, &one,
                work.data(), &room, &info);
    room = static_cast<PetscBLASInt>(work[0]);
    work.resize(static_cast<std::size_t>(room));
  }
  if (info != 0) throw RunError("LAPACK does not find the eigenvalues of the modes' companion matrix");
  std::vector<Complex> found;
  for (std::size_t k = 0; k < real.size(); ++k) found.emplace_back(real[k], imaginary[k]);
  return found;
}

/// Goes on from a step of Newton's method with its factorisation N(σ), by residual inverse iteration (A.
/// Neumaier, SIAM J. Numer. Anal. 22 (1985) 914), whose steps cost no more than products: x −= N(σ)⁻¹ N(p) x,
/// with p such that eᴴN(σ)⁻¹N(p) x = 0. True when it has converged; else `mode` is what it came to.
bool correct(const ReducedProblem& problem, const SlidingLaw& law,
             const Eigen::PartialPivLU<Eigen::MatrixXcd>& factor, ReducedMode& mode) {
  const Eigen::VectorXcd left = factor.adjoint().solve(mode.vector);
  double previous = std::numeric_limits<double>::infinity();
  ReducedMode now = mode;
  for (int step = 0; step < most_corrections; ++step) {
    const Eigen::VectorXcd kx = problem.stiffness * now.vector, gx = problem.friction * now.vector,
                           dx = problem.slip_of(now.vector);
    const Complex stiff = left.dot(kx), inertia = left.dot(now.vector), friction = left.dot(gx),
                  slip = left.dot(dx);
    Complex change = 0;
    for (int newton = 0; newton < 3; ++newton) {
      const SlidingLaw::Value value = law.at(now.exponent), slope = law.slope_at(now.exponent);
      const Complex part = (stiff + value.inertia * inertia - value.friction * friction + value.slip * slip) /
                           (slope.inertia * inertia - slope.friction * friction + slope.slip * slip);
      now.exponent -= part;
      change += part;
    }
    const SlidingLaw::Value value = law.at(now.exponent);
    const Eigen::VectorXcd correction =
        factor.solve(kx + value.inertia * now.vector - value.friction * gx + value.slip * dx);
    now.vector = (now.vector - correction).eval().normalized();
    const double size = std::max(correction.norm(), std::abs(change) / std::abs(now.exponent));
    if (!(size < helps * previous)) return previous <= as_good;
    mode = now;
    if (size <= converged) return true;
    previous = size;
  }
  return false;
}

/// Coefficients of p⁰ … p^degree, in units of a frequency `unit` [1/s] so that their sizes are alike.
std::vector<Eigen::MatrixXd> coefficients(const ReducedProblem& problem, const SlidingLaw& law, double unit) {
  const Eigen::Index n = problem.size();
  const double a = law.damping.mass / unit, b = law.damping.stiffness * unit, t = law.time * unit;
  const Eigen::MatrixXd k = problem.stiffness / (unit * unit),
                        g = law.coefficient / (unit * unit) * problem.friction,
                        one = Eigen::MatrixXd::Identity(n, n), damping = a * one + b * k;
  std::vector<Eigen::MatrixXd> list{k - g, damping + t * k - b * g, one + t * damping};
  if (problem.slip.size() > 0) list[1] += problem.slip / unit;
  if (t > 0) list.push_back(t * one);
  return list;
}

}  // namespace

Eigen::MatrixXcd ReducedProblem::matrix(const SlidingLaw& law, Complex p) const {
  const SlidingLaw::Value value = law.at(p);
  Eigen::MatrixXcd n = stiffness.cast<Complex>() - value.friction * friction;
  if (slip.size() > 0) n += value.slip * slip;
  n.diagonal().array() += value.inertia;
  return n;
}

std::vector<Complex> all_exponents(const ReducedProblem& problem, const SlidingLaw& law) {
  const Eigen::Index n = problem.size();
  const double unit = std::sqrt(problem.stiffness.diagonal().maxCoeff());
  const auto list = coefficients(problem, law, unit);
  const auto degree = static_cast<Eigen::Index>(list.size()) - 1;
  // The last coefficient is a multiple of I, but for T = 0 with b = 0, where it is I itself.
  const double last = list.back()(0, 0);
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(degree * n, degree * n);
  companion.topRightCorner((degree - 1) * n, (degree - 1) * n).setIdentity();
  for (Eigen::Index k = 0; k < degree; ++k)
    companion.block((degree - 1) * n, k * n, n, n) = -list[static_cast<std::size_t>(k)] / last;
  std::vector<Complex> found;
  for (const Complex& p : eigenvalues(companion))
    if (p.imag() >= 0) found.push_back(unit * p);
  return found;
}

ReducedMode nearest_mode(const ReducedProblem& problem, const SlidingLaw& law, Complex estimate,
                         const Eigen::VectorXcd& start, double seed) {
  ReducedMode mode{estimate, start};
  if (start.size() == 0) {
    mode.vector.resize(problem.size());  // any, but the same every time
    for (Eigen::Index k = 0; k < problem.size(); ++k) {
      const double n = static_cast<double>(k) + seed;
      mode.vector[k] = {std::sin(12.9898 * n + 1), std::sin(78.233 * n + 2)};
    }
    // Apart from p by so little that N stays regular, and the nearest vector prevails.
    const Complex beside = estimate * (1.0 + 1e-9);
    const Eigen::PartialPivLU<Eigen::MatrixXcd> inverse(problem.matrix(law, beside));
    for (int again = 0; again < 2; ++again) mode.vector = inverse.solve(mode.vector).eval().normalized();
  }
  double previous = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    const SlidingLaw::Value slope = law.slope_at(mode.exponent);
    const Eigen::VectorXcd right = slope.inertia * mode.vector -
                                   slope.friction * (problem.friction * mode.vector) +
                                   slope.slip * problem.slip_of(mode.vector);
    const Eigen::PartialPivLU<Eigen::MatrixXcd> factor(problem.matrix(law, mode.exponent));
    const Eigen::VectorXcd next = factor.solve(right);
    const Complex moved = mode.vector.dot(next);
    if (!std::isfinite(std::norm(moved)) || !next.allFinite()) {  // p is exact: N has no inverse
      mode.exponent *= 1.0 + 1e-12;
      continue;
    }
    const Complex change = 1.0 / moved;
    mode.vector = next.normalized();
    mode.exponent -= change;
    const double size = std::abs(change) / std::abs(mode.exponent);
    if (size <= converged || (size <= as_good && size >= previous)) return mode;
    constexpr double near = 1e-3;
    if (size <= near && correct(problem, law, factor, mode)) return mode;
    previous = size;
  }
  if (previous > 1e-9) mode.exponent = std::numeric_limits<double>::quiet_NaN();
  return mode;
}

}  // namespace slipscale
