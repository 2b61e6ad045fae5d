#include "slipscale/solid/stress.hpp"

#include "slipscale/solid/element.hpp"

namespace slipscale {

std::array<double, 3> stress_of_cell(const Mesh& mesh, const std::vector<Material>& materials,
                                     const Vector2* displacement, int cell) {
  const auto b = centre_strain_displacement(mesh.cells.corners_of(cell));
  Eigen::Vector3d strain = Eigen::Vector3d::Zero();
  const auto nodes = mesh.cells.nodes_of(cell);
  for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
    const Vector2& u = displacement[nodes[k]];
    strain += b.col(2 * k) * u[0] + b.col(2 * k + 1) * u[1];
  }
  const Eigen::Vector3d stress = materials[mesh.cells.region[cell]].at(cell).stiffness * strain;
  return {stress[0], stress[1], stress[2]};
}

void cell_stress(const Mesh& mesh, const std::vector<Material>& materials, const Vector2* displacement,
                 std::vector<std::array<double, 3>>& stress) {
  stress.resize(static_cast<std::size_t>(mesh.cells.size()));
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    stress[cell] = stress_of_cell(mesh, materials, displacement, cell);
}

}  // namespace slipscale
