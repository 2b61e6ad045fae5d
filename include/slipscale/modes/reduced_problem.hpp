#pragma once

#include <Eigen/Dense>
#include <vector>

#include "slipscale/modes/sliding_law.hpp"

namespace slipscale {

/// An eigenvalue and its vector in a basis.
struct ReducedMode {
  Complex exponent;         ///< p, 1/s
  Eigen::VectorXcd vector;  ///< y, of length 1
};

/// The problem in a basis Φ with ΦᵀMΦ = I: [K̂ + q I − μφ Ĝ + δ D̂] y = 0, [basis, basis].
struct ReducedProblem {
  Eigen::MatrixXd stiffness;  ///< ΦᵀKΦ, 1/s²
  Eigen::MatrixXd friction;   ///< ΦᵀGΦ, 1/s²
  Eigen::MatrixXd slip{};     ///< ΦᵀDΦ, 1/s; empty where no coefficient depends on the slip rate

  Eigen::Index size() const { return stiffness.rows(); }
  /// What the slip rate makes of y; zero where it makes nothing.
  Eigen::VectorXcd slip_of(const Eigen::VectorXcd& y) const {
    if (slip.size() == 0) return Eigen::VectorXcd::Zero(y.size());
    return slip * y;
  }
  /// VᵀNV of a part of the basis.
  ReducedProblem part(const Eigen::MatrixXd& v) const {
    ReducedProblem found{v.transpose() * stiffness * v, v.transpose() * friction * v};
    if (slip.size() > 0) found.slip = v.transpose() * slip * v;
    return found;
  }
  /// N(p).
  Eigen::MatrixXcd matrix(const SlidingLaw& law, Complex p) const;
};

/// All eigenvalues in continuous time with 0 ≤ Im p, from the companion matrix of the cubic (the quadratic
/// where T = 0); rounded no better than that matrix allows.
std::vector<Complex> all_exponents(const ReducedProblem& problem, const SlidingLaw& law);

/// The pair next to an estimate, by Newton's method on N(p) y = 0; without a vector to start from, from one
/// that inverse iteration finds, which differs with `seed` where more than one belongs to p. p is not a
/// number where that does not converge.
ReducedMode nearest_mode(const ReducedProblem& problem, const SlidingLaw& law, Complex estimate,
                         const Eigen::VectorXcd& start = {}, double seed = 0);

}  // namespace slipscale
