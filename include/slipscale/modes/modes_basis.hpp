#pragma once

#include "slipscale/modes/reduced_problem.hpp"
#include "slipscale/modes/sliding_operator.hpp"

namespace slipscale {

/// A mode of the whole body.
struct SlidingMode {
  Complex exponent;         ///< p, 1/s
  Eigen::VectorXcd vector;  ///< in the basis, of length 1
  double residual = 0;      ///< of N(p) u on the whole body, see `ModesBasis::residual`
};

/// Vectors on the free components that are orthonormal in M, and the problem projected on them. Starts as
/// real modes and grows.
class ModesBasis {
 public:
  explicit ModesBasis(const SlidingOperator& body) : body_(body) {}

  /// Adds what the columns bring that is new: made orthonormal in M against the basis and one another; what
  /// is left of a column below `least` of its length is dropped. Returns how many were added. Collective.
  Eigen::Index add(Columns columns, double least);

  Eigen::Index size() const { return shape_.cols(); }
  const ReducedProblem& problem() const { return problem_; }
  const Columns& shapes() const { return shape_; }  ///< Φ, [free, basis]
  const SlidingOperator& body() const { return body_; }

  /// Φ y, real and imaginary parts, [free, 2]; of several y side by side, [free, 2 vectors].
  Columns shape_of(const Eigen::MatrixXcd& vectors) const;
  /// λ of the closed nodes in a mode, [closed], N/m.
  Eigen::VectorXcd reaction_of(const Eigen::VectorXcd& vector) const;

  /// N(p) u of a mode, real and imaginary parts, [free, 2], over the size of what cancels in it, and its own
  /// size in those units: in the norm of M⁻¹, ‖N u‖/(‖K u‖ + |q| ‖M u‖). Collective.
  struct Residual {
    Columns force;
    double size = 0;
  };
  Residual residual(const SlidingLaw& law, const SlidingMode& mode) const;
  /// The same, of a mode whose shape is known.
  Residual residual(const SlidingLaw& law, const SlidingMode& mode, const Columns& shape) const;

 private:
  const SlidingOperator& body_;
  Columns shape_;             ///< [free, basis]
  Eigen::MatrixXd reaction_;  ///< [closed, basis]
  ReducedProblem problem_;
};

}  // namespace slipscale
