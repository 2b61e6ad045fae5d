#pragma once

#include <string>

namespace slipscale {

/// Whether the objects in each global heap of an HDF5 file, where a view keeps the names of what it shows,
/// fill it one after the other. HDF5 1.10 believes their sizes, and goes round in a heap for ever where one
/// is zero. (HDF5 File Format Specification 2.0, III.E.) False, too, for a file that cannot be read.
bool global_heaps_are_sound(const std::string& path);

}  // namespace slipscale
