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

/// The problem in a basis Φ with ΦᵀMΦ = I: [K̂ + q I − μφ Ĝ] y = 0, [basis, basis].
struct ReducedProblem {
  Eigen::MatrixXd stiffness;  ///< ΦᵀKΦ, 1/s²
  Eigen::MatrixXd friction;   ///< ΦᵀGΦ, 1/s²

  Eigen::Index size() const { return stiffness.rows(); }
  /// N(p).
  Eigen::MatrixXcd matrix(const SlidingLaw& law, Complex p) const;
};

/// All eigenvalues in continuous time with 0 ≤ Im p, from the companion matrix of the cubic (the quadratic
/// where T = 0); rounded no better than that matrix allows.
std::vector<Complex> all_exponents(const ReducedProblem& problem, const SlidingLaw& law);

/// The pair next to an estimate, by Newton's method on N(p) y = 0; without a vector to start from, from one
/// that inverse iteration finds. p is not a number where that does not converge.
ReducedMode nearest_mode(const ReducedProblem& problem, const SlidingLaw& law, Complex estimate,
                         const Eigen::VectorXcd& start = {});

}  // namespace slipscale
