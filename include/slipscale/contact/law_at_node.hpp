#pragma once

#include "slipscale/contact/law.hpp"

namespace slipscale {

/// A node's own constants, with the coefficients at a time; as of a choice that does not vary.
FrictionChoice friction_at(const FrictionChoice& choice, const ContactPlace& node, double time);

}  // namespace slipscale
