#pragma once

#include <cstdint>
#include <string>

namespace slipscale {

/// Makes the system set aside room for bytes [from, from + bytes) of a file, or throws `LibraryError` with
/// its words ("No space left on device"), before anything is changed.
///
/// HDF5 needs this: it goes on after a write that failed, and leaves a file nobody can open and a library
/// that crashes at the end of the program. The file's size does not change. Does nothing on file systems that
/// cannot reserve.
void reserve_space(const std::string& path, std::uint64_t from, std::uint64_t bytes);

}  // namespace slipscale
