#include "journaled_driver.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>
#include <utility>

#include "slipscale/base/error.hpp"
#include "slipscale/files/hdf5.hpp"

namespace slipscale {
namespace {

/// What HDF5 holds of an open file.
struct OpenFile : H5FD_t {
  OpenFile(const char* path, int flags) : H5FD_t{}, file(path, flags) {}
  JournaledFile file;
  haddr_t allocated = 0;  ///< end of what HDF5 has given away
  bool writable = false;
  bool data_through = false;
};

OpenFile& of(H5FD_t* file) { return *static_cast<OpenFile*>(file); }
const OpenFile& of(const H5FD_t* file) { return *static_cast<const OpenFile*>(file); }

/// Tells HDF5's error stack in the words in which its own drivers do.
template <class Result>
Result fault(Result result, const char* reason) {
  (void)H5Epush2(H5E_DEFAULT, __FILE__, "journaled driver", __LINE__, H5E_ERR_CLS, H5E_VFL, H5E_CANTOPENFILE,
                 "error message = '%s'", reason);
  return result;
}

/// Runs what may throw, for lack of memory say, below HDF5's functions.
template <class Action>
herr_t guarded(Action action) {
  try {
    return action() ? 0 : -1;
  } catch (const std::exception& error) {
    return fault(-1, error.what());
  }
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t, haddr_t) {
  const bool writable = flags & H5F_ACC_RDWR, fresh = flags & (H5F_ACC_TRUNC | H5F_ACC_EXCL);
  int system = writable ? O_RDWR : O_RDONLY;
  if (flags & H5F_ACC_TRUNC) system |= O_TRUNC;
  if (flags & H5F_ACC_CREAT) system |= O_CREAT;
  if (flags & H5F_ACC_EXCL) system |= O_EXCL;
  try {
    auto file = std::make_unique<OpenFile>(name, system);
    file->writable = writable;
    file->data_through = fresh;
    return file.release();
  } catch (const std::exception& error) {
    return fault<H5FD_t*>(nullptr, error.what());
  }
}

herr_t commit(H5FD_t* file, hid_t, hbool_t) {
  return guarded([&] {
    if (of(file).writable) of(file).file.commit(of(file).allocated);
    return true;
  });
}

herr_t close_file(H5FD_t* file) {
  const std::unique_ptr<OpenFile> owned(&of(file));
  return owned->file.waiting() ? commit(file, H5P_DEFAULT, true) : 0;
}

int compare(const H5FD_t* left, const H5FD_t* right) {
  struct stat a {
  }, b{};
  if (fstat(of(left).file.descriptor(), &a) != 0 || fstat(of(right).file.descriptor(), &b) != 0) return -1;
  const auto mine = std::pair(a.st_dev, a.st_ino), other = std::pair(b.st_dev, b.st_ino);
  return mine < other ? -1 : mine > other ? 1 : 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t) { return of(file).allocated; }

herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  of(file).allocated = end;
  return 0;
}

haddr_t end_of(const H5FD_t* file, H5FD_mem_t) { return of(file).file.size(); }

herr_t handle(H5FD_t* file, hid_t, void** found) {
  *found = file;
  return 0;
}

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* to) {
  return guarded([&] { return of(file).file.read(at, size, to) || fault(false, "reading failed"); });
}

herr_t write(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t at, std::size_t size, const void* from) {
  return guarded([&] {
    of(file).file.write(at, size, from, kind == H5FD_MEM_DRAW && of(file).data_through);
    return true;
  });
}

/// The file gets its length when it is committed.
herr_t set_length(H5FD_t* file, hid_t, hbool_t) {
  if (of(file).writable) of(file).file.set_size(of(file).allocated);
  return 0;
}

const H5FD_class_t& driver_class() {
  static const H5FD_class_t found = [] {
    H5FD_class_t c{};
    c.name = "slipscale_journaled";
    c.maxaddr = (haddr_t{1} << 62) - 1;
    c.fc_degree = H5F_CLOSE_WEAK;
    c.open = open_file;
    c.close = close_file;
    c.cmp = compare;
    c.query = query;
    c.get_eoa = allocated;
    c.set_eoa = allocate;
    c.get_eof = end_of;
    c.get_handle = handle;
    c.read = read;
    c.write = write;
    c.flush = commit;
    c.truncate = set_length;
    const H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(kinds), std::end(kinds), std::begin(c.fl_map));
    return c;
  }();
  return found;
}

hid_t driver() {
  static const hid_t found = hdf5(H5FDregister(&driver_class()), "cannot register the file driver");
  return found;
}

OpenFile* open_file_of(hid_t file) {
  void* found = nullptr;
  if (H5Fget_vfd_handle(file, H5P_DEFAULT, &found) < 0) return nullptr;
  return static_cast<OpenFile*>(static_cast<H5FD_t*>(found));
}

}  // namespace

void use_journaled_driver(hid_t access) {
  hdf5(H5Pset_driver(access, driver(), nullptr), "cannot set the file driver");
}

JournaledFile* journaled_file(hid_t file) {
  OpenFile* const found = open_file_of(file);
  return found ? &found->file : nullptr;
}

void let_data_through(hid_t file) {
  if (OpenFile* const found = open_file_of(file)) found->data_through = true;
}

}  // namespace slipscale
