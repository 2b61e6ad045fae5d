#pragma once

#include <string>
#include <vector>

#include "slipscale/morphology/recipe.hpp"

namespace slipscale::morphology {

/// The option that sets `key` of a family: "-fraction", or "-families_large_fraction" when there are several.
std::string option_of(const std::vector<Family>& families, std::size_t k, const std::string& key);

/// Throws UserError for inclusions that do not fit the block, and for fractions that no placement can reach.
void refuse_impossible(const std::vector<Family>& families, const Room& room);

}  // namespace slipscale::morphology
