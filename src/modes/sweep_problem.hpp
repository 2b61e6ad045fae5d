#pragma once

#include "slipscale/modes/modes_basis.hpp"

namespace slipscale {

/// Orthonormal columns that span the given ones, but for what is little beside the largest.
Eigen::MatrixXd orthonormal_part(const Eigen::MatrixXd& vectors);

/// The problem in a part of a basis, U = Φ S, and what it takes to tell the residual on the whole body of any
/// vector of it, for any law, without touching the whole body again.
class SweepProblem {
 public:
  /// `vectors`: complex vectors in the basis that are to be held by the part. Collective.
  SweepProblem(const ModesBasis& basis, const std::vector<Eigen::VectorXcd>& vectors);

  const ReducedProblem& problem() const { return problem_; }
  /// A vector of the basis in the part.
  Eigen::VectorXcd part_of(const Eigen::VectorXcd& vector) const { return part_.transpose() * vector; }
  Eigen::VectorXcd in_basis(const Eigen::VectorXcd& vector) const { return part_ * vector; }
  /// As `ModesBasis::residual`; what is below 1e-8 is rounding.
  double residual(const SlidingLaw& law, const ReducedMode& mode) const;

 private:
  Eigen::MatrixXd part_;  ///< S, [basis, part], orthonormal
  ReducedProblem problem_;
  Eigen::MatrixXd stiff_, beside_, slides_;  ///< (KU)ᵀM⁻¹KU, (GU)ᵀM⁻¹KU, (GU)ᵀM⁻¹GU
};

}  // namespace slipscale
