#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/content_checksum.hpp"
#include "slipscale/files/disk_space.hpp"
#include "slipscale/files/hdf5.hpp"

namespace slipscale {

/// An HDF5 file of growing datasets, one per quantity and one row per recorded step: history.h5, contact.h5.
///
/// Lives on one rank. Rows gather in memory and go to the disk in batches, all datasets by the same number of
/// rows, so that a running job can be plotted and a killed one read: serial driver, default file format, no
/// file locking. Room is set aside before each batch, so that a full disk, or a file that somebody removed,
/// is found before HDF5 stumbles over it; of a batch that does not fit the first rows are kept. Nothing here
/// throws, because the other ranks would wait for ever: a failure is kept in `fault`, which the caller shares
/// with them (`throw_together`) when it suits, and after which all members do nothing.
///
/// A file that another process began can be continued: the same declarations then check what is there, and
/// nothing is written until the first batch, which cuts off the rows behind those that count. What is not as
/// declared is kept in `refusal`, a sentence for the user, after which all members do nothing, too.
class SeriesFile {
 public:
  enum class Storage { real, byte };  ///< 64-bit floating point; unsigned 8-bit integer

  /// That the file is there and has at least so many rows, of which these count.
  struct Continue {
    hsize_t rows = 0;
  };

  /// Creates the file, over an older one, or opens it to `continued`. `expected_rows`: chunks need not be
  /// larger. The first row is written at once, then a batch when `seconds` have passed since the last, or
  /// more where writing is slow.
  explicit SeriesFile(std::string path, double seconds = 0.5, double expected_rows = 1e15,
                      std::optional<Continue> continued = {});
  ~SeriesFile();
  SeriesFile(SeriesFile&&) = default;
  SeriesFile& operator=(SeriesFile&&) = delete;

  /// Declares a quantity before the first row: dataset path, shape of one row ({} a number), SI unit, one
  /// line. Returns its id.
  int add(const std::string& path, const std::vector<hsize_t>& row_shape, const std::string& units,
          const std::string& description, Storage storage = Storage::real);

  /// What does not grow, written with the first row: `values` has the given shape. Before the first row.
  void constant(const std::string& path, const double* values, const std::vector<hsize_t>& shape,
                const std::string& units, const std::string& description);

  /// A text about the whole file, an attribute of its root group. Before the first row.
  void about(const std::string& name, const std::string& text);

  /// One row of a quantity; every quantity must be given one before `end_row`.
  void append(int id, const double* row);
  void append(int id, const std::uint8_t* row);
  void append(int id, double value) { append(id, &value); }

  /// Closes the row; writes the batch when it is time, or when it has grown large.
  void end_row();
  /// Writes the batch now.
  void flush();
  /// Writes the rest and closes the file.
  void close();

  /// The rows so far of a quantity that is real, one after the other; empty when they cannot be read, which
  /// is a fault.
  std::vector<double> read(int id);

  /// What tells whether the rows of each quantity are still those that were written; of the first `rows`,
  /// which are all or all but the last. Of a continued file once `expect` has read it.
  std::vector<std::uint64_t> contents(hsize_t rows) const;
  /// Of a continued file: reads it wholly, and refuses it unless its rows have these checksums.
  void expect(const std::vector<std::uint64_t>& contents);

  /// Predicted size after so many rows, bytes.
  double bytes(double rows) const;
  /// One sentence on what went wrong; empty as long as all is well.
  const std::string& fault() const { return fault_; }
  /// One sentence on why the file cannot be continued; empty as long as it can.
  const std::string& refusal() const { return refusal_; }
  std::size_t quantities() const { return columns_.size(); }
  hsize_t rows() const { return rows_; }                ///< complete ones, in memory and on disk
  std::size_t row_bytes() const { return row_bytes_; }  ///< of all quantities together

 private:
  struct Column {
    std::string path;
    std::vector<hsize_t> row_shape;
    Storage storage;
    std::size_t bytes;  ///< of one row
    std::size_t chunk;  ///< bytes
    Hdf5Dataset dataset;
    std::vector<std::byte> batch;      ///< rows not yet on disk
    ContentChecksum content{};         ///< of all rows
    std::uint64_t content_before = 0;  ///< of all but the last
  };
  struct Constant {
    std::string path;
    std::vector<hsize_t> shape;
    std::string units, description;
    std::vector<double> values;
  };
  using Clock = std::chrono::steady_clock;

  bool sound() const { return fault_.empty() && refusal_.empty(); }
  template <class Action>
  void guarded(const char* what, Action action);
  template <class Action>
  void checked(Action action);
  void open_column(Column& column, const std::string& units);
  std::vector<double> read_written(const Column& column) const;
  void read_content(Column& column) const;
  void append_bytes(int id, const void* row, Storage storage);
  std::string reserve_for(hsize_t& rows);
  void reserve(hsize_t rows);
  void cut_back();
  void flush_file();
  void write_constants();
  void write_batch(Column& column, hsize_t rows);

  std::string path_, fault_, refusal_;
  Hdf5File file_;
  Reservation room_;
  std::vector<Column> columns_;
  std::vector<Constant> constants_;  ///< not yet on disk
  hsize_t rows_ = 0, written_ = 0;
  std::size_t row_bytes_ = 0;
  double seconds_, pause_, expected_rows_;
  bool published_ = false;
  std::optional<Continue> continued_;
  bool to_cut_ = false;  ///< there may be rows behind those that count
  Clock::time_point last_ = Clock::now();
};

}  // namespace slipscale
