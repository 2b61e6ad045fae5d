#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "slipscale/files/file_order.hpp"
#include "slipscale/files/hdf5.hpp"

namespace slipscale {

/// Runs what may fail on one rank alone, and lets all ranks fail with it: `RunError`. `action` must not be
/// collective, or a rank that fails before it would leave the others waiting. Collective.
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

/// This rank's slice of rows of a shape ({} a number) in a file's order.
DatasetSlice slice_of(const FileOrder& order, std::vector<hsize_t> shape_of_row);
/// All rows on rank 0, none elsewhere.
DatasetSlice slice_of_root(MPI_Comm comm, std::vector<hsize_t> shape);

/// Rows made of others' columns: entry `to` of each row, counted through its shape, shows entry `at` of the
/// rows of the dataset `from`, which have the shape `row` ({} a number). Entries that nothing fills are 0.
struct DatasetView {
  struct Entry {
    std::size_t to;
    std::string from;
    std::vector<hsize_t> row;
    std::size_t at;
  };
  std::vector<hsize_t> shape;  ///< rows first
  std::vector<Entry> entries;
};

/// HDF5's name of PetscInt in memory and in files.
hid_t index_type();

/// An HDF5 file of data that lie on all ranks.
///
/// Rank 0 writes it, with HDF5's serial driver; the others send it their rows, a few MiB at a time. No call
/// of HDF5 is collective, so a failure, which only the writing rank can see, leaves nobody waiting: it is
/// told to all before anything else is sent, and throws `RunError` on all. (MPI-IO offers no such guard: an
/// error of one rank unwinds into a collective close.) All members are collective.
class SharedFile {
 public:
  /// `whole`: under a temporary name until `finish`, and gone if that never comes; `growing`: under its own
  /// name from the first `flush`, readable after each; `continued`: a growing one that another process
  /// began, to `examine` and then go on with.
  enum class Appearance { whole, growing, continued };

  /// `bytes`: what the file will soon have at most, set aside at once. Throws `UserError` on all ranks when a
  /// file to be continued is not there, damaged, or of another program.
  SharedFile(MPI_Comm comm, const std::string& path, double bytes, Appearance appearance = Appearance::whole);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// Writes a dataset from all ranks; `more` adds attributes to it, on rank 0 alone.
  void write(
      const DatasetDescription& about, const DatasetSlice& slice, hid_t type, const void* rows,
      const std::function<void(hid_t dataset)>& more = [](hid_t) {});
  /// The same from the rows of width `shape_of_row` that each rank holds, in the order of `order`'s numbers.
  void write(const DatasetDescription& about, const FileOrder& order,
             const std::vector<hsize_t>& shape_of_row, const double* rows);

  /// Declares a list of numbers that grows by `append`, which takes rank 0's value.
  void add_series(const DatasetDescription& about);
  void append(const std::string& series, double value);

  /// On rank 0 a checksum of the datasets written since the last call, paths and contents, free of their
  /// order.
  std::uint64_t take_contents() { return std::exchange(contents_, 0); }

  /// A dataset without data of its own: columns of others as entries of a larger row (HDF5's virtual
  /// dataset). For readers that want tensors where we keep less.
  void write_view(const DatasetDescription& about, const DatasetView& view);

  /// A second path to a dataset.
  void link(const std::string& from, const std::string& to);
  /// Adds attributes to a dataset or group that exists, on rank 0 alone.
  void describe(const std::string& object, const std::function<void(hid_t object)>& attributes);

  /// Looks at the file on rank 0; `LibraryError` with a fault becomes `UserError`, the sentence on why it
  /// cannot be continued, on all ranks.
  void examine(const std::function<void(hid_t file)>& look) const;
  /// Does something else to the file, on rank 0 alone.
  void change(const std::function<void(hid_t file)>& action);
  /// Of a continued file: all that had to be removed is, and its room may be used.
  void end_changes();

  /// The first `count` numbers of a list, the same on every rank. Throws as `examine`.
  std::vector<double> read_series(const DatasetDescription& about, std::size_t count) const;
  /// Keeps the first `count` of a list.
  void cut_series(const std::string& series, std::size_t count);

  /// Sets room aside for what comes next; when the disk has not got it, the file stays as it is.
  void reserve(double bytes);
  void flush();
  void finish();

 private:
  /// Runs it on rank 0. After a failure nothing more gets to the disk.
  void on_root(const std::function<void()>& action);
  std::string name() const { return published_ ? path_ : partial_path(path_); }
  void discard();
  void publish();

  MPI_Comm comm_;
  bool root_;
  std::string path_;
  Appearance appearance_;
  Hdf5File file_;  ///< on rank 0
  std::uint64_t contents_ = 0;
  bool published_ = false, finished_ = false;
};

}  // namespace slipscale
