#include "slipscale/solid/mass.hpp"

#include "slipscale/solid/element.hpp"

namespace slipscale {
std::vector<double> lumped_mass(const Mesh& mesh, const std::vector<Material>& materials) {
  std::vector<double> mass(static_cast<std::size_t>(mesh.nodes.owned), 0);
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto areas = corner_areas(mesh.cells.corners_of(cell));
    const double density = materials[mesh.cells.region[cell]].at(cell).density;
    const auto nodes = mesh.cells.nodes_of(cell);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const int node = nodes[k];
      if (node < mesh.nodes.owned) mass[node] += density * areas[k];
    }
  }
  return mass;
}

}  // namespace slipscale
