#pragma once

#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/mesh/mesh.hpp"

namespace slipscale {

/// Tells the options what formulas know beside their variables: H and L, height and length of the block, m,
/// and pi. Before the scene is read.
void know_formula_names(Options& options, const Mesh& mesh);

/// What the option says, a number or a formula. Throws UserError where the formula makes, at one of the nodes
/// at t = 0, what is no number or not in the option's range. Collective.
Quantity quantity_at(const Options& options, const std::string& name, const Mesh& mesh,
                     const std::vector<int>& nodes);
void check_at(const Options& options, const std::string& name, const Quantity& quantity, const Mesh& mesh,
              const std::vector<int>& nodes);

/// The number in engineering notation with its unit, or the formula.
std::string describe(const Quantity& quantity, const std::string& unit);

}  // namespace slipscale
