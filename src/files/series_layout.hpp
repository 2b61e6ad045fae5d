#pragma once

#include "slipscale/files/series_file.hpp"

namespace slipscale {

inline hid_t memory_type(SeriesFile::Storage storage) {
  return storage == SeriesFile::Storage::byte ? H5T_NATIVE_UINT8 : H5T_NATIVE_DOUBLE;
}

inline hid_t file_type(SeriesFile::Storage storage) {
  return storage == SeriesFile::Storage::byte ? H5T_STD_U8LE : H5T_IEEE_F64LE;
}

/// The shape of so many rows.
inline std::vector<hsize_t> rows_of(hsize_t rows, const std::vector<hsize_t>& row_shape) {
  std::vector<hsize_t> shape{rows};
  shape.insert(shape.end(), row_shape.begin(), row_shape.end());
  return shape;
}

}  // namespace slipscale
