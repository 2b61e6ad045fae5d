#include "shared_file.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "disk_space.hpp"
#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

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

SharedFile::SharedFile(MPI_Comm comm, const std::string& path, double bytes) : comm_(comm), path_(path) {
  keep_hdf5_messages();
  MPI_Comm_rank(comm, &rank_);
  write_together(comm_, path_, [&] {
    const Hdf5Properties access(hdf5(H5Pcreate(H5P_FILE_ACCESS), "preparing"));
    hdf5(H5Pset_fapl_mpio(access, comm_, MPI_INFO_NULL), "preparing");
    hdf5(H5Pset_coll_metadata_write(access, 1), "preparing");
    file_ = Hdf5File(hdf5(H5Fcreate(partial().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "creating"));
  });
  try {
    write_together(comm_, path_, [&] {
      if (rank_ == 0) reserve_space(partial(), 0, static_cast<std::uint64_t>(bytes));
    });
  } catch (...) {  // there is no destructor to run for an object that is not made
    (void)file_.close();
    if (rank_ == 0) (void)std::remove(partial().c_str());
    throw;
  }
}

SharedFile::~SharedFile() {
  if (finished_) return;
  (void)file_.close();
  if (rank_ == 0) (void)std::remove(partial().c_str());
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

void SharedFile::link(const std::string& from, const std::string& to) {
  write_together(comm_, path_, [&] {
    const Hdf5Properties links(hdf5(H5Pcreate(H5P_LINK_CREATE), to));
    hdf5(H5Pset_create_intermediate_group(links, 1), to);
    hdf5(H5Lcreate_hard(file_, from.c_str(), file_, to.c_str(), links, H5P_DEFAULT), to);
  });
}

void SharedFile::finish() {
  write_together(comm_, path_, [&] {
    if (file_.close() < 0) throw LibraryError(hdf5_message());
  });
  write_together(comm_, path_, [&] {
    std::error_code code;
    if (rank_ == 0) std::filesystem::rename(partial(), path_, code);
    if (code) throw LibraryError(code.message());
  });
  finished_ = true;
}

}  // namespace slipscale
