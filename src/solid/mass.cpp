#include "slipscale/solid/mass.hpp"

#include <algorithm>

#include "slipscale/solid/element.hpp"

namespace slipscale {
std::vector<double> lumped_mass(const Mesh& mesh, const std::vector<Material>& materials) {
  std::vector<double> mass(static_cast<std::size_t>(mesh.nodes.owned), 0);
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto areas = corner_areas(mesh.cells.corners_of(cell));
    const double density = materials[mesh.cells.region[cell]].density;
    const auto nodes = mesh.cells.nodes_of(cell);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const int node = nodes[k];
      if (node < mesh.nodes.owned) mass[node] += density * areas[k];
    }
  }
  return mass;
}

std::array<double, 3> stress_of_cell(const Mesh& mesh, const std::vector<Material>& materials,
                                     const Vector2* displacement, int cell) {
  const auto b = centre_strain_displacement(mesh.cells.corners_of(cell));
  Eigen::Vector3d strain = Eigen::Vector3d::Zero();
  const auto nodes = mesh.cells.nodes_of(cell);
  for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
    const Vector2& u = displacement[nodes[k]];
    strain += b.col(2 * k) * u[0] + b.col(2 * k + 1) * u[1];
  }
  const Eigen::Vector3d stress = materials[mesh.cells.region[cell]].stiffness * strain;
  return {stress[0], stress[1], stress[2]};
}

void cell_stress(const Mesh& mesh, const std::vector<Material>& materials, const Vector2* displacement,
                 std::vector<std::array<double, 3>>& stress) {
  stress.resize(static_cast<std::size_t>(mesh.cells.size()));
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    stress[cell] = stress_of_cell(mesh, materials, displacement, cell);
}

double element_eigenvalue_bound(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials) {
  double largest = 0;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const Material& material = materials[mesh.cells.region[cell]];
    largest = std::max(largest, largest_element_eigenvalue(mesh.cells.corners_of(cell), material.stiffness,
                                                           material.density));
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, comm);
  return largest;
}

}  // namespace slipscale
