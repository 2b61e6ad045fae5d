#include <algorithm>

#include "series_layout.hpp"
#include "slipscale/files/continued_file.hpp"

namespace slipscale {

void SeriesFile::open_column(Column& column, const std::string& units) {
  column.dataset =
      expect_series(file_, column.path, file_type(column.storage), column.row_shape, continued_->rows, units);
  const Hdf5Properties creation(hdf5(H5Dget_create_plist(column.dataset), column.path));
  hsize_t rows_per_chunk = 0;
  hdf5(H5Pget_chunk(creation, 1, &rows_per_chunk), column.path);
  column.chunk = rows_per_chunk * column.bytes;
}

/// A few MiB at a time, each chunk once.
void SeriesFile::read_content(Column& column) const {
  constexpr hsize_t piece_bytes = 4 << 20;
  const std::string& what = column.path;
  const hsize_t chunk = std::max<hsize_t>(1, column.chunk / column.bytes),
                most = std::max<hsize_t>(1, piece_bytes / column.chunk) * chunk;
  std::vector<std::byte> piece;
  const Hdf5Space source(hdf5(H5Dget_space(column.dataset), what));
  for (hsize_t begin = 0; begin < written_; begin += most) {
    const auto count = rows_of(std::min(most, written_ - begin), column.row_shape);
    std::vector<hsize_t> start(count.size(), 0);
    start[0] = begin;
    piece.resize(count[0] * column.bytes);
    hdf5(H5Sselect_hyperslab(source, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), what);
    const Hdf5Space target(
        hdf5(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), what));
    hdf5(H5Dread(column.dataset, memory_type(column.storage), target, source, H5P_DEFAULT, piece.data()),
         what);
    column.content.add(piece.data(), piece.size());
  }
}

/// Of a continued file, the rows behind those that count.
void SeriesFile::cut_back() {
  if (!to_cut_) return;
  for (const Column& column : columns_)
    hdf5(H5Dset_extent(column.dataset, rows_of(written_, column.row_shape).data()), column.path);
  flush_file();  // what comes next may use the room of what was cut off
  let_data_through(file_);
  to_cut_ = false;
}

/// The rows of a column that are on the disk.
std::vector<double> SeriesFile::read_written(const Column& column) const {
  std::vector<double> values(written_ * column.bytes / sizeof(double));
  if (written_ == 0) return values;
  const std::string& what = column.path;
  const auto count = rows_of(written_, column.row_shape);
  const std::vector<hsize_t> start(count.size(), 0);
  const Hdf5Space source(hdf5(H5Dget_space(column.dataset), what));
  hdf5(H5Sselect_hyperslab(source, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), what);
  const Hdf5Space target(hdf5(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), what));
  hdf5(H5Dread(column.dataset, H5T_NATIVE_DOUBLE, target, source, H5P_DEFAULT, values.data()), what);
  return values;
}

}  // namespace slipscale
