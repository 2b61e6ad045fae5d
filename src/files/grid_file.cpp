#include "slipscale/files/grid_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>
#include <span>

#include "object_header.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr int xdmf_triangle = 4, xdmf_quadrilateral = 5;

void require(bool fine, const std::string& path, const char* fault) {
  if (!fine) throw LibraryError(path + " " + fault);
}

Hdf5Dataset open(hid_t file, const std::string& path) {
  return Hdf5Dataset(hdf5(H5Dopen2(file, path.c_str(), H5P_DEFAULT), path));
}

/// As a double: what a damaged file declares may be more than a whole number can be.
double entries(const std::vector<hsize_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), 1.0, std::multiplies<>());
}

/// How many numbers the dataset has; refused where the file cannot hold what it declares, before any memory
/// is asked for. (Nothing of zlib's packs tighter than 1032 : 1.)
std::size_t stored_entries(hid_t dataset, const std::string& path, bool of_whole_numbers = false) {
  const double count = entries(shape_of(dataset, path));
  const Hdf5Type type(hdf5(H5Dget_type(dataset), path));
  const H5T_class_t kind = H5Tget_class(type);
  require(kind == H5T_INTEGER || (kind == H5T_FLOAT && !of_whole_numbers), path,
          of_whole_numbers ? "does not hold whole numbers" : "does not hold numbers");
  const std::size_t size = H5Tget_size(type);
  require(size > 0, path, "has a type that cannot be read");
  const double declared = count * static_cast<double>(size);
  const double stored = static_cast<double>(H5Dget_storage_size(dataset));
  require(declared <= 1032 * stored, path, "declares more numbers than the file holds");
  require(chunks_are_sound(dataset), path, "is damaged");
  return static_cast<std::size_t>(count);
}

void refuse_non_finite(std::span<const double> values, const std::string& path) {
  require(std::ranges::all_of(values, [](double value) { return std::isfinite(value); }), path,
          "has an entry that is not a finite number");
}

/// XDMF's mixed stream: of each cell its code before its points.
void unpack_stream(const std::vector<int>& stream, PlaneGrid& grid) {
  for (std::size_t k = 0; k < stream.size();) {
    const int code = stream[k++];
    require(code == xdmf_triangle || code == xdmf_quadrilateral, "/mesh/cells",
            "has a cell that is neither triangle nor quadrilateral");
    const std::size_t count = code == xdmf_triangle ? 3 : 4;
    require(k + count <= stream.size(), "/mesh/cells", "ends within a cell");
    grid.corners.insert(grid.corners.end(), stream.begin() + static_cast<std::ptrdiff_t>(k),
                        stream.begin() + static_cast<std::ptrdiff_t>(k + count));
    grid.first.push_back(static_cast<int>(grid.corners.size()));
    k += count;
  }
}

/// In UTF-8, without control characters.
bool is_text(const std::string& word) {
  int expected = 0;  // continuation bytes
  for (const char letter : word) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool continues = (byte & 0xc0) == 0x80;
    if (continues != (expected > 0) || byte < 0x20 || byte == 0x7f || byte >= 0xf8) return false;
    expected = continues ? expected - 1 : byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : byte >= 0xc0 ? 1 : 0;
  }
  return expected == 0;
}

bool all_within(const std::vector<int>& numbers, std::size_t count) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [&](int n) { return n >= 0 && static_cast<std::size_t>(n) < count; });
}

}  // namespace

GridFile::GridFile(MPI_Comm comm, GridFileSource source) : comm_(comm), source_(std::move(source)) {
  namespace fs = std::filesystem;
  keep_hdf5_messages();
  std::error_code ignored;
  if (fs::is_directory(source_.path, ignored)) source_.path += "/" + source_.name;
  std::string fault;
  if (is_root(comm_)) recover_file(path());
  if (!fs::exists(source_.path, ignored))
    fault = format("there is no file '{}' (-{}); {}", path(), source_.option, source_.cure);
  else if (H5Fis_hdf5(path().c_str()) <= 0)
    fault =
        format("'{}' (-{}) is not an HDF5 file or cannot be read; {}", path(), source_.option, source_.cure);
  throw_together(comm_, fault);
  together([&] { file_ = open_file(path()); });
}

void GridFile::together(const std::function<void()>& read) const {
  std::string fault;
  try {
    read();
  } catch (const LibraryError& error) {
    fault = format("'{}' (-{}) is damaged or incomplete: {}; {}", path(), source_.option, error.what(),
                   source_.cure);
  }
  throw_together(comm_, fault);
}

void GridFile::refuse_unless(bool fine, const std::string& fault, const std::string& cure) const {
  throw_together(comm_, fine ? "" : format("'{}' (-{}) {}; {}", path(), source_.option, fault, cure));
}

bool GridFile::has(const std::string& dataset) const { return has_path(file_, dataset); }

bool GridFile::has_attribute(const std::string& object, const std::string& attribute) const {
  return H5Aexists_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT) > 0;
}

PlaneGrid GridFile::grid() const {
  PlaneGrid grid;
  for (const char* dataset : {"/mesh/coordinates", "/mesh/cells", "/mesh/region"})
    refuse_unless(has(dataset), format("has no {}, so it is not a {}", dataset, source_.name));
  together([&] { read_mesh(grid); });
  return grid;
}

void GridFile::read_mesh(PlaneGrid& grid) const {
  const std::vector<double> x = reals("/mesh/coordinates");
  const auto place = shape("/mesh/coordinates"), cells = shape("/mesh/cells");
  require(place.size() == 2 && place[1] == 2, "/mesh/coordinates", "is not a list of x and y");
  for (std::size_t k = 0; k < x.size(); k += 2) grid.points.push_back({x[k], x[k + 1]});
  grid.region = integers("/mesh/region");
  grid.regions = texts("/mesh/region", "names");
  require(std::ranges::all_of(grid.regions, is_text), "/mesh/region's attribute names",
          "is no list of texts");
  require(std::set<std::string>(grid.regions.begin(), grid.regions.end()).size() == grid.regions.size(),
          "/mesh/region's attribute names", "has a name twice");
  if (cells.size() == 1) {
    unpack_stream(integers("/mesh/cells"), grid);
  } else {
    require(cells.size() == 2 && (cells[1] == 3 || cells[1] == 4), "/mesh/cells", "has an unknown shape");
    grid.corners = integers("/mesh/cells");
    for (hsize_t cell = 1; cell <= cells[0]; ++cell) grid.first.push_back(static_cast<int>(cell * cells[1]));
  }
  require(!grid.region.empty() && grid.first.size() == grid.region.size() + 1, "/mesh/region",
          "has not as many entries as there are cells");
  require(all_within(grid.corners, grid.points.size()), "/mesh/cells", "names a point that is not there");
  require(all_within(grid.region, grid.regions.size()), "/mesh/region", "has a region without name");
  const Box box = bounding_box(grid);
  const double least = 1e-15 * box.extent(0) * box.extent(1);  // of a cell: none is a line or turned over
  require(least > 0, "/mesh/coordinates", "puts all points on a line");
  double total = 0;
  for (const double part : areas(grid)) {
    require(part > least, "/mesh/cells", "has a cell without area, or clockwise");
    total += part;
  }
  require(total < 1.001 * box.extent(0) * box.extent(1), "/mesh/cells", "has cells that overlap");
}

std::vector<hsize_t> GridFile::shape(const std::string& dataset) const {
  return shape_of(open(file_, dataset), dataset);
}

std::vector<double> GridFile::reals(const std::string& dataset) const {
  const Hdf5Dataset set = open(file_, dataset);
  std::vector<double> values(stored_entries(set, dataset));
  hdf5(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), dataset);
  refuse_non_finite(values, dataset);
  return values;
}

std::vector<int> GridFile::integers(const std::string& dataset) const {
  const Hdf5Dataset set = open(file_, dataset);
  std::vector<int> values(stored_entries(set, dataset, true));
  hdf5(H5Dread(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), dataset);
  return values;
}

void GridFile::read_rows(const std::string& dataset, hsize_t rows, hsize_t width, hsize_t begin,
                         hsize_t count, double* to) const {
  const Hdf5Dataset set = open(file_, dataset);
  const auto found = shape_of(set, dataset);
  (void)stored_entries(set, dataset);
  require(!found.empty() && found[0] == rows && entries(found) == static_cast<double>(rows * width), dataset,
          "does not have one row for each cell or point");
  std::vector<hsize_t> start(found.size(), 0), size(found);
  start[0] = begin;
  size[0] = count;
  const Hdf5Space source(hdf5(H5Dget_space(set), dataset));
  const Hdf5Space target(
      hdf5(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), dataset));
  if (count == 0) return;
  hdf5(H5Sselect_hyperslab(source, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), dataset);
  hdf5(H5Dread(set, H5T_NATIVE_DOUBLE, target, source, H5P_DEFAULT, to), dataset);
  refuse_non_finite({to, static_cast<std::size_t>(count * width)}, dataset);
}

double GridFile::number(const std::string& object, const std::string& attribute) const {
  double value = 0;
  const std::string what = object + "'s attribute " + attribute;
  const Hdf5Attribute found(
      hdf5(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), what));
  const Hdf5Space space(hdf5(H5Aget_space(found), what));
  const Hdf5Type type(hdf5(H5Aget_type(found), what));
  const H5T_class_t kind = H5Tget_class(type);
  require(H5Sget_simple_extent_npoints(space) == 1 && (kind == H5T_FLOAT || kind == H5T_INTEGER), what,
          "is not one number");
  hdf5(H5Aread(found, H5T_NATIVE_DOUBLE, &value), what);
  require(std::isfinite(value), what, "is not a finite number");
  return value;
}

std::vector<std::string> GridFile::texts(const std::string& object, const std::string& attribute) const {
  const std::string what = object + "'s attribute " + attribute;
  const Hdf5Attribute found(
      hdf5(H5Aopen_by_name(file_, object.c_str(), attribute.c_str(), H5P_DEFAULT, H5P_DEFAULT), what));
  const Hdf5Type type(hdf5(H5Aget_type(found), what));
  const Hdf5Space space(hdf5(H5Aget_space(found), what));
  require(H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) <= 0, what,
          "is not a text of fixed length");
  const auto count = static_cast<std::size_t>(hdf5(H5Sget_simple_extent_npoints(space), what));
  const std::size_t length = H5Tget_size(type);
  require(length > 0 && count > 0, what, "is empty");
  std::string all(count * length, '\0');
  hdf5(H5Aread(found, type, all.data()), what);
  std::vector<std::string> list;
  for (std::size_t k = 0; k < count; ++k) list.emplace_back(all.substr(k * length, length).c_str());
  return list;
}

}  // namespace slipscale
