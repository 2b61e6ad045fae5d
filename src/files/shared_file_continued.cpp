#include "slipscale/base/error.hpp"
#include "slipscale/files/continued_file.hpp"
#include "slipscale/files/shared_file.hpp"

namespace slipscale {

void SharedFile::examine(const std::function<void(hid_t file)>& look) const {
  std::string fault;
  try {
    if (root_) look(file_);
  } catch (const LibraryError& error) {
    fault = continuation_fault(path_, error.what());
  }
  throw_together(comm_, fault);
}

void SharedFile::change(const std::function<void(hid_t file)>& action) {
  on_root([&] { action(file_); });
}

void SharedFile::end_changes() {
  flush();
  on_root([&] { let_data_through(file_); });
}

std::vector<double> SharedFile::read_series(const DatasetDescription& about, std::size_t count) const {
  std::vector<double> values(count);
  examine([&](hid_t file) {
    const Hdf5Dataset series = expect_series(file, about.path, H5T_IEEE_F64LE, {}, count, about.units);
    if (count == 0) return;
    const hsize_t start = 0, rows = count;
    const Hdf5Space source(hdf5(H5Dget_space(series), about.path)),
        target(hdf5(H5Screate_simple(1, &rows, nullptr), about.path));
    hdf5(H5Sselect_hyperslab(source, H5S_SELECT_SET, &start, nullptr, &rows, nullptr), about.path);
    hdf5(H5Dread(series, H5T_NATIVE_DOUBLE, target, source, H5P_DEFAULT, values.data()), about.path);
  });
  MPI_Bcast(values.data(), static_cast<int>(count), MPI_DOUBLE, 0, comm_);
  return values;
}

void SharedFile::cut_series(const std::string& series, std::size_t count) {
  on_root([&] {
    const Hdf5Dataset dataset(hdf5(H5Dopen2(file_, series.c_str(), H5P_DEFAULT), series));
    const hsize_t rows = count;
    hdf5(H5Dset_extent(dataset, &rows), series);
  });
}

}  // namespace slipscale
