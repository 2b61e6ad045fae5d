#pragma once

#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/dynamics/scene.hpp"

namespace slipscale {

/// What the user may not have meant by the friction of a scene, one sentence each, for the terminal:
/// constants for all that act nowhere, as every region which touches the surface has its own; a coefficient
/// that rises with the slip rate (at t = 0). Nothing without a surface. Collective; the same on every rank.
std::vector<std::string> notes_on_friction(const Options& options, const Mesh& mesh, const Scene& scene);

}  // namespace slipscale
