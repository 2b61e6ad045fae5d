#pragma once

#include <span>
#include <string>
#include <vector>

#include "slipscale/solid/material.hpp"

namespace slipscale {

/// C from c11, c22, c12, c66, c16, c26, Pa.
Eigen::Matrix3d voigt_stiffness(std::span<const double> six);

/// A constant, and the option that it comes from.
struct GradedConstant {
  std::string option;
  Quantity value;
};

/// The material of a region whose constants vary: young, poisson and density, or the six of a stiffness and
/// density. Throws UserError for a value out of range, and a stiffness that is not positive definite, with
/// the cell and its place. Collective.
Material graded_material(const Options& options, const Mesh& mesh, int region,
                         const std::vector<GradedConstant>& constants);

}  // namespace slipscale
