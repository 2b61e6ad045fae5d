#include "slipscale/homogenize/localisation_file.hpp"

#include <array>

#include "slipscale/base/finite.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/files/mesh_group.hpp"
#include "slipscale/files/xdmf.hpp"
#include "slipscale/mesh/shape_functions.hpp"

namespace slipscale {
namespace {

/// The datasets of the local stress, one for each load case, and the macroscopic strain of that case.
constexpr std::array<const char*, load_cases> stress_names{"stress_xx", "stress_yy", "stress_xy"};
constexpr std::array<const char*, load_cases> strain_names{"xx", "yy", "xy"};

/// Returns what XDMF shows of it.
std::vector<XdmfAttribute> write_tensors(SharedFile& file, const MeshImage& image, const MeshLayout& layout,
                                         const Mesh& mesh, const std::vector<Material>& materials,
                                         const CellSolution& solution) {
  std::vector<XdmfAttribute> shown{xdmf_region(), {.name = "area", .path = "/cell/area", .row = {}}};
  const auto show = [&](const DatasetDescription& about, const std::vector<hsize_t>& row,
                        const std::vector<std::string>& components, const std::string& name) {
    const auto parts = write_components(file, layout, about, row, components, name);
    shown.insert(shown.end(), parts.begin(), parts.end());
  };
  write_on_cells(file, image, {"/cell/area", "m2", "area of each cell"}, {},
                 [&](int cell, double* row) { row[0] = cell_area(mesh.cells.corners_of(cell)); });
  write_on_cells(
      file, image,
      {"/cell/localisation", "1",
       "localisation tensor A of each cell, local strain = A : macroscopic strain; rows (xx, yy, xy) of "
       "the local, columns of the macroscopic strain, engineering shear"},
      {3, 3}, [&](int cell, double* row) {
        Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{row} = solution.localisation[cell];
      });
  std::vector<std::string> pairs;
  for (const std::string local : strain_names)
    for (const char* macroscopic : strain_names) pairs.push_back(local + "_" + macroscopic);
  show({"/cell/localisation", "1", "the localisation tensor, local strain before macroscopic strain"}, {3, 3},
       pairs, "localisation");
  for (int k = 0; k < load_cases; ++k) {
    const std::string name = stress_names[k], path = "/cell/" + name;
    const std::string text = std::string("local stress per unit macroscopic strain ") + strain_names[k];
    write_on_cells(file, image, {path, "Pa", text + ", C : A : e; xx, yy and xy"}, {3},
                   [&](int cell, double* row) {
                     Eigen::Map<Eigen::Vector3d>{row} =
                         materials[mesh.cells.region[cell]].stiffness * solution.localisation[cell].col(k);
                   });
    show({path, "Pa", "the " + text}, {3}, {strain_names.begin(), strain_names.end()}, name);
  }
  return shown;
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
  constexpr double headers = 80000;
  const auto points = static_cast<double>(image.points().total());
  const auto cells = static_cast<double>(image.cells().total());
  return headers + mesh_bytes(points, cells) + (1 + 9 + 3 * 3) * sizeof(double) * cells;
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
  const auto shown = write_tensors(file, image, layout, mesh, materials, solution);
  write_stiffness(comm, file, mesh, materials, solution);
  file.finish();
  write_xdmf(comm, folder + "/localization.xdmf", {name, "cell", layout, shown});
}

}  // namespace slipscale
