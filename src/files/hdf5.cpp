#include "slipscale/files/hdf5.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "journaled_driver.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/provenance.hpp"

namespace slipscale {
namespace {

/// The first entry on the way up from the cause to the call.
herr_t take_innermost(unsigned depth, const H5E_error2_t* entry, void* text) {
  if (depth == 0 && entry->desc) *static_cast<std::string*>(text) = entry->desc;
  return 0;
}

Hdf5Type text_type(std::size_t length) {
  Hdf5Type type(hdf5(H5Tcopy(H5T_C_S1), "cannot make a text type"));
  hdf5(H5Tset_size(type, std::max<std::size_t>(length, 1)), "cannot size a text type");
  hdf5(H5Tset_cset(type, H5T_CSET_UTF8), "cannot make a text type UTF-8");
  hdf5(H5Tset_strpad(type, H5T_STR_NULLPAD), "cannot pad a text type");
  return type;
}

void write_value(hid_t object, const std::string& name, hid_t type, hid_t space, const void* value) {
  const std::string what = "cannot write the attribute '" + name + "'";
  Hdf5Attribute attribute(
      hdf5(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), what));
  hdf5(H5Awrite(attribute, type, value), what);
}

}  // namespace

void keep_hdf5_messages() { (void)H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

namespace {

Hdf5Properties without_locking() {
  Hdf5Properties access(hdf5(H5Pcreate(H5P_FILE_ACCESS), "cannot prepare the file"));
  hdf5(H5Pset_file_locking(access, 0, 1), "cannot turn file locking off");
  return access;
}

Hdf5Properties journaled() {
  Hdf5Properties access = without_locking();
  use_journaled_driver(access);
  return access;
}

}  // namespace

std::string partial_path(const std::string& path) { return path + ".partial"; }

Hdf5File create_file(const std::string& path) {
  Hdf5File file(hdf5(H5Fcreate(partial_path(path).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, journaled()),
                     "cannot create the file"));
  write_provenance(file);
  return file;
}

void publish_file(hid_t file, const std::string& path) {
  (void)unlink(Journal::path(path).c_str());  // of an older one
  if (std::rename(partial_path(path).c_str(), path.c_str()) != 0) throw LibraryError(std::strerror(errno));
  if (JournaledFile* const found = journaled_file(file)) found->publish(path);
}

Hdf5File open_file(const std::string& path) {
  return Hdf5File(hdf5(H5Fopen(path.c_str(), H5F_ACC_RDONLY, without_locking()), "opening"));
}

Hdf5File open_file_to_write(const std::string& path) {
  return Hdf5File(hdf5(H5Fopen(path.c_str(), H5F_ACC_RDWR, journaled()), "opening"));
}

void recover_file(const std::string& path, bool to_write) { JournaledFile::recover(path, to_write); }

void check_written(hid_t file, const std::string& what) {
  const JournaledFile* const found = journaled_file(file);
  if (found && !found->failure()->empty())
    throw LibraryError((what.empty() ? "" : what + ": ") + *found->failure());
}

void abandon_file(hid_t file) {
  if (JournaledFile* const found = journaled_file(file)) found->abandon();
}

void close_file(Hdf5File& file) {
  const JournaledFile* const found = journaled_file(file);
  const auto failure = found ? found->failure() : std::make_shared<const std::string>();
  if (file.close() < 0) throw LibraryError(hdf5_message());
  if (!failure->empty()) throw LibraryError(*failure);
}

void write_provenance(hid_t file) {
  const Provenance from = provenance();
  write_attribute(file, "program", from.program);
  write_attribute(file, "version", from.version);
  if (!from.commit.empty()) write_attribute(file, "commit", from.commit);
  write_attribute(file, "date", from.date);
  write_attribute(file, "ranks", static_cast<std::int64_t>(from.ranks));
}

std::string checksum_text(std::uint64_t checksum) {
  return format("fnv1a:{:016x}", static_cast<unsigned long long>(checksum));
}

std::string hdf5_message() {
  std::string text;
  (void)H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_innermost, &text);
  // File drivers bury the system's words: "file write failed: time = …, errno = 28, error message = '…', buf
  // = …".
  const std::string marker = "error message = '";
  const auto begin = text.find(marker);
  if (begin == std::string::npos) return text.empty() ? "unknown failure" : text;
  const auto end = text.find('\'', begin + marker.size());
  return text.substr(begin + marker.size(), end - begin - marker.size());
}

hid_t hdf5(hid_t result, const std::string& what) {
  if (result < 0) throw LibraryError(what + ": " + hdf5_message());
  return result;
}

void write_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Hdf5Type type = text_type(value.size());
  const Hdf5Space scalar(hdf5(H5Screate(H5S_SCALAR), "cannot make a data space"));
  const std::string text = value.empty() ? std::string(1, '\0') : value;
  write_value(object, name, type, scalar, text.data());
}

void write_attribute(hid_t object, const std::string& name, const std::vector<std::string>& values) {
  std::size_t longest = 1;
  for (const auto& value : values) longest = std::max(longest, value.size());
  std::string texts;
  for (const auto& value : values) texts += value + std::string(longest - value.size(), '\0');
  const Hdf5Type type = text_type(longest);
  const hsize_t count = values.size();
  const Hdf5Space list(hdf5(H5Screate_simple(1, &count, nullptr), "cannot make a data space"));
  write_value(object, name, type, list, texts.data());
}

void write_attribute(hid_t object, const std::string& name, double value) {
  const Hdf5Space scalar(hdf5(H5Screate(H5S_SCALAR), "cannot make a data space"));
  write_value(object, name, H5T_NATIVE_DOUBLE, scalar, &value);
}

void write_attribute(hid_t object, const std::string& name, std::int64_t value) {
  const Hdf5Space scalar(hdf5(H5Screate(H5S_SCALAR), "cannot make a data space"));
  write_value(object, name, H5T_NATIVE_INT64, scalar, &value);
}

std::string attribute_text(hid_t object, const std::string& name) {
  const std::string what = "the attribute '" + name + "'";
  const Hdf5Attribute attribute(hdf5(H5Aopen(object, name.c_str(), H5P_DEFAULT), what));
  const Hdf5Type type(hdf5(H5Aget_type(attribute), what));
  const Hdf5Space space(hdf5(H5Aget_space(attribute), what));
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 ||
      H5Sget_simple_extent_npoints(space) != 1)
    throw LibraryError(what + " is not a text of fixed length");
  std::string text(H5Tget_size(type), '\0');
  hdf5(H5Aread(attribute, type, text.data()), what);
  return text.substr(0, text.find('\0'));
}

bool has_path(hid_t file, const std::string& path) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    if (H5Lexists(file, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::vector<std::string> links_of(hid_t file, const std::string& group) {
  std::vector<std::string> names;
  const auto take = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  hdf5(
      H5Literate_by_name(file, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, take, &names, H5P_DEFAULT),
      group);
  return names;
}

std::vector<hsize_t> shape_of(hid_t dataset, const std::string& what) {
  const Hdf5Space space(hdf5(H5Dget_space(dataset), what));
  std::vector<hsize_t> shape(static_cast<std::size_t>(hdf5(H5Sget_simple_extent_ndims(space), what)));
  hdf5(H5Sget_simple_extent_dims(space, shape.data(), nullptr), what);
  return shape;
}

void describe_dataset(hid_t dataset, const std::string& units, const std::string& description) {
  write_attribute(dataset, "units", units);
  write_attribute(dataset, "description", description);
}

Hdf5Dataset create_dataset(hid_t file, const std::string& path, hid_t type, const std::vector<hsize_t>& shape,
                           const std::vector<hsize_t>& largest, const std::vector<hsize_t>& chunk) {
  const std::string what = "cannot create the dataset '" + path + "'";
  const int rank = static_cast<int>(shape.size());
  const Hdf5Space space(
      hdf5(H5Screate_simple(rank, shape.data(), largest.empty() ? nullptr : largest.data()), what));
  const Hdf5Properties links(hdf5(H5Pcreate(H5P_LINK_CREATE), what));
  hdf5(H5Pset_create_intermediate_group(links, 1), what);
  const Hdf5Properties creation(hdf5(H5Pcreate(H5P_DATASET_CREATE), what));
  if (!chunk.empty()) hdf5(H5Pset_chunk(creation, rank, chunk.data()), what);
  return Hdf5Dataset(hdf5(H5Dcreate2(file, path.c_str(), type, space, links, creation, H5P_DEFAULT), what));
}

}  // namespace slipscale
