#include "slipscale/files/shared_file.hpp"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <numeric>

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/files/collect_rows.hpp"
#include "slipscale/files/continued_file.hpp"
#include "slipscale/files/disk_space.hpp"

namespace slipscale {
namespace {

constexpr hsize_t series_chunk = 512;

void write_rows(hid_t dataset, const std::vector<hsize_t>& shape, hsize_t begin, hsize_t count, hid_t type,
                const void* rows, const std::string& what) {
  const Hdf5Space target(hdf5(H5Dget_space(dataset), what));
  std::vector<hsize_t> start(shape.size(), 0), size(shape);
  size[0] = count;
  start[0] = begin;
  const Hdf5Space source(hdf5(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), what));
  hdf5(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), what);
  hdf5(H5Dwrite(dataset, type, source, target, H5P_DEFAULT, rows), what);
}

/// What HDF5 remembers of datasets that are long written, it remembers up to a size of its own; views take
/// twenty to forty times what it counts, so that a hundred frames held as much memory as ten of their frames.
void forget_soon(hid_t file) {
  constexpr std::size_t remembered = 128 << 10;  ///< bytes as HDF5 counts; a frame's dataset headers are 6 kB
  H5AC_cache_config_t config{};
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  hdf5(H5Fget_mdc_config(file, &config), "cannot read the cache's size");
  config.set_initial_size = 1;
  config.initial_size = config.max_size = config.min_size = remembered;
  config.incr_mode = H5C_incr__off;
  config.flash_incr_mode = H5C_flash_incr__off;
  config.decr_mode = H5C_decr__off;
  hdf5(H5Fset_mdc_config(file, &config), "cannot set the cache's size");
}

/// Of a dataset of this shape one entry of every row.
Hdf5Space column_of(const std::vector<hsize_t>& shape, std::size_t entry, const std::string& what) {
  Hdf5Space space(hdf5(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), what));
  std::vector<hsize_t> start(shape.size(), 0), size(shape.size(), 1);
  size[0] = shape[0];
  for (std::size_t d = shape.size(); d-- > 1; entry /= shape[d]) start[d] = entry % shape[d];
  hdf5(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), what);
  return space;
}

std::size_t row_bytes(const std::vector<hsize_t>& shape, hid_t type) {
  const std::size_t number = H5Tget_size(type);
  if (number == 0) throw LibraryError("size of a number: " + hdf5_message());
  return std::accumulate(shape.begin() + 1, shape.end(), number, std::multiplies<>());
}

}  // namespace

void write_together(MPI_Comm comm, const std::string& path, const std::function<void()>& action) {
  std::string fault;
  try {
    action();
  } catch (const LibraryError& error) {
    fault = write_fault(path, error.what());
  }
  stop_together(comm, fault);
}

DatasetSlice slice_of(const FileOrder& order, std::vector<hsize_t> shape_of_row) {
  shape_of_row.insert(shape_of_row.begin(), static_cast<hsize_t>(order.total()));
  return {std::move(shape_of_row), static_cast<hsize_t>(order.begin()), static_cast<hsize_t>(order.count())};
}

DatasetSlice slice_of_root(MPI_Comm comm, std::vector<hsize_t> shape) {
  const hsize_t rows = is_root(comm) ? shape[0] : 0;
  return {std::move(shape), 0, rows};
}

hid_t index_type() { return sizeof(PetscInt) == 8 ? H5T_NATIVE_INT64 : H5T_NATIVE_INT32; }

SharedFile::SharedFile(MPI_Comm comm, const std::string& path, double bytes, Appearance appearance)
    : comm_(comm), root_(is_root(comm)), path_(path), appearance_(appearance) {
  keep_hdf5_messages();
  published_ = appearance_ == Appearance::continued;
  if (published_) examine([&](hid_t) { file_ = open_to_continue(path_); });
  write_together(comm_, path_, [&] {
    if (!root_) return;
    if (!file_.open()) file_ = create_file(path_);
    forget_soon(file_);
  });
  try {
    reserve(bytes);
  } catch (...) {  // there is no destructor to run for an object that is not made
    discard();
    throw;
  }
}

SharedFile::~SharedFile() {
  if (!finished_) discard();
}

/// What was not flushed, or all where nobody knows the file yet.
void SharedFile::discard() {
  if (!root_) return;
  if (file_.open()) abandon_file(file_);
  (void)file_.close();
  if (!published_) (void)std::remove(name().c_str());
}

void SharedFile::on_root(const std::function<void()>& action) {
  write_together(comm_, path_, [&] {
    if (!root_) return;
    if (!file_.open()) throw LibraryError("an earlier write failed");
    try {
      action();
      if (file_.open()) check_written(file_);
    } catch (const LibraryError&) {
      if (file_.open()) abandon_file(file_);
      (void)file_.close();
      throw;
    }
  });
}

void SharedFile::write(const DatasetDescription& about, const DatasetSlice& slice, hid_t type,
                       const void* rows, const std::function<void(hid_t dataset)>& more) {
  Hdf5Dataset dataset;
  on_root([&] {
    dataset = create_dataset(file_, about.path, type, slice.shape);
    describe_dataset(dataset, about.units, about.text);
    more(dataset);
  });
  std::string fault;
  ContentChecksum content = content_begun(about.path, slice.shape);
  const std::size_t bytes = row_bytes(slice.shape, type);
  // A rank that cannot write goes on receiving, so that nobody waits for it.
  collect_rows(comm_, {slice.begin, slice.count, bytes}, rows,
               [&](std::uint64_t begin, std::uint64_t count, const void* piece) {
                 if (!fault.empty()) return;
                 content.add(piece, count * bytes);
                 try {
                   write_rows(dataset, slice.shape, begin, count, type, piece, about.path);
                   check_written(file_, about.path);
                 } catch (const LibraryError& error) {
                   fault = error.what();
                 }
               });
  on_root([&] {
    if (!fault.empty()) throw LibraryError(fault);
    contents_ += content.value();
    if (dataset.close() < 0) throw LibraryError(hdf5_message());
  });
}

void SharedFile::write(const DatasetDescription& about, const FileOrder& order,
                       const std::vector<hsize_t>& shape_of_row, const double* rows) {
  const auto width = std::accumulate(shape_of_row.begin(), shape_of_row.end(), 1, std::multiplies<>());
  write(about, slice_of(order, shape_of_row), H5T_NATIVE_DOUBLE, order.to_file(rows, width).data());
}

void SharedFile::add_series(const DatasetDescription& about) {
  on_root([&] {
    const Hdf5Dataset series =
        create_dataset(file_, about.path, H5T_IEEE_F64LE, {0}, {H5S_UNLIMITED}, {series_chunk});
    describe_dataset(series, about.units, about.text);
  });
}

void SharedFile::append(const std::string& series, double value) {
  on_root([&] {
    Hdf5Dataset dataset(hdf5(H5Dopen2(file_, series.c_str(), H5P_DEFAULT), series));
    const hsize_t length = shape_of(dataset, series)[0];
    const hsize_t longer = length + 1;
    hdf5(H5Dset_extent(dataset, &longer), series);
    write_rows(dataset, {longer}, length, 1, H5T_NATIVE_DOUBLE, &value, series);
    if (dataset.close() < 0) throw LibraryError(hdf5_message());
  });
}

void SharedFile::write_view(const DatasetDescription& about, const DatasetView& view) {
  on_root([&] {
    const std::string& what = about.path;
    const int rank = static_cast<int>(view.shape.size());
    const Hdf5Properties creation(hdf5(H5Pcreate(H5P_DATASET_CREATE), what));
    for (const DatasetView::Entry& entry : view.entries) {
      std::vector<hsize_t> from{view.shape[0]};
      from.insert(from.end(), entry.row.begin(), entry.row.end());
      const Hdf5Space target = column_of(view.shape, entry.to, what),
                      source = column_of(from, entry.at, what);
      hdf5(H5Pset_virtual(creation, target, ".", entry.from.c_str(), source), what);
    }
    const Hdf5Space space(hdf5(H5Screate_simple(rank, view.shape.data(), nullptr), what));
    const Hdf5Properties links(hdf5(H5Pcreate(H5P_LINK_CREATE), what));
    hdf5(H5Pset_create_intermediate_group(links, 1), what);
    const Hdf5Dataset dataset(
        hdf5(H5Dcreate2(file_, what.c_str(), H5T_IEEE_F64LE, space, links, creation, H5P_DEFAULT), what));
    contents_ += contents_of_view(dataset, what);
    describe_dataset(dataset, about.units, about.text);
  });
}

void SharedFile::link(const std::string& from, const std::string& to) {
  on_root([&] {
    const Hdf5Properties links(hdf5(H5Pcreate(H5P_LINK_CREATE), to));
    hdf5(H5Pset_create_intermediate_group(links, 1), to);
    hdf5(H5Lcreate_hard(file_, from.c_str(), file_, to.c_str(), links, H5P_DEFAULT), to);
  });
}

void SharedFile::describe(const std::string& object, const std::function<void(hid_t object)>& attributes) {
  on_root([&] {
    const Hdf5Object opened(hdf5(H5Oopen(file_, object.c_str(), H5P_DEFAULT), object));
    attributes(opened);
  });
}

void SharedFile::reserve(double bytes) {
  write_together(comm_, path_, [&] {
    if (!root_ || !file_.open()) return;
    hsize_t used = 0;
    hdf5(H5Fget_filesize(file_, &used), "size");
    reserve_space(name(), used, static_cast<std::uint64_t>(bytes));
  });
}

void SharedFile::flush() {
  on_root([&] {
    hdf5(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flushing");
    check_written(file_);
    if (!published_ && appearance_ == Appearance::growing) publish();
  });
}

void SharedFile::publish() {
  publish_file(file_, path_);
  published_ = true;
}

void SharedFile::finish() {
  flush();
  on_root([&] {
    close_file(file_);
    if (!published_) publish();
  });
  finished_ = true;
}

}  // namespace slipscale
