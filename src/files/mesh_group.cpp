#include "slipscale/files/mesh_group.hpp"

#include <array>

#include "slipscale/files/continued_file.hpp"

namespace slipscale {
namespace {

using Topology = MeshImage::Topology;

/// The length of the stream when cells are mixed. Collective.
hsize_t stream_length(MPI_Comm comm, hsize_t entries) {
  MPI_Allreduce(MPI_IN_PLACE, &entries, 1, MPI_UINT64_T, MPI_SUM, comm);
  return entries;
}

hsize_t write_cells(MPI_Comm comm, SharedFile& file, const MeshImage& image) {
  const auto connectivity = image.connectivity();
  hsize_t entries = connectivity.size(), before = 0;
  MPI_Exscan(&entries, &before, 1, MPI_UINT64_T, MPI_SUM, comm);
  const hsize_t length = stream_length(comm, entries);
  const bool triangles = image.topology() == Topology::triangles;
  if (image.topology() == Topology::mixed)
    file.write({"/mesh/cells", "1",
                "XDMF's mixed stream: of each cell its code (4 triangle, 5 quadrilateral) and its points"},
               {{length}, before, entries}, index_type(), connectivity.data());
  else
    file.write({"/mesh/cells", "1",
                triangles ? "points of each triangle, counter-clockwise"
                          : "points of each quadrilateral, counter-clockwise"},
               slice_of(image.cells(), {triangles ? 3u : 4u}), index_type(), connectivity.data());
  return length;
}

}  // namespace

MeshLayout write_mesh(MPI_Comm comm, SharedFile& file, const MeshImage& image) {
  if (image.checksum() != 0)
    file.describe(
        "/", [&](hid_t root) { write_attribute(root, "mesh_checksum", checksum_text(image.checksum())); });
  const std::array box{image.block().lower, image.block().upper};
  file.write({"/mesh/block", "m", "lower left and upper right corner of the whole block; x and y"},
             slice_of_root(comm, {2, 2}), H5T_NATIVE_DOUBLE, box.front().data());
  file.write({"/mesh/coordinates", "m", "positions of the points; x and y"}, slice_of(image.points(), {2}),
             H5T_NATIVE_DOUBLE, image.coordinates().data());
  const hsize_t length = write_cells(comm, file, image);
  file.write({"/mesh/region", "1", "index into the attribute names"}, slice_of(image.cells(), {}),
             index_type(), image.regions().data(),
             [&](hid_t set) { write_attribute(set, "names", image.region_names()); });
  return {image.topology(), image.points().total(), image.cells().total(), length};
}

MeshLayout check_mesh(MPI_Comm comm, const SharedFile& file, const MeshImage& image) {
  const hsize_t length = stream_length(comm, image.connectivity().size());
  const auto points = static_cast<hsize_t>(image.points().total()),
             cells = static_cast<hsize_t>(image.cells().total());
  const std::array box{image.block().lower, image.block().upper};
  file.examine([&](hid_t data) {
    if (image.checksum() != 0) expect_text(data, "mesh_checksum", checksum_text(image.checksum()));
    expect_values(data, "/mesh/block", {2, 2}, "m", box.front().data());
    (void)expect_dataset(data, "/mesh/coordinates", H5T_IEEE_F64LE, {points, 2}, "m");
    const hsize_t corners = image.topology() == Topology::triangles ? 3 : 4;
    const bool mixed = image.topology() == Topology::mixed;
    (void)expect_dataset(data, "/mesh/cells", index_type(),
                         mixed ? std::vector{length} : std::vector{cells, corners}, "1");
    (void)expect_dataset(data, "/mesh/region", index_type(), {cells}, "1");
  });
  return {image.topology(), image.points().total(), image.cells().total(), length};
}

double mesh_bytes(double points, double cells) {
  return 2 * sizeof(double) * points + (5 + 1) * sizeof(PetscInt) * cells;
}

void write_on_cells(SharedFile& file, const MeshImage& image, const DatasetDescription& about,
                    const std::vector<hsize_t>& shape_of_row,
                    const std::function<void(int cell, double* row)>& fill) {
  std::size_t width = 1;
  for (const hsize_t n : shape_of_row) width *= n;
  std::vector<double> rows(width * image.cell_places().size());
  for (std::size_t k = 0; k < image.cell_places().size(); ++k)
    fill(image.cell_places()[k], rows.data() + width * k);
  file.write(about, image.cells(), shape_of_row, rows.data());
}

}  // namespace slipscale
