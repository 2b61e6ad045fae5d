#include "slipscale/files/series_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <numeric>

#include "series_layout.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/files/continued_file.hpp"
#include "slipscale/files/disk_space.hpp"

namespace slipscale {
namespace {

constexpr std::size_t chunk_bytes = 16384;  ///< small, because every chunk is written whole, rows or no rows
constexpr std::size_t header_bytes = 2800;  ///< of a growing dataset: header, attributes, index, its group
constexpr std::size_t constant_bytes = 1800;  ///< of one that does not grow
constexpr std::size_t batch_bytes =
    1 << 20;  ///< a batch this large, which a cache holds, does not wait for the clock
constexpr std::size_t index_bytes = 4096;  ///< what HDF5's index of the chunks may grow by
constexpr double writing_share = 0.02;     ///< batches are spaced so that writing takes no more of the time

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// As many as make a chunk of a good size, and no more than there will be.
hsize_t rows_in_chunk(double expected, std::size_t row) {
  const double most = static_cast<double>(chunk_bytes) / static_cast<double>(std::max<std::size_t>(row, 1));
  return static_cast<hsize_t>(std::max(1.0, std::floor(std::min(most, expected))));
}

}  // namespace

/// Runs `action` unless something failed before; its failure becomes the fault, and nothing more is written.
template <class Action>
void SeriesFile::guarded(const char* what, Action action) {
  if (!sound()) return;
  try {
    action();
  } catch (const std::exception& error) {
    fault_ = write_fault(path_, what + std::string(error.what()));
    if (file_.open()) abandon_file(file_);
  }
}

/// Runs what reads a file that is to be continued; its failure becomes the refusal.
template <class Action>
void SeriesFile::checked(Action action) {
  if (!sound()) return;
  try {
    action();
  } catch (const std::exception& error) {
    refusal_ = continuation_fault(path_, error.what());
  }
}

SeriesFile::SeriesFile(std::string path, double seconds, double expected_rows,
                       std::optional<Continue> continued)
    : path_(std::move(path)),
      seconds_(seconds),
      pause_(seconds),
      expected_rows_(expected_rows),
      continued_(continued) {
  keep_hdf5_messages();
  if (!continued_) {
    guarded("", [&] { file_ = create_file(path_); });
    return;
  }
  rows_ = written_ = continued_->rows;
  published_ = to_cut_ = true;
  checked([&] { file_ = open_to_continue(path_); });
}

SeriesFile::~SeriesFile() { close(); }

int SeriesFile::add(const std::string& path, const std::vector<hsize_t>& row_shape, const std::string& units,
                    const std::string& description, Storage storage) {
  const hsize_t entries =
      std::accumulate(row_shape.begin(), row_shape.end(), hsize_t{1}, std::multiplies<>());
  Column column{path, row_shape, storage, entries * (storage == Storage::byte ? 1 : sizeof(double)),
                0,    {},        {}};
  if (continued_) checked([&] { open_column(column, units); });
  guarded("", [&] {
    if (continued_) return;
    if (rows_ > 0) throw LibraryError("'" + path + "' was declared after the first row");
    const hsize_t rows_per_chunk = rows_in_chunk(expected_rows_, column.bytes);
    column.chunk = rows_per_chunk * column.bytes;
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
  const auto count = std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>());
  if (!continued_)
    constants_.push_back({path, shape, units, description, {values, values + count}});
  else
    checked([&] { expect_values(file_, path, shape, units, values); });
}

void SeriesFile::about(const std::string& name, const std::string& text) {
  if (continued_)
    checked([&] { expect_text(file_, name, text); });
  else
    guarded("", [&] { write_attribute(file_, name, text); });
}

void SeriesFile::write_constants() {
  for (const Constant& each : constants_) {
    const Hdf5Dataset dataset = create_dataset(file_, each.path, H5T_IEEE_F64LE, each.shape);
    hdf5(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, each.values.data()), each.path);
    describe_dataset(dataset, each.units, each.description);
  }
  constants_.clear();
}

void SeriesFile::append(int id, const double* row) { append_bytes(id, row, Storage::real); }

void SeriesFile::append(int id, const std::uint8_t* row) { append_bytes(id, row, Storage::byte); }

void SeriesFile::append_bytes(int id, const void* row, Storage storage) {
  if (!sound()) return;
  Column& column = columns_[static_cast<std::size_t>(id)];
  if (column.storage != storage)
    fault_ = path_ + ": a row of '" + column.path + "' has the wrong number type";
  const auto* bytes = static_cast<const std::byte*>(row);
  column.batch.insert(column.batch.end(), bytes, bytes + column.bytes);
}

void SeriesFile::end_row() {
  if (!sound()) return;
  ++rows_;
  const hsize_t waiting = rows_ - written_;
  for (Column& column : columns_) {
    if (column.batch.size() != waiting * column.bytes) {
      fault_ =
          path_ + ": '" + column.path + "' was not given exactly once in row " + std::to_string(rows_ - 1);
      return;
    }
    column.content_before = column.content.value();
    column.content.add(column.batch.data() + (waiting - 1) * column.bytes, column.bytes);
  }
  // The first row at once: until then HDF5's file is not one.
  if (written_ == 0 || waiting * row_bytes_ >= batch_bytes || seconds_since(last_) >= pause_) flush();
}

void SeriesFile::flush() {
  const auto start = Clock::now();
  guarded("", [&] {
    if (!file_.open() || (rows_ == written_ && constants_.empty() && !to_cut_)) return;
    cut_back();
    hsize_t rows = rows_ - written_;
    const std::string full = reserve_for(rows);
    write_constants();
    for (Column& column : columns_) write_batch(column, rows);
    flush_file();
    written_ += rows;
    if (!full.empty()) throw LibraryError(full);
  });
  pause_ = std::max(seconds_, seconds_since(start) / writing_share);
  last_ = Clock::now();
}

/// Sets room aside for `rows` rows, or for as many as a full disk takes: half, a quarter, … The reason why
/// not for all; empty when all fit.
std::string SeriesFile::reserve_for(hsize_t& rows) {
  std::string reason;
  while (true) {
    try {
      reserve(rows);
      return reason;
    } catch (const LibraryError& error) {
      if (rows < 2) throw;
      reason = error.what();
      rows /= 2;
    }
  }
}

void SeriesFile::reserve(hsize_t rows) {
  hsize_t size = 0, bytes = 0;
  hdf5(H5Fget_filesize(file_, &size), "size");
  for (const Column& column : columns_)
    bytes += rows * column.bytes + column.chunk + column.bytes + index_bytes;
  if (written_ == 0) bytes += header_bytes * columns_.size();
  for (const Constant& each : constants_) bytes += constant_bytes + sizeof(double) * each.values.size();
  room_.reach(published_ ? path_ : partial_path(path_), size, bytes);
}

void SeriesFile::write_batch(Column& column, hsize_t rows) {
  const std::string& what = column.path;
  const auto shape = rows_of(written_ + rows, column.row_shape);
  hdf5(H5Dset_extent(column.dataset, shape.data()), what);
  const auto count = rows_of(rows, column.row_shape);
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

void SeriesFile::flush_file() {
  hdf5(H5Fflush(file_, H5F_SCOPE_LOCAL), "flushing");
  check_written(file_);
  if (!published_) publish_file(file_, path_);
  published_ = true;
}

void SeriesFile::close() {
  if (!file_.open()) return;
  flush();
  guarded("closing: ", [&] {
    for (Column& column : columns_)
      if (column.dataset.close() < 0) throw LibraryError(hdf5_message());
    flush_file();
  });
  for (Column& column : columns_) (void)column.dataset.close();  // those that a failure left open
  guarded("closing: ", [&] { close_file(file_); });
  (void)file_.close();
  if (!published_) (void)std::remove(partial_path(path_).c_str());  // not a file that anybody could read
}

std::vector<double> SeriesFile::read(int id) {
  const Column& column = columns_[static_cast<std::size_t>(id)];
  std::vector<double> values;
  const auto from_disk = [&] { values = read_written(column); };
  if (continued_)
    checked(from_disk);
  else
    guarded("reading: ", from_disk);
  if (!sound()) return {};
  const std::size_t known = values.size(), waiting = column.batch.size() / sizeof(double);
  values.resize(known + waiting);
  if (waiting > 0) std::memcpy(values.data() + known, column.batch.data(), column.batch.size());
  return values;
}

std::vector<std::uint64_t> SeriesFile::contents(hsize_t rows) const {
  std::vector<std::uint64_t> found;
  for (const Column& column : columns_)
    found.push_back(rows == rows_ ? column.content.value() : column.content_before);
  return found;
}

void SeriesFile::expect(const std::vector<std::uint64_t>& contents) {
  checked([&] {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      read_content(columns_[k]);
      if (columns_[k].content.value() != contents[k])
        throw LibraryError("'" + columns_[k].path + "' has other values than the run wrote");
    }
  });
}

double SeriesFile::bytes(double rows) const {
  double sum = 0;
  for (const Column& column : columns_) {
    const double chunk = static_cast<double>(std::max<std::size_t>(column.chunk, 1));
    sum += header_bytes + chunk * std::ceil(rows * static_cast<double>(column.bytes) / chunk);
  }
  for (const Constant& each : constants_)
    sum += constant_bytes + static_cast<double>(sizeof(double) * each.values.size());
  return sum;
}

}  // namespace slipscale
