#include "slipscale/homogenize/localisation_file.hpp"

#include <array>
#include <numeric>

#include "slipscale/base/finite.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/files/mesh_group.hpp"
#include "slipscale/files/xdmf.hpp"
#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

/// The datasets of the local stress, one for each load case, and the macroscopic strain of that case.
constexpr std::array<const char*, load_cases> stress_names{"stress_xx", "stress_yy", "stress_xy"};
constexpr std::array<const char*, load_cases> strain_names{"xx", "yy", "xy"};

double area(const Cells& cells, int cell) {
  const auto parts = corner_areas(
      {cells.corners.data() + cells.first[cell], static_cast<std::size_t>(cells.corner_count(cell))});
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

void write_tensors(SharedFile& file, const MeshImage& image, const Mesh& mesh,
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
             slice_of_root(comm, {mesh.regions.size(), 3, 3}), H5T_NATIVE_DOUBLE, rows.data(),
             [&](hid_t set) { write_attribute(set, "names", mesh.region_names()); });
  rows.clear();
  append(solution.stiffness);
  file.write({"/effective/stiffness", "Pa", "effective stiffness; xx, yy, xy with engineering shear"},
             slice_of_root(comm, {3, 3}), H5T_NATIVE_DOUBLE, rows.data(), [&](hid_t set) {
               write_attribute(set, "boundary", name(solution.boundary));
               write_attribute(set, "cell_area", solution.area);
               write_attribute(set, "mesh_checksum", format("fnv1a:{:016x}", mesh.checksum));
             });
}

/// Somewhat more than the file will have.
double predicted_bytes(const MeshImage& image) {
  constexpr double headers = 40000;
  const auto points = static_cast<double>(image.points().total());
  const auto cells = static_cast<double>(image.cells().total());
  return headers + mesh_bytes(points, cells) + (1 + 9 + 3 * 3) * sizeof(double) * cells;
}

std::vector<XdmfAttribute> attributes() {
  std::vector<XdmfAttribute> shown{xdmf_region(), {.name = "area", .path = "/cell/area", .row = {}}};
  shown.push_back({.name = "localisation", .path = "/cell/localisation", .row = {3, 3}});
  for (const std::string name : stress_names)
    shown.push_back({.name = name, .path = "/cell/" + name, .row = {3}});
  return shown;
}

}  // namespace

void write_localisation(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials,
                        const CellSolution& solution, const std::string& folder) {
  const std::string name = "localization.h5";
  stop_unless_finite(comm,
                     {solution.localisation.empty() ? nullptr : solution.localisation.front().data(),
                      9 * solution.localisation.size()},
                     "the localisation tensor");
  const MeshImage image(comm, mesh);
  SharedFile file(comm, folder + "/" + name, predicted_bytes(image));
  const MeshLayout layout = write_mesh(comm, file, image);
  file.link("/mesh/region", "/cell/region");
  write_tensors(file, image, mesh, materials, solution);
  write_stiffness(comm, file, mesh, materials, solution);
  file.finish();
  write_xdmf(comm, folder + "/localization.xdmf", {name, "cell", layout, attributes()});
}

}  // namespace slipscale
