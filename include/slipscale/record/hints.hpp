#pragma once

#include <string>
#include <vector>

#include "slipscale/dynamics/scene.hpp"
#include "slipscale/dynamics/sliding_body.hpp"
#include "slipscale/record/record_choice.hpp"

namespace slipscale {

/// Seconds that one core takes for a step, and for a row or a frame of each output, of so many nodes; what
/// tests/bench/features.py prints, rounded. They only have to tell a tenth of a run from much less.
struct OutputCosts {
  double step, history, contact, fields, interfaces;
};
OutputCosts output_costs(double nodes, double contact_nodes);

/// What a scene pays for without using it, one sentence each, for the terminal: a material that is given
/// twice, damping that changes nothing, outputs that take more than a tenth of the run, a step far below the
/// limit, a friction memory that the contact's edges are too long for, outputs with no row between start and
/// end. Collective; the same on every rank.
std::vector<std::string> hints_at_start(const SlidingBody& body, const TimeStep& step,
                                        const RecordChoice& record);

/// "friction's memory: c_s T = 1.897 mm, 15.2 of the contact's longest edge", a line; empty without a memory.
/// Collective.
std::string describe_memory(const SlidingBody& body);

}  // namespace slipscale
