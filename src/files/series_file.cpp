#include "slipscale/files/series_file.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "disk_space.hpp"
#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

constexpr double dataset_overhead =
    16384 + 2000;  // bytes: the last, partly filled chunk; headers and attributes

constexpr std::size_t chunk_bytes = 16384;  ///< small, because every chunk is written whole, rows or no rows
constexpr std::size_t batch_bytes = 8 << 20;  ///< a batch this large does not wait for the clock
constexpr std::size_t index_bytes = 4096;     ///< what HDF5's index of the chunks may grow by
constexpr double writing_share = 0.02;  ///< batches are spaced so that writing takes no more of the time

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A killed run must leave a readable file, and a running one must let readers in: the oldest file format
/// (files written with the latest were unreadable after a kill) and no file locking.
Hdf5File create_file(const std::string& path) {
  Hdf5Properties access(hdf5(H5Pcreate(H5P_FILE_ACCESS), "cannot prepare the file"));
  hdf5(H5Pset_file_locking(access, 0, 1), "cannot turn file locking off");
  return Hdf5File(
      hdf5(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "cannot create the file"));
}

hid_t file_type(SeriesFile::Storage storage) {
  return storage == SeriesFile::Storage::byte ? H5T_STD_U8LE : H5T_IEEE_F64LE;
}

hid_t memory_type(SeriesFile::Storage storage) {
  return storage == SeriesFile::Storage::byte ? H5T_NATIVE_UINT8 : H5T_NATIVE_DOUBLE;
}

std::vector<hsize_t> rows_of(hsize_t rows, const std::vector<hsize_t>& row_shape) {
  std::vector<hsize_t> shape{rows};
  shape.insert(shape.end(), row_shape.begin(), row_shape.end());
  return shape;
}

}  // namespace

/// Runs `action` unless something failed before; its failure becomes the fault.
template <class Action>
void SeriesFile::guarded(const char* what, Action action) {
  if (!fault_.empty()) return;
  try {
    action();
  } catch (const std::exception& error) {
    fault_ = path_ + " " + what + ": " + error.what();
  }
}

SeriesFile::SeriesFile(std::string path, double seconds)
    : path_(std::move(path)), seconds_(seconds), pause_(seconds) {
  keep_hdf5_messages();
  guarded("cannot be opened for writing", [&] { file_ = create_file(path_); });
}

SeriesFile::~SeriesFile() { close(); }

int SeriesFile::add(const std::string& path, const std::vector<hsize_t>& row_shape, const std::string& units,
                    const std::string& description, Storage storage) {
  const hsize_t entries =
      std::accumulate(row_shape.begin(), row_shape.end(), hsize_t{1}, std::multiplies<>());
  Column column{path, row_shape, storage, entries * (storage == Storage::byte ? 1 : sizeof(double)), {}, {}};
  guarded("cannot be written", [&] {
    if (rows_ > 0) throw LibraryError("'" + path + "' was declared after the first row");
    const hsize_t rows_per_chunk = std::max<hsize_t>(1, chunk_bytes / std::max<std::size_t>(column.bytes, 1));
    column.dataset = create_dataset(file_, path, file_type(storage), rows_of(0, row_shape),
                                    rows_of(H5S_UNLIMITED, row_shape), rows_of(rows_per_chunk, row_shape));
    describe_dataset(column.dataset, units, description);
  });
  row_bytes_ += column.bytes;
  columns_.push_back(std::move(column));
  return static_cast<int>(columns_.size()) - 1;
}

void SeriesFile::constant(const std::string& path, const double* values, const std::vector<hsize_t>& shape,
                          const std::string& units, const std::string& description) {
  guarded("cannot be written", [&] {
    const Hdf5Dataset dataset = create_dataset(file_, path, H5T_IEEE_F64LE, shape);
    hdf5(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "'" + path + "'");
    describe_dataset(dataset, units, description);
    hdf5(H5Fflush(file_, H5F_SCOPE_LOCAL), "'" + path + "'");
  });
}

void SeriesFile::append(int id, const double* row) { append_bytes(id, row, Storage::real); }

void SeriesFile::append(int id, const std::uint8_t* row) { append_bytes(id, row, Storage::byte); }

void SeriesFile::append_bytes(int id, const void* row, Storage storage) {
  if (!fault_.empty()) return;
  Column& column = columns_[static_cast<std::size_t>(id)];
  if (column.storage != storage)
    fault_ = path_ + ": a row of '" + column.path + "' has the wrong number type";
  const auto* bytes = static_cast<const std::byte*>(row);
  column.batch.insert(column.batch.end(), bytes, bytes + column.bytes);
}

void SeriesFile::end_row() {
  if (!fault_.empty()) return;
  ++rows_;
  const hsize_t waiting = rows_ - written_;
  for (const Column& column : columns_)
    if (column.batch.size() != waiting * column.bytes)
      fault_ =
          path_ + ": '" + column.path + "' was not given exactly once in row " + std::to_string(rows_ - 1);
  // The first row at once: until then HDF5's file is not one.
  if (written_ == 0 || waiting * row_bytes_ >= batch_bytes || seconds_since(last_) >= pause_) flush();
}

void SeriesFile::flush() {
  const auto start = Clock::now();
  guarded("cannot be written (disk full?)", [&] {
    if (!file_.open() || rows_ == written_) return;
    reserve();
    for (Column& column : columns_) write_batch(column);
    hdf5(H5Fflush(file_, H5F_SCOPE_LOCAL), "flushing");
    written_ = rows_;
  });
  pause_ = std::max(seconds_, seconds_since(start) / writing_share);
  last_ = Clock::now();
}

void SeriesFile::reserve() {
  hsize_t size = 0, bytes = 0;
  hdf5(H5Fget_filesize(file_, &size), "size");
  for (const Column& column : columns_)
    bytes += column.batch.size() + chunk_bytes + column.bytes + index_bytes;
  reserve_space(path_, size, bytes);
}

void SeriesFile::write_batch(Column& column) {
  const std::string& what = column.path;
  const auto shape = rows_of(rows_, column.row_shape);
  hdf5(H5Dset_extent(column.dataset, shape.data()), what);
  const auto count = rows_of(rows_ - written_, column.row_shape);
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = written_;
  const Hdf5Space target(hdf5(H5Dget_space(column.dataset), what));
  hdf5(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), what);
  const Hdf5Space source(hdf5(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), what));
  hdf5(
      H5Dwrite(column.dataset, memory_type(column.storage), source, target, H5P_DEFAULT, column.batch.data()),
      what);
  column.batch.clear();
}

void SeriesFile::close() {
  if (!file_.open()) return;
  flush();
  for (Column& column : columns_)
    if (column.dataset.close() < 0 && fault_.empty())
      fault_ = path_ + " cannot be written (disk full?): " + hdf5_message();
  if (file_.close() < 0 && fault_.empty())
    fault_ = path_ + " cannot be closed (disk full?): " + hdf5_message();
}

double series_bytes(double rows, double row_bytes, int datasets) {
  return rows * row_bytes + datasets * dataset_overhead;
}

}  // namespace slipscale
