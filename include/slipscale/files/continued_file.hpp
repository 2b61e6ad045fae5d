#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slipscale/base/content_checksum.hpp"
#include "slipscale/files/hdf5.hpp"

namespace slipscale {

/// What must hold of an HDF5 file before rows are added to it by another process than the one that began it.
/// Nothing here writes. All throw `LibraryError` with the fault, for `continuation_fault`.

/// The sentence for the user: file, fault, cure.
std::string continuation_fault(const std::string& path, const std::string& fault);

/// Opens the file for writing, if it is one of this program's.
Hdf5File open_to_continue(const std::string& path);

/// An attribute with this text.
void expect_text(hid_t object, const std::string& name, const std::string& text);

/// The first entry of a shape that is not known, in `expect_dataset`.
constexpr hsize_t any_rows = H5S_UNLIMITED;

/// A dataset of this type, shape and unit.
Hdf5Dataset expect_dataset(hid_t file, const std::string& path, hid_t type, const std::vector<hsize_t>& shape,
                           const std::string& units);

/// The same of real numbers, with these values.
void expect_values(hid_t file, const std::string& path, const std::vector<hsize_t>& shape,
                   const std::string& units, const double* values);

/// A checksum of all datasets in a group, their paths, shapes and values, and of what views show; as
/// `SharedFile::take_contents`.
std::uint64_t contents_of(hid_t file, const std::string& group);

/// The same of a view: its shape, and which columns of which datasets it shows.
std::uint64_t contents_of_view(hid_t view, const std::string& path);

/// Begins the checksum of a dataset, for its values to be added.
ContentChecksum content_begun(const std::string& path, const std::vector<hsize_t>& shape);

/// A dataset of at least `rows` rows that may grow. `row_shape`: of one row ({} a number).
Hdf5Dataset expect_series(hid_t file, const std::string& path, hid_t type,
                          const std::vector<hsize_t>& row_shape, hsize_t rows, const std::string& units);

}  // namespace slipscale
