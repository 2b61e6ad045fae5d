#include "slipscale/files/continued_file.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <functional>
#include <numeric>

#include "global_heap.hpp"
#include "object_header.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/provenance.hpp"

namespace slipscale {
namespace {

void require(bool fine, const std::string& fault) {
  if (!fine) throw LibraryError(fault);
}

std::string text_of(const std::vector<hsize_t>& shape) {
  std::string text;
  for (const hsize_t n : shape) text += (text.empty() ? "" : " x ") + std::to_string(n);
  return text.empty() ? "one number" : text;
}

/// Rows that are declared and nothing else would take minutes to read, or to cut off.
void expect_held(hid_t dataset, const std::string& path, const std::vector<hsize_t>& shape, hid_t type) {
  const double bytes = std::accumulate(shape.begin(), shape.end(), static_cast<double>(H5Tget_size(type)),
                                       std::multiplies<>());
  require(bytes <= static_cast<double>(H5Dget_storage_size(dataset)),
          format("'{}' declares {} rows, more than it holds", path, shape[0]));
  require(chunks_are_sound(dataset), format("'{}' is damaged", path));
}

}  // namespace

std::string continuation_fault(const std::string& path, const std::string& fault) {
  return "'" + path + "' cannot be continued: " + fault +
         "; put back the file that the interrupted run left, or start the run anew";
}

Hdf5File open_to_continue(const std::string& path) {
  std::error_code error;
  require(std::filesystem::exists(path, error), "it is not there");
  recover_file(path, true);
  require(H5Fis_hdf5(path.c_str()) > 0, "it is no HDF5 file or damaged");
  require(global_heaps_are_sound(path), "it is cut short or damaged");
  const auto look = [](hid_t, const char*, const H5O_info_t*, void*) -> herr_t { return 0; };
  Hdf5File file;
  try {
    // Only to read: HDF5 overlooks damage in a file that it may write in.
    require(H5Ovisit2(open_file(path), H5_INDEX_NAME, H5_ITER_NATIVE, look, nullptr, H5O_INFO_ALL) >= 0, "");
    file = open_file_to_write(path);
  } catch (const LibraryError&) {  // in words of HDF5's inside
    throw LibraryError("it is cut short or damaged");
  }
  expect_text(file, "program", provenance().program);
  return file;
}

void expect_text(hid_t object, const std::string& name, const std::string& text) {
  const std::string found = attribute_text(object, name);
  require(found == text, format("its {} is '{}' and not '{}'", name, found, text));
}

Hdf5Dataset expect_dataset(hid_t file, const std::string& path, hid_t type, const std::vector<hsize_t>& shape,
                           const std::string& units) {
  require(has_path(file, path), format("it has no '{}'", path));
  Hdf5Dataset dataset(hdf5(H5Dopen2(file, path.c_str(), H5P_DEFAULT), path));
  const Hdf5Type found(hdf5(H5Dget_type(dataset), path));
  require(H5Tequal(found, type) > 0, format("'{}' has another type of number", path));
  auto there = shape_of(dataset, path), wanted = shape;
  if (!wanted.empty() && wanted[0] == any_rows && !there.empty()) wanted[0] = there[0];
  require(there == wanted, format("'{}' has the shape {} and not {}", path, text_of(there), text_of(wanted)));
  const std::string unit = attribute_text(dataset, "units");
  require(unit == units, format("'{}' is in {} and not in {}", path, unit, units));
  return dataset;
}

void expect_values(hid_t file, const std::string& path, const std::vector<hsize_t>& shape,
                   const std::string& units, const double* values) {
  const Hdf5Dataset dataset = expect_dataset(file, path, H5T_IEEE_F64LE, shape, units);
  std::vector<double> there(std::accumulate(shape.begin(), shape.end(), hsize_t{1}, std::multiplies<>()));
  hdf5(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, there.data()), path);
  require(std::memcmp(there.data(), values, there.size() * sizeof(double)) == 0,
          format("'{}' has other values", path));
}

Hdf5Dataset expect_series(hid_t file, const std::string& path, hid_t type,
                          const std::vector<hsize_t>& row_shape, hsize_t rows, const std::string& units) {
  std::vector<hsize_t> shape{any_rows};
  shape.insert(shape.end(), row_shape.begin(), row_shape.end());
  Hdf5Dataset dataset = expect_dataset(file, path, type, shape, units);
  const hsize_t there = shape_of(dataset, path)[0];
  require(there >= rows, format("'{}' has {} of the {} rows that were written", path, there, rows));
  const Hdf5Properties creation(hdf5(H5Dget_create_plist(dataset), path));
  require(H5Pget_layout(creation) == H5D_CHUNKED, format("'{}' cannot grow", path));
  shape[0] = there;
  expect_held(dataset, path, shape, type);
  return dataset;
}

ContentChecksum content_begun(const std::string& path, const std::vector<hsize_t>& shape) {
  ContentChecksum content;
  content.add(path.data(), path.size());
  content.add(shape.data(), shape.size() * sizeof(hsize_t));
  return content;
}

std::uint64_t contents_of_view(hid_t view, const std::string& path) {
  const Hdf5Properties creation(hdf5(H5Dget_create_plist(view), path));
  double elsewhere = 0;  // what entries are that nothing fills
  std::size_t count = 0;
  hdf5(H5Pget_fill_value(creation, H5T_NATIVE_DOUBLE, &elsewhere), path);
  hdf5(H5Pget_virtual_count(creation, &count), path);
  ContentChecksum content = content_begun(path, shape_of(view, path));
  const Hdf5Type type(hdf5(H5Dget_type(view), path));
  std::size_t size = 0;
  hdf5(H5Tencode(type, nullptr, &size), path);
  std::vector<std::byte> encoded(size);
  hdf5(H5Tencode(type, encoded.data(), &size), path);
  content.add(encoded.data(), encoded.size());
  content.add(&elsewhere, sizeof elsewhere);
  for (std::size_t k = 0; k < count; ++k) {
    std::array<char, 256> file{}, dataset{};
    hdf5(static_cast<hid_t>(H5Pget_virtual_filename(creation, k, file.data(), file.size())), path);
    hdf5(static_cast<hid_t>(H5Pget_virtual_dsetname(creation, k, dataset.data(), dataset.size())), path);
    content.add(file.data(), file.size());
    content.add(dataset.data(), dataset.size());
    for (const auto space_of : {H5Pget_virtual_vspace, H5Pget_virtual_srcspace}) {
      const Hdf5Space space(hdf5(space_of(creation, k), path));
      std::array<hsize_t, H5S_MAX_RANK> first{}, last{};
      hdf5(H5Sget_select_bounds(space, first.data(), last.data()), path);
      content.add(first.data(), sizeof first);
      content.add(last.data(), sizeof last);
    }
  }
  return content.value();
}

std::uint64_t contents_of(hid_t file, const std::string& group) {
  constexpr hsize_t piece_bytes = 4 << 20;
  std::uint64_t sum = 0;
  for (const std::string& name : links_of(file, group)) {
    const std::string path = group + "/" + name;
    const Hdf5Dataset dataset(hdf5(H5Dopen2(file, path.c_str(), H5P_DEFAULT), path));
    const Hdf5Properties creation(hdf5(H5Dget_create_plist(dataset), path));
    if (H5Pget_layout(creation) == H5D_VIRTUAL) {
      sum += contents_of_view(dataset, path);
      continue;
    }
    const Hdf5Type stored(hdf5(H5Dget_type(dataset), path)),
        type(hdf5(H5Tget_native_type(stored, H5T_DIR_ASCEND), path));
    const std::vector<hsize_t> shape = shape_of(dataset, path);
    ContentChecksum content = content_begun(path, shape);
    require(!shape.empty(), format("'{}' is a single number", path));
    expect_held(dataset, path, shape, type);
    const hsize_t row = std::accumulate(shape.begin() + 1, shape.end(), hsize_t{H5Tget_size(type)},
                                        std::multiplies<>()),
                  most = std::max<hsize_t>(1, piece_bytes / std::max<hsize_t>(row, 1));
    const Hdf5Space source(hdf5(H5Dget_space(dataset), path));
    std::vector<std::byte> piece;
    for (hsize_t begin = 0; begin < shape[0]; begin += most) {
      std::vector<hsize_t> start(shape.size(), 0), count(shape);
      start[0] = begin;
      count[0] = std::min(most, shape[0] - begin);
      piece.resize(count[0] * row);
      hdf5(H5Sselect_hyperslab(source, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), path);
      const Hdf5Space target(
          hdf5(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), path));
      hdf5(H5Dread(dataset, type, target, source, H5P_DEFAULT, piece.data()), path);
      content.add(piece.data(), piece.size());
    }
    sum += content.value();
  }
  return sum;
}

}  // namespace slipscale
