#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace slipscale {

/// The one owner of an HDF5 identifier; closing it never throws, so that a full disk cannot end the program
/// here.
template <herr_t (*Close)(hid_t)>
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  explicit Hdf5Handle(hid_t id) : id_(id) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Hdf5Handle() { (void)close(); }

  operator hid_t() const { return id_; }
  bool open() const { return id_ >= 0; }
  /// Closes now; negative when HDF5 could not (the identifier is given up all the same).
  herr_t close() { return id_ >= 0 ? Close(std::exchange(id_, -1)) : 0; }

 private:
  hid_t id_ = -1;
};

using Hdf5File = Hdf5Handle<H5Fclose>;
using Hdf5Group = Hdf5Handle<H5Gclose>;
using Hdf5Dataset = Hdf5Handle<H5Dclose>;
using Hdf5Space = Hdf5Handle<H5Sclose>;
using Hdf5Type = Hdf5Handle<H5Tclose>;
using Hdf5Properties = Hdf5Handle<H5Pclose>;
using Hdf5Object = Hdf5Handle<H5Oclose>;
using Hdf5Attribute = Hdf5Handle<H5Aclose>;

/// Stops HDF5 from printing its error stack; `hdf5` reports instead. Cheap, may be repeated.
void keep_hdf5_messages();

/// Where a new file lies until it is published.
std::string partial_path(const std::string& path);

/// A new file, at its `partial_path`. A killed run must leave a readable file, and a running one must let
/// readers in: the oldest format, no file locking, and a file driver of our own (journaled_driver.hpp), by
/// which each flush takes the file from one whole state to the next, wherever the process is killed. It says
/// at once where it comes from (`write_provenance`).
Hdf5File create_file(const std::string& path);
/// Gives a new file, once flushed, its own name, over an older one. Throws `LibraryError`.
void publish_file(hid_t file, const std::string& path);

/// An existing file, without file locking, so that the file of a running job can be read.
Hdf5File open_file(const std::string& path);
/// The same to write in it; what is written over what is there waits for a flush until `let_data_through`.
Hdf5File open_file_to_write(const std::string& path);
void let_data_through(hid_t file);
/// Makes good what a process left that was killed while it flushed; nothing where there is nothing to do.
/// `to_write`: for the process that owns the file now; any other leaves alone what somebody is at work on.
void recover_file(const std::string& path, bool to_write = false);

// HDF5 does not survive a write that fails, and is not told: ask after what may have filled the disk.

/// Throws `LibraryError` "<what>: <the system's words>" when a write to the file has failed.
void check_written(hid_t file, const std::string& what = "");
/// Nothing more gets to the disk; the file stays as it was flushed last.
void abandon_file(hid_t file);
/// Closes it. Throws likewise.
void close_file(Hdf5File& file);

/// Attributes of the root group: program, version, commit (where built from git), date (UTC, of the start)
/// and ranks. They stand apart from the datasets, which are the same on any number of ranks.
void write_provenance(hid_t file);

/// "fnv1a:" and 16 hexadecimal digits, as run.yaml and the root attribute mesh_checksum have it.
std::string checksum_text(std::uint64_t checksum);

/// Hands on the return value of an HDF5 function, or throws `LibraryError` "<what>: <HDF5's innermost
/// message>" when it is negative: `hdf5(H5Dwrite(…), "cannot write /time of history.h5")`.
hid_t hdf5(hid_t result, const std::string& what);

/// The innermost message of HDF5's current error stack, which is the cause; the system's text ("No space left
/// on device") where there is one.
std::string hdf5_message();

/// Writes a text as a fixed-length UTF-8 attribute.
void write_attribute(hid_t object, const std::string& name, const std::string& value);
/// Likewise a list of texts, one-dimensional.
void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& values);
/// Likewise a number.
void write_attribute(hid_t object, const std::string& name, double value);
void write_attribute(hid_t object, const std::string& name, std::int64_t value);

/// The text of an attribute of fixed length.
std::string attribute_text(hid_t object, const std::string& name);
/// Whether there is an object of this path.
bool has_path(hid_t file, const std::string& path);
/// Names of what a group holds, ascending.
std::vector<std::string> links_of(hid_t file, const std::string& group);
/// Of a dataset; `what` is for the message.
std::vector<hsize_t> shape_of(hid_t dataset, const std::string& what);

/// The two attributes that every dataset carries: SI unit ("1" for a ratio) and one line for people.
void describe_dataset(hid_t dataset, const std::string& units, const std::string& description);

/// Creates a dataset and the groups on its way. `chunk` empty: contiguous; else chunked. Shapes as HDF5 wants
/// them.
Hdf5Dataset create_dataset(hid_t file, const std::string& path, hid_t type, const std::vector<hsize_t>& shape,
                           const std::vector<hsize_t>& largest = {}, const std::vector<hsize_t>& chunk = {});

}  // namespace slipscale
