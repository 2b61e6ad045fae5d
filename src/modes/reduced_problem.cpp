#include "slipscale/modes/reduced_problem.hpp"

#include <cmath>
#include <limits>

namespace slipscale {
namespace {

constexpr int most_steps = 30;
constexpr double converged = 1e-14;  ///< change of p, relative

/// Coefficients of p⁰ … p^degree, in units of a frequency `unit` [1/s] so that their sizes are alike.
std::vector<Eigen::MatrixXd> coefficients(const ReducedProblem& problem, const SlidingLaw& law, double unit) {
  const Eigen::Index n = problem.size();
  const double a = law.damping.mass / unit, b = law.damping.stiffness * unit, t = law.time * unit;
  const Eigen::MatrixXd k = problem.stiffness / (unit * unit),
                        g = law.coefficient / (unit * unit) * problem.friction,
                        one = Eigen::MatrixXd::Identity(n, n), damping = a * one + b * k;
  std::vector<Eigen::MatrixXd> list{k - g, damping + t * k - b * g, one + t * damping};
  if (t > 0) list.push_back(t * one);
  return list;
}

}  // namespace

Eigen::MatrixXcd ReducedProblem::matrix(const SlidingLaw& law, Complex p) const {
  const SlidingLaw::Value value = law.at(p);
  Eigen::MatrixXcd n = stiffness.cast<Complex>() - value.friction * friction;
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
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion, false);
  for (const Complex& p : solver.eigenvalues())
    if (p.imag() >= 0) found.push_back(unit * p);
  return found;
}

ReducedMode nearest_mode(const ReducedProblem& problem, const SlidingLaw& law, Complex estimate,
                         const Eigen::VectorXcd& start) {
  ReducedMode mode{estimate, start};
  if (start.size() == 0) {
    mode.vector.resize(problem.size());  // any, but the same every time
    for (Eigen::Index k = 0; k < problem.size(); ++k)
      mode.vector[k] = {std::sin(12.9898 * static_cast<double>(k) + 1),
                        std::sin(78.233 * static_cast<double>(k) + 2)};
    // Apart from p by so little that N stays regular, and the nearest vector prevails.
    const Complex beside = estimate * (1.0 + 1e-9);
    const Eigen::PartialPivLU<Eigen::MatrixXcd> inverse(problem.matrix(law, beside));
    for (int again = 0; again < 2; ++again) mode.vector = inverse.solve(mode.vector).eval().normalized();
  }
  double previous = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    const SlidingLaw::Value slope = law.slope_at(mode.exponent);
    const Eigen::VectorXcd right =
        slope.inertia * mode.vector - slope.friction * (problem.friction * mode.vector);
    const Eigen::VectorXcd next =
        Eigen::PartialPivLU<Eigen::MatrixXcd>(problem.matrix(law, mode.exponent)).solve(right);
    const Complex moved = mode.vector.dot(next);
    if (!std::isfinite(std::norm(moved)) || !next.allFinite()) {  // p is exact: N has no inverse
      mode.exponent *= 1.0 + 1e-12;
      continue;
    }
    const Complex change = 1.0 / moved;
    mode.vector = next.normalized();
    mode.exponent -= change;
    const double size = std::abs(change) / std::abs(mode.exponent);
    if (size <= converged || (size <= 1e-11 && size >= previous)) return mode;
    previous = size;
  }
  if (previous > 1e-9) mode.exponent = std::numeric_limits<double>::quiet_NaN();
  return mode;
}

}  // namespace slipscale
