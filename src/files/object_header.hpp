#pragma once

#include "slipscale/files/hdf5.hpp"

namespace slipscale {

/// Whether the chunks of a dataset are as large as its header says, where it has chunks and a header of
/// HDF5's default form. HDF5 1.10 believes the header, and in a damaged file reads and writes behind its
/// buffers. (HDF5 File Format Specification 2.0, IV.A.1.a and, version 3 of it, IV.A.2.i.)
bool chunks_are_sound(hid_t dataset);

}  // namespace slipscale
