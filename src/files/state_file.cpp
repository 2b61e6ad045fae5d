#include "slipscale/files/state_file.hpp"

#include <algorithm>
#include <numeric>

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/mesh/ordered_gather.hpp"

namespace slipscale {
namespace {

constexpr hsize_t piece_bytes = 4 << 20;
constexpr double dataset_bytes = 1024;  ///< header and attributes

std::string path_of(const StateGroup& group, const std::string& array) {
  return "/" + group.name + "/" + array;
}

std::vector<PetscInt> kept_keys(const StateGroup& group) {
  return group.keeps ? group.keys : std::vector<PetscInt>{};
}

std::size_t rows_of(const StateGroup& group) { return group.keeps ? group.keys.size() : 0; }

void write_few(MPI_Comm comm, SharedFile& file, const StateGroup& group) {
  const OrderedGather gather(comm, kept_keys(group));
  unsigned long long rows = static_cast<unsigned long long>(gather.count());
  MPI_Bcast(&rows, 1, MPI_UNSIGNED_LONG_LONG, 0, comm);
  file.write({path_of(group, "keys"), "1", "whose the rows are"}, slice_of_root(comm, {rows}), index_type(),
             gather.keys().data());
  for (const StateArray& array : group.arrays) {
    const auto width = static_cast<std::size_t>(array.width);
    const auto all = gather({array.values, rows_of(group) * width}, array.width);
    file.write({path_of(group, array.name), array.units, array.text}, slice_of_root(comm, {rows, width}),
               H5T_NATIVE_DOUBLE, all.data());
  }
}

/// Where the rows of this rank stand in a list of keys; −1 for those that it lacks.
std::vector<long> places_of(const std::vector<PetscInt>& keys, const std::vector<PetscInt>& list) {
  std::vector<long> places;
  for (const PetscInt key : keys) {
    const auto found = std::lower_bound(list.begin(), list.end(), key);
    places.push_back(found != list.end() && *found == key ? found - list.begin() : -1);
  }
  return places;
}

class Reader {
 public:
  Reader(MPI_Comm comm, hid_t file, const std::string& path) : comm_(comm), file_(file), path_(path) {}

  /// The keys of a group's rows, ascending, on all ranks.
  std::vector<PetscInt> keys(const StateGroup& group) const {
    unsigned long long rows = 0;
    std::vector<PetscInt> found;
    on_root([&] {
      const std::string what = path_of(group, "keys");
      const Hdf5Dataset dataset(hdf5(H5Dopen2(file_, what.c_str(), H5P_DEFAULT), what));
      const Hdf5Space space(hdf5(H5Dget_space(dataset), what));
      found.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
      hdf5(H5Dread(dataset, index_type(), H5S_ALL, H5S_ALL, H5P_DEFAULT, found.data()), what);
      rows = found.size();
    });
    MPI_Bcast(&rows, 1, MPI_UNSIGNED_LONG_LONG, 0, comm_);
    found.resize(rows);
    MPI_Bcast(found.data(), static_cast<int>(rows), MPIU_INT, 0, comm_);
    return found;
  }

  /// Brings rows `places` of a dataset of `rows` rows to `array`, a few MiB at a time.
  void read(const StateGroup& group, const StateArray& array, hsize_t rows,
            const std::vector<long>& places) const {
    const std::string what = path_of(group, array.name);
    const auto width = static_cast<hsize_t>(array.width);
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::size_t k) { return places[k]; });
    Hdf5Dataset dataset;
    on_root([&] {
      dataset = Hdf5Dataset(hdf5(H5Dopen2(file_, what.c_str(), H5P_DEFAULT), what));
      const Hdf5Space space(hdf5(H5Dget_space(dataset), what));
      hsize_t shape[2] = {0, 0};
      if (H5Sget_simple_extent_ndims(space) != 2 || H5Sget_simple_extent_dims(space, shape, nullptr) < 0 ||
          shape[0] != rows || shape[1] != width)
        throw LibraryError(what + ": has another shape than this scene's");
    });
    const hsize_t most = std::max<hsize_t>(1, piece_bytes / (width * sizeof(double)));
    std::vector<double> piece;
    auto next = order.begin();
    for (hsize_t begin = 0; begin < rows; begin += most) {
      const hsize_t count = std::min(most, rows - begin);
      piece.resize(count * width);
      on_root([&] { read_piece(dataset, begin, count, width, piece.data(), what); });
      MPI_Bcast(piece.data(), static_cast<int>(piece.size()), MPI_DOUBLE, 0, comm_);
      for (; next != order.end() && places[*next] < static_cast<long>(begin + count); ++next)
        std::copy_n(&piece[(static_cast<hsize_t>(places[*next]) - begin) * width], width,
                    array.values + *next * width);
    }
  }

  void refuse_unless(bool complete, const StateGroup& group) const {
    throw_together(comm_, complete ? ""
                                   : "'" + path_ + "' lacks rows of /" + group.name +
                                         ": it belongs to another scene; start the run anew");
  }

 private:
  static void read_piece(hid_t dataset, hsize_t begin, hsize_t count, hsize_t width, double* to,
                         const std::string& what) {
    const hsize_t start[2] = {begin, 0}, size[2] = {count, width};
    const Hdf5Space from(hdf5(H5Dget_space(dataset), what)), memory(H5Screate_simple(2, size, nullptr));
    hdf5(H5Sselect_hyperslab(from, H5S_SELECT_SET, start, nullptr, size, nullptr), what);
    hdf5(H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, from, H5P_DEFAULT, to), what);
  }

  template <class Action>
  void on_root(Action&& action) const {
    std::string fault;
    if (is_root(comm_)) try {
        action();
      } catch (const LibraryError& error) {
        fault = "'" + path_ + "' cannot be read: " + error.what() + "; start the run anew";
      }
    throw_together(comm_, fault);
  }

  MPI_Comm comm_;
  hid_t file_;
  const std::string& path_;
};

}  // namespace

void write_state(MPI_Comm comm, SharedFile& file, const std::vector<StateGroup>& groups) {
  for (const StateGroup& group : groups) {
    if (group.total == 0) {
      write_few(comm, file, group);
      continue;
    }
    const FileOrder order(comm, group.total, group.keys);
    for (const StateArray& array : group.arrays)
      file.write({path_of(group, array.name), array.units, array.text}, order,
                 {static_cast<hsize_t>(array.width)}, array.values);
  }
}

double state_bytes(MPI_Comm comm, const std::vector<StateGroup>& groups) {
  double bytes = 0;
  for (const StateGroup& group : groups) {
    double width = 0;
    for (const StateArray& array : group.arrays) width += array.width;
    bytes += sizeof(double) * width * static_cast<double>(rows_of(group));
  }
  MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_SUM, comm);
  for (const StateGroup& group : groups)
    bytes += dataset_bytes * static_cast<double>(group.arrays.size() + 1);
  return bytes;
}

void read_state(MPI_Comm comm, hid_t file, const std::string& path, std::vector<StateGroup>& groups) {
  const Reader reader(comm, file, path);
  for (StateGroup& group : groups) {
    std::vector<long> places(group.keys.begin(), group.keys.end());
    hsize_t rows = static_cast<hsize_t>(group.total);
    if (group.total == 0) {
      const auto keys = reader.keys(group);
      rows = keys.size();
      places = places_of(group.keys, keys);
      reader.refuse_unless(std::ranges::all_of(places, [](long at) { return at >= 0; }), group);
    }
    for (const StateArray& array : group.arrays) reader.read(group, array, rows, places);
  }
}

}  // namespace slipscale
