#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "slipscale/base/state_group.hpp"
#include "slipscale/files/shared_file.hpp"

namespace slipscale {

/// Writes every array of every group as /group/array, rows in the order of their keys, which stand beside
/// them as /group/keys where they are not simply 0, 1, …: the same file on any number of ranks. Collective.
void write_state(MPI_Comm comm, SharedFile& file, const std::vector<StateGroup>& groups);

/// What `write_state` will write, bytes; the same on all ranks. Collective.
double state_bytes(MPI_Comm comm, const std::vector<StateGroup>& groups);

/// Fills in the arrays from a file that `write_state` wrote on any number of ranks. Throws `UserError` for
/// a file that lacks an array or a row: it is that of another scene. `file` open on rank 0. Collective.
void read_state(MPI_Comm comm, hid_t file, const std::string& path, std::vector<StateGroup>& groups);

/// The end of a file that carries the checksum of all bytes before it; HDF5 does not mind it. On the calling
/// rank; throw LibraryError.
void seal(const std::string& path);
bool is_sealed(const std::string& path);  ///< whether it is there and right

}  // namespace slipscale
