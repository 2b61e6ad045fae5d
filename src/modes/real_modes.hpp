#pragma once

#include "slipscale/modes/sliding_operator.hpp"

namespace slipscale {

/// Modes of K φ = ω² M φ, the body without friction whose closed nodes slide freely.
struct RealModes {
  Eigen::VectorXd eigenvalue;  ///< ω², ascending, 1/s²
  Columns shape;               ///< φ with φᵀMφ = 1
};

/// Those below `highest` [1/s], or the first `count` where that is not 0; at least one more than wanted where
/// there is one. By SLEPc, Krylov-Schur on M^½ K⁻¹ M^½. Throws UserError where the body has fewer unknowns.
/// Collective.
RealModes real_modes(const SlidingOperator& body, double highest, int count);

}  // namespace slipscale
