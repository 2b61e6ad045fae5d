#pragma once

#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "slipscale/files/hdf5.hpp"

/// HDF5 files as a reader without slipscale would see them.
namespace slipscale::read_back {

struct Dataset {
  std::vector<hsize_t> shape;
  std::vector<double> values;
  std::string units, description;
};

inline Hdf5File open(const std::string& path) {
  return Hdf5File(hdf5(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "opening " + path));
}

inline std::string attribute(hid_t object, const std::string& name) {
  const Hdf5Attribute attribute(hdf5(H5Aopen(object, name.c_str(), H5P_DEFAULT), name));
  const Hdf5Type type(hdf5(H5Aget_type(attribute), name));
  const Hdf5Space space(hdf5(H5Aget_space(attribute), name));
  const auto texts = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  std::string text(texts * H5Tget_size(type), '\0');
  hdf5(H5Aread(attribute, type, text.data()), name);
  std::string joined;
  for (std::size_t k = 0; k < texts; ++k) {
    if (k > 0) joined += ",";
    joined += text.substr(k * H5Tget_size(type), H5Tget_size(type)).c_str();
  }
  return joined;
}

inline Dataset dataset(hid_t file, const std::string& path) {
  Dataset read;
  const Hdf5Dataset set(hdf5(H5Dopen2(file, path.c_str(), H5P_DEFAULT), path));
  const Hdf5Space space(hdf5(H5Dget_space(set), path));
  read.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, read.shape.data(), nullptr);
  read.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  hdf5(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.values.data()), path);
  read.units = attribute(set, "units");
  read.description = attribute(set, "description");
  return read;
}

inline herr_t collect_name(hid_t, const char* name, const H5O_info_t* info, void* into) {
  if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(into)->emplace_back(name);
  return 0;
}

/// Every dataset of a file by its path. Read after the names are known: an exception must not pass through
/// HDF5, which would keep the file open, and show it for ever as it was.
inline std::map<std::string, Dataset> everything(const std::string& path) {
  std::vector<std::string> names;
  std::map<std::string, Dataset> all;
  const Hdf5File file = open(path);
  hdf5(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, collect_name, &names, H5O_INFO_BASIC), path);
  for (const std::string& name : names) all[name] = dataset(file, name);
  return all;
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

/// A disk that is full after `bytes` of each file, for this process and for the life of this object.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);  // writing then fails with EFBIG, as it would with ENOSPC
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace slipscale::read_back
