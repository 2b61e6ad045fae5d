#pragma once

#include <string>

#include "slipscale/contact/law.hpp"

namespace slipscale {

/// The constants of a phase, or of all of them, as a scene is told: "mu 0.5, T 600 ns".
std::string constants_text(const FrictionChoice& choice, const FrictionConstants& constants);

}  // namespace slipscale
