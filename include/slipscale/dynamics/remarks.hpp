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
/// What forces are left on the nodes of a body whose initial displacement a file or a formula gives, once the
/// first step is made; a sentence, or nothing where it is in equilibrium. Collective.
std::vector<std::string> remarks_on_first_step(const SlidingBody& body);

std::vector<std::string> remarks_at_end(const SlidingBody& body);

}  // namespace slipscale
