#include "slipscale/files/shared_file.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numeric>

#include "disk_space.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"

namespace slipscale {
namespace {

constexpr hsize_t series_chunk = 512;

void write_rows(hid_t dataset, const DatasetSlice& slice, hid_t type, const void* rows,
                const std::string& what) {
  const Hdf5Space target(hdf5(H5Dget_space(dataset), what));
  std::vector<hsize_t> start(slice.shape.size(), 0), size(slice.shape);
  size[0] = slice.count;
  start[0] = slice.begin;
  const Hdf5Space source(hdf5(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), what));
  if (slice.count > 0)
    hdf5(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), what);
  else
    hdf5(H5Sselect_none(target), what);
  const Hdf5Properties transfer(hdf5(H5Pcreate(H5P_DATASET_XFER), what));
  hdf5(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), what);
  hdf5(H5Dwrite(dataset, type, source, target, transfer, rows), what);
}

}  // namespace

void write_together(MPI_Comm comm, const std::string& path, const std::function<void()>& action) {
  std::string fault;
  try {
    action();
  } catch (const LibraryError& error) {
    fault = path + " cannot be written: " + error.what() +
            "; see that -output_folder is writable and its disk has room";
  }
  throw_together(comm, fault);
}

DatasetSlice slice_of(const FileOrder& order, std::vector<hsize_t> shape_of_row) {
  shape_of_row.insert(shape_of_row.begin(), static_cast<hsize_t>(order.total()));
  return {std::move(shape_of_row), static_cast<hsize_t>(order.begin()), static_cast<hsize_t>(order.count())};
}

hid_t index_type() { return sizeof(PetscInt) == 8 ? H5T_NATIVE_INT64 : H5T_NATIVE_INT32; }

SharedFile::SharedFile(MPI_Comm comm, const std::string& path, double bytes, Appearance appearance)
    : comm_(comm), path_(path), appearance_(appearance) {
  keep_hdf5_messages();
  rank_ = rank_of(comm);
  write_together(comm_, path_, [&] {
    const Hdf5Properties access(hdf5(H5Pcreate(H5P_FILE_ACCESS), "preparing"));
    hdf5(H5Pset_fapl_mpio(access, comm_, MPI_INFO_NULL), "preparing");
    hdf5(H5Pset_coll_metadata_write(access, 1), "preparing");
    file_ = Hdf5File(hdf5(H5Fcreate(name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "creating"));
  });
  try {
    reserve(bytes);
  } catch (...) {  // there is no destructor to run for an object that is not made
    discard();
    throw;
  }
}

SharedFile::~SharedFile() {
  if (!finished_ && appearance_ == Appearance::whole) discard();
}

void SharedFile::discard() {
  (void)file_.close();
  if (rank_ == 0) (void)std::remove(name().c_str());
}

void SharedFile::write(const DatasetDescription& about, const DatasetSlice& slice, hid_t type,
                       const void* rows, const std::function<void(hid_t dataset)>& more) {
  write_together(comm_, path_, [&] {
    const Hdf5Dataset dataset = create_dataset(file_, about.path, type, slice.shape);
    describe_dataset(dataset, about.units, about.text);
    more(dataset);
    write_rows(dataset, slice, type, rows, about.path);
  });
}

void SharedFile::write(const DatasetDescription& about, const FileOrder& order,
                       const std::vector<hsize_t>& shape_of_row, const double* rows) {
  const auto width = std::accumulate(shape_of_row.begin(), shape_of_row.end(), 1, std::multiplies<>());
  write(about, slice_of(order, shape_of_row), H5T_NATIVE_DOUBLE, order.to_file(rows, width).data());
}

void SharedFile::add_series(const DatasetDescription& about) {
  write_together(comm_, path_, [&] {
    const Hdf5Dataset series =
        create_dataset(file_, about.path, H5T_IEEE_F64LE, {0}, {H5S_UNLIMITED}, {series_chunk});
    describe_dataset(series, about.units, about.text);
  });
}

void SharedFile::append(const std::string& series, double value) {
  write_together(comm_, path_, [&] {
    Hdf5Dataset dataset(hdf5(H5Dopen2(file_, series.c_str(), H5P_DEFAULT), series));
    hsize_t length = 0;
    {
      const Hdf5Space space(hdf5(H5Dget_space(dataset), series));
      hdf5(H5Sget_simple_extent_dims(space, &length, nullptr), series);
    }
    const hsize_t longer = length + 1;
    hdf5(H5Dset_extent(dataset, &longer), series);
    write_rows(dataset, {{longer}, length, rank_ == 0 ? 1u : 0u}, H5T_NATIVE_DOUBLE, &value, series);
    if (dataset.close() < 0) throw LibraryError(hdf5_message());
  });
}

void SharedFile::link(const std::string& from, const std::string& to) {
  write_together(comm_, path_, [&] {
    const Hdf5Properties links(hdf5(H5Pcreate(H5P_LINK_CREATE), to));
    hdf5(H5Pset_create_intermediate_group(links, 1), to);
    hdf5(H5Lcreate_hard(file_, from.c_str(), file_, to.c_str(), links, H5P_DEFAULT), to);
  });
}

void SharedFile::describe(const std::string& object, const std::function<void(hid_t object)>& attributes) {
  write_together(comm_, path_, [&] {
    const Hdf5Object opened(hdf5(H5Oopen(file_, object.c_str(), H5P_DEFAULT), object));
    attributes(opened);
  });
}

void SharedFile::reserve(double bytes) {
  write_together(comm_, path_, [&] {
    if (rank_ == 0)
      reserve_space(name(), std::filesystem::file_size(name()), static_cast<std::uint64_t>(bytes));
  });
}

void SharedFile::flush() {
  write_together(comm_, path_, [&] { hdf5(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flushing"); });
}

void SharedFile::finish() {
  write_together(comm_, path_, [&] {
    if (file_.close() < 0) throw LibraryError(hdf5_message());
  });
  if (appearance_ == Appearance::whole)
    write_together(comm_, path_, [&] {
      std::error_code code;
      if (rank_ == 0) std::filesystem::rename(name(), path_, code);
      if (code) throw LibraryError(code.message());
    });
  finished_ = true;
}

}  // namespace slipscale
