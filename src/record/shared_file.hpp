#pragma once

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

#include "slipscale/record/hdf5.hpp"

namespace slipscale {

/// Runs what may fail on one rank alone, and lets all ranks fail with it. Collective.
void write_together(MPI_Comm comm, const std::string& path, const std::function<void()>& action);

/// A dataset's place, unit and meaning.
struct DatasetDescription {
  std::string path, units, text;
};

/// Rows [begin, begin + count) of a dataset of this shape are this rank's.
struct DatasetSlice {
  std::vector<hsize_t> shape;
  hsize_t begin = 0, count = 0;
};

/// An HDF5 file that all ranks write together, under a temporary name until `finish`. What fails on one rank,
/// a full disk say, throws UserError on all. All members are collective.
class SharedFile {
 public:
  /// `bytes`: what the file will have at most, set aside at once.
  SharedFile(MPI_Comm comm, const std::string& path, double bytes);
  /// Removes what is not finished.
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// Writes a dataset from all ranks at once; `more` adds attributes to it.
  void write(
      const DatasetDescription& about, const DatasetSlice& slice, hid_t type, const void* rows,
      const std::function<void(hid_t dataset)>& more = [](hid_t) {});

  /// A second path to a dataset.
  void link(const std::string& from, const std::string& to);

  void finish();

 private:
  std::string partial() const { return path_ + ".partial"; }

  MPI_Comm comm_;
  int rank_ = 0;
  std::string path_;
  Hdf5File file_;
  bool finished_ = false;
};

}  // namespace slipscale
