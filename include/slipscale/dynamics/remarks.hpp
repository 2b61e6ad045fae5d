#pragma once

#include <string>
#include <vector>

#include "slipscale/dynamics/sliding_body.hpp"

namespace slipscale {

/// What of a scene lies outside the model, or is unlikely to be meant; one sentence each, for terminal and
/// summary: a friction memory shorter than the step, outer edges at the surface that are not in the contact.
/// Collective; the same on every rank.
std::vector<std::string> remarks_at_start(const SlidingBody& body);

/// The same of a run, after an observed step: a body that never touched the surface, nodes of the outline
/// that have sunk through it. Collective.
std::vector<std::string> remarks_at_end(const SlidingBody& body);

}  // namespace slipscale
