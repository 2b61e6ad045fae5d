#pragma once

#include <algorithm>

#include "slipscale/morphology/placement.hpp"

namespace slipscale::morphology {

/// Distance an inclusion keeps from a side that it must not cut, m.
inline double wall_distance(const Room& room) { return std::max(room.gap, room.clearance); }

/// Whether the bottom is a wall for the sake of the keep-out layer.
inline bool keeps_out(const Room& room) { return room.keep_out > 0 && !room.periodic[1]; }

/// side_fault, where inclusions that lie outside the block altogether are no fault.
Fault side_fault_or_outside(const Inclusion& inclusion, const Room& room);

/// The block as a rectangle without corner radius.
Inclusion as_inclusion(const Box& box);

/// Area of the inclusion and its images that lies in the block, m².
double area_in_block(const Inclusion& inclusion, const Room& room);

}  // namespace slipscale::morphology
