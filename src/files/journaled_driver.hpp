#pragma once

#include <hdf5.h>

#include "journaled_file.hpp"

namespace slipscale {

/// HDF5's files as `JournaledFile`s, a virtual file driver: each flush of HDF5's takes the file from one
/// whole state to the next, and a write that fails is not seen by HDF5 but by who asks
/// `JournaledFile::failure`.
///
/// Data that datasets hold go straight to the disk: they are appended, and rewritten only with the same rows
/// before new ones. Of a file that is opened again they wait for a flush too, until `let_data_through`, as
/// what is removed there may be overwritten while the committed state still shows it.

/// A file access list for it, without file locking.
void use_journaled_driver(hid_t access);

/// Of a file that the driver opened; null where HDF5 has lost it.
JournaledFile* journaled_file(hid_t file);

void let_data_through(hid_t file);

}  // namespace slipscale
