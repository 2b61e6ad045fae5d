#include "slipscale/record/fields_file.hpp"

#include <filesystem>
#include <sstream>

#include "disk_space.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/record/estimate.hpp"
#include "slipscale/record/output_folder.hpp"
#include "xdmf.hpp"

namespace slipscale {
namespace {

hid_t index_type() { return sizeof(PetscInt) == 8 ? H5T_NATIVE_INT64 : H5T_NATIVE_INT32; }

std::string frame_path(std::size_t frame) { return format("/frames/%05zu", frame); }

/// Runs what may fail on one rank alone, and lets all ranks fail with it.
template <class Action>
void together(MPI_Comm comm, const std::string& file, Action action) {
  std::string fault;
  try {
    action();
  } catch (const LibraryError& error) {
    fault = file + " cannot be written: " + error.what() +
            "; see that -output_folder is writable and its disk has room";
  }
  throw_together(comm, fault);
}

Hdf5File create_file(MPI_Comm comm, const std::string& path) {
  const Hdf5Properties access(hdf5(H5Pcreate(H5P_FILE_ACCESS), "preparing"));
  hdf5(H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL), "preparing");
  hdf5(H5Pset_coll_metadata_write(access, 1), "preparing");
  return Hdf5File(hdf5(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "creating"));
}

/// Writes rows [begin, begin + count) of an open dataset from all ranks at once. Collective.
void write_rows(hid_t dataset, hid_t type, hsize_t begin, hsize_t count, const void* rows,
                const std::string& what) {
  const Hdf5Space target(hdf5(H5Dget_space(dataset), what));
  std::vector<hsize_t> start(static_cast<std::size_t>(hdf5(H5Sget_simple_extent_ndims(target), what)), 0);
  std::vector<hsize_t> size(start.size());
  hdf5(H5Sget_simple_extent_dims(target, size.data(), nullptr), what);
  start[0] = begin;
  size[0] = count;
  const Hdf5Space source(hdf5(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), what));
  if (count > 0)
    hdf5(H5Sselect_hyperslab(target, H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), what);
  else
    hdf5(H5Sselect_none(target), what);
  const Hdf5Properties transfer(hdf5(H5Pcreate(H5P_DATASET_XFER), what));
  hdf5(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), what);
  hdf5(H5Dwrite(dataset, type, source, target, transfer, rows), what);
}

}  // namespace

FieldQuantities field_quantities(const std::string& list, const std::string& option) {
  FieldQuantities quantities{false, false, false};
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "u")
      quantities.u = true;
    else if (word == "v")
      quantities.v = true;
    else if (word == "stress")
      quantities.stress = true;
    else
      throw UserError("-" + option + " has '" + word + "'; give a list of u, v and stress, like u,stress");
  }
  return quantities;
}

FieldsFile::FieldsFile(MPI_Comm comm, const Mesh& mesh, const std::string& folder, FieldQuantities quantities)
    : comm_(comm), folder_(folder), quantities_(quantities), image_(comm, mesh) {
  keep_hdf5_messages();
  MPI_Comm_rank(comm, &rank_);
  together(comm_, path(), [&] { file_ = create_file(comm_, path()); });
  reserve(fields_bytes(0, image_.points().total(), image_.cells().total(), quantities_));
  write_mesh(mesh);
  together(comm_, path(), [&] {
    time_ = create_dataset(file_, "/time", H5T_IEEE_F64LE, {0}, {H5S_UNLIMITED}, {512});
    describe_dataset(time_, "s", "times of the frames");
  });
  together(comm_, path(), [&] { hdf5(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flushing"); });
}

std::string FieldsFile::path() const { return folder_ + "/fields.h5"; }

void FieldsFile::write_mesh(const Mesh& mesh) {
  const auto& points = image_.points();
  const auto& cells = image_.cells();
  write_slice({"/mesh/coordinates", "m", "positions of the points; x and y"}, points, 2, H5T_NATIVE_DOUBLE,
              image_.coordinates().data());

  const auto connectivity = image_.connectivity();
  const char* names[] = {
      "points of each triangle, counter-clockwise", "points of each quadrilateral, counter-clockwise",
      "XDMF's mixed stream: of each cell its code (4 triangle, 5 quadrilateral) and its points"};
  const Description about{"/mesh/cells", "1", names[static_cast<int>(image_.topology())]};
  hsize_t entries = connectivity.size(), before = 0;
  MPI_Exscan(&entries, &before, 1, MPI_UINT64_T, MPI_SUM, comm_);
  MPI_Allreduce(&entries, &stream_length_, 1, MPI_UINT64_T, MPI_SUM, comm_);
  if (image_.topology() == MeshImage::Topology::mixed)
    write_slice(about, {stream_length_}, before, entries, index_type(), connectivity.data());
  else
    write_slice(about, cells, image_.topology() == MeshImage::Topology::triangles ? 3 : 4, index_type(),
                connectivity.data());

  const auto regions = image_.regions(mesh);
  write_slice({"/mesh/region", "1", "index into the attribute names"}, {static_cast<hsize_t>(cells.total())},
              static_cast<hsize_t>(cells.begin()), regions.size(), index_type(), regions.data());
  together(comm_, path(), [&] {
    const Hdf5Dataset region(hdf5(H5Dopen2(file_, "/mesh/region", H5P_DEFAULT), "/mesh/region"));
    write_attribute(region, "names", mesh.region_names());
  });
}

void FieldsFile::write(double time, const double* u, const double* v, const double* stress) {
  const std::string frame = frame_path(times_.size());
  const double bytes = fields_bytes(1, image_.points().total(), image_.cells().total(), quantities_);
  reserve(bytes);
  if (quantities_.u) write_nodal({frame + "/u", "m", "displacement of the points; x, y and 0"}, u);
  if (quantities_.v) write_nodal({frame + "/v", "m/s", "velocity of the points; x, y and 0"}, v);
  if (quantities_.stress)
    write_stress({frame + "/stress", "Pa", "stress of the cells; xx, yy and xy"}, stress);
  append_time(time);
  together(comm_, path(), [&] { hdf5(H5Fflush(file_, H5F_SCOPE_GLOBAL), "flushing"); });
  times_.push_back(time);
  together(comm_, folder_ + "/fields.xdmf", [&] {
    if (rank_ == 0) replace_text_file(folder_ + "/fields.xdmf", xdmf_text(layout(), times_));
  });
}

void FieldsFile::reserve(double bytes) {
  together(comm_, path(), [&] {
    if (rank_ == 0)
      reserve_space(path(), std::filesystem::file_size(path()), static_cast<std::uint64_t>(bytes));
  });
}

XdmfLayout FieldsFile::layout() const {
  return {"fields.h5",    image_.topology(), image_.points().total(), image_.cells().total(),
          stream_length_, quantities_};
}

/// The third component is for ParaView, whose warping wants vectors in space.
void FieldsFile::write_nodal(const Description& about, const double* values) {
  std::vector<double> rows;
  rows.reserve(3 * image_.point_nodes().size());
  for (int node : image_.point_nodes())
    rows.insert(rows.end(), {values[2 * node], values[2 * node + 1], 0.0});
  write_slice(about, image_.points(), 3, H5T_NATIVE_DOUBLE, image_.points().to_file(rows.data(), 3).data());
}

void FieldsFile::write_stress(const Description& about, const double* stress) {
  std::vector<double> rows;
  rows.reserve(3 * image_.cell_places().size());
  for (int cell : image_.cell_places()) rows.insert(rows.end(), stress + 3 * cell, stress + 3 * cell + 3);
  write_slice(about, image_.cells(), 3, H5T_NATIVE_DOUBLE, image_.cells().to_file(rows.data(), 3).data());
}

void FieldsFile::append_time(double time) {
  const hsize_t frame = times_.size(), frames = frame + 1;
  together(comm_, path(), [&] {
    hdf5(H5Dset_extent(time_, &frames), "/time");
    write_rows(time_, H5T_NATIVE_DOUBLE, frame, rank_ == 0 ? 1 : 0, &time, "/time");
  });
}

void FieldsFile::write_slice(const Description& about, const FileOrder& order, hsize_t width, hid_t type,
                             const void* slice) {
  write_slice(about, {static_cast<hsize_t>(order.total()), width}, static_cast<hsize_t>(order.begin()),
              static_cast<hsize_t>(order.count()), type, slice);
}

void FieldsFile::write_slice(const Description& about, const std::vector<hsize_t>& shape, hsize_t begin,
                             hsize_t count, hid_t type, const void* slice) {
  together(comm_, path(), [&] {
    const Hdf5Dataset dataset = create_dataset(file_, about.path, type, shape);
    describe_dataset(dataset, about.units, about.text);
    write_rows(dataset, type, begin, count, slice, about.path);
  });
}

void FieldsFile::close() {
  together(comm_, path(), [&] {
    const bool closed = time_.close() >= 0;
    if (file_.close() < 0 || !closed) throw LibraryError(hdf5_message());
  });
}

}  // namespace slipscale
