#include "slipscale/record/localization_file.hpp"

#include <numeric>

#include "localization_xdmf.hpp"
#include "shared_file.hpp"
#include "slipscale/record/mesh_image.hpp"
#include "slipscale/record/output_folder.hpp"
#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

hid_t index_type() { return sizeof(PetscInt) == 8 ? H5T_NATIVE_INT64 : H5T_NATIVE_INT32; }

DatasetSlice slice_of(const FileOrder& order, std::vector<hsize_t> shape_of_row) {
  shape_of_row.insert(shape_of_row.begin(), static_cast<hsize_t>(order.total()));
  return {shape_of_row, static_cast<hsize_t>(order.begin()), static_cast<hsize_t>(order.count())};
}

/// What rank 0 alone writes.
DatasetSlice whole_on_first(MPI_Comm comm, std::vector<hsize_t> shape) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const hsize_t rows = rank == 0 ? shape[0] : 0;
  return {std::move(shape), 0, rows};
}

/// The points of the cells; returns the length of the stream when cells are mixed.
hsize_t write_cells(MPI_Comm comm, SharedFile& file, const MeshImage& image) {
  const auto connectivity = image.connectivity();
  hsize_t entries = connectivity.size(), before = 0, length = 0;
  MPI_Exscan(&entries, &before, 1, MPI_UINT64_T, MPI_SUM, comm);
  MPI_Allreduce(&entries, &length, 1, MPI_UINT64_T, MPI_SUM, comm);
  const bool triangles = image.topology() == MeshImage::Topology::triangles;
  if (image.topology() == MeshImage::Topology::mixed)
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

hsize_t write_mesh(MPI_Comm comm, SharedFile& file, const MeshImage& image, const Mesh& mesh) {
  file.write({"/mesh/coordinates", "m", "positions of the points; x and y"}, slice_of(image.points(), {2}),
             H5T_NATIVE_DOUBLE, image.coordinates().data());
  const hsize_t length = write_cells(comm, file, image);
  file.write({"/mesh/region", "1", "index into the attribute names"}, slice_of(image.cells(), {}),
             index_type(), image.regions(mesh).data(),
             [&](hid_t set) { write_attribute(set, "names", mesh.region_names()); });
  file.link("/mesh/region", "/cell/region");
  return length;
}

double area(const Cells& cells, int cell) {
  const auto parts = corner_areas(
      {cells.corners.data() + cells.first[cell], static_cast<std::size_t>(cells.corner_count(cell))});
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

/// Writes rows of `width` numbers, one for each cell: `fill(cell, row)`.
template <class Fill>
void write_on_cells(SharedFile& file, const MeshImage& image, const DatasetDescription& about,
                    const std::vector<hsize_t>& shape_of_row, const Fill& fill) {
  std::size_t width = 1;
  for (const hsize_t n : shape_of_row) width *= n;
  std::vector<double> rows(width * image.cell_places().size());
  for (std::size_t k = 0; k < image.cell_places().size(); ++k)
    fill(image.cell_places()[k], rows.data() + width * k);
  file.write(about, slice_of(image.cells(), shape_of_row), H5T_NATIVE_DOUBLE,
             image.cells().to_file(rows.data(), static_cast<int>(width)).data());
}

void write_on_cells(SharedFile& file, const MeshImage& image, const Mesh& mesh,
                    const std::vector<Material>& materials, const CellSolution& solution) {
  write_on_cells(file, image, {"/cell/area", "m2", "area of each cell"}, {},
                 [&](int cell, double* row) { row[0] = area(mesh.cells, cell); });
  write_on_cells(
      file, image,
      {"/cell/localisation", "1",
       "localisation tensor A of each cell, local strain = A : macroscopic strain; rows (xx, yy, xy) of "
       "the local, columns of the macroscopic strain, engineering shear"},
      {3, 3}, [&](int cell, double* row) {
        Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{row} = solution.localisation[cell];
      });
  for (int k = 0; k < load_cases; ++k)
    write_on_cells(file, image,
                   {std::string("/cell/") + stress_names[k], "Pa",
                    std::string("local stress per unit macroscopic strain ") + strain_names[k] +
                        ", C : A : e; xx, yy and xy"},
                   {3}, [&](int cell, double* row) {
                     Eigen::Map<Eigen::Vector3d>{row} =
                         materials[mesh.cells.region[cell]].stiffness * solution.localisation[cell].col(k);
                   });
}

void write_stiffness(MPI_Comm comm, SharedFile& file, const Mesh& mesh,
                     const std::vector<Material>& materials, const CellSolution& solution) {
  std::vector<double> rows;
  const auto append = [&](const Eigen::Matrix3d& c) {
    for (int i = 0; i < 3; ++i) rows.insert(rows.end(), {c(i, 0), c(i, 1), c(i, 2)});
  };
  for (const Material& material : materials) append(material.stiffness);
  file.write({"/region/stiffness", "Pa", "stiffness of each region; xx, yy, xy with engineering shear"},
             whole_on_first(comm, {mesh.regions.size(), 3, 3}), H5T_NATIVE_DOUBLE, rows.data(),
             [&](hid_t set) { write_attribute(set, "names", mesh.region_names()); });
  rows.clear();
  append(solution.stiffness);
  file.write({"/effective/stiffness", "Pa", "effective stiffness; xx, yy, xy with engineering shear"},
             whole_on_first(comm, {3, 3}), H5T_NATIVE_DOUBLE, rows.data(),
             [&](hid_t set) { write_attribute(set, "boundary", name(solution.boundary)); });
}

/// Somewhat more than the file will have.
double predicted_bytes(const MeshImage& image) {
  constexpr double headers = 40000;
  const double real = sizeof(double), index = sizeof(PetscInt);
  return headers + 2 * real * static_cast<double>(image.points().total()) +
         ((1 + 9 + 3 * 3) * real + (5 + 1) * index) * static_cast<double>(image.cells().total());
}

}  // namespace

void write_localization(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials,
                        const CellSolution& solution, const std::string& folder) {
  const std::string file_name = "localization.h5";
  const MeshImage image(comm, mesh);
  SharedFile file(comm, folder + "/" + file_name, predicted_bytes(image));
  const hsize_t stream_length = write_mesh(comm, file, image, mesh);
  write_on_cells(file, image, mesh, materials, solution);
  write_stiffness(comm, file, mesh, materials, solution);
  file.finish();
  const std::string path = folder + "/localization.xdmf";
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  write_together(comm, path, [&] {
    if (rank == 0)
      replace_text_file(path, localization_xdmf({file_name, image.topology(), image.points().total(),
                                                 image.cells().total(), stream_length}));
  });
}

}  // namespace slipscale
