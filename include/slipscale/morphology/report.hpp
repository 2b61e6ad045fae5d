#pragma once

#include <map>
#include <string>

#include "slipscale/morphology/compose.hpp"

namespace slipscale {

/// What was achieved, for the screen.
std::string describe(const Recipe& recipe, const Composed& composed);

/// morphology.yaml: the recipe by its options, so that `-options_file_yaml morphology.yaml` draws it again,
/// and under `run`, which is no option, what was achieved and the versions.
std::string morphology_yaml(const std::map<std::string, std::string>& effective, const Recipe& recipe,
                            const Composed& composed);

}  // namespace slipscale
