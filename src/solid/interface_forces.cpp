#include "slipscale/solid/interface_forces.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

/// Row of each node of each inclusion's interface.
std::map<std::pair<int, int>, int> rows_by_node(const Inclusions& inclusions) {
  std::map<std::pair<int, int>, int> rows;
  for (std::size_t k = 0; k < inclusions.interface.size(); ++k)
    rows[{inclusions.interface[k].inclusion, inclusions.interface[k].node}] = static_cast<int>(k);
  return rows;
}

}  // namespace

InterfaceForces::InterfaceForces(const Mesh& mesh, const std::vector<Material>& materials, int region,
                                 const RegionInclusions& found)
    : mesh_(mesh) {
  const auto rows = rows_by_node(found.inclusions);
  struct Found {
    int row, cell, corner;
    auto operator<=>(const Found&) const = default;
  };
  std::vector<Found> parts;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    if (mesh.cells.region[cell] != region) continue;
    const auto at = std::ranges::lower_bound(found.cells.number, static_cast<int>(mesh.cells.number[cell]));
    const int inclusion = found.inclusions.of_cell[at - found.cells.number.begin()];
    const auto nodes = mesh.cells.nodes_of(cell);
    for (int k = 0; k < static_cast<int>(nodes.size()); ++k) {
      if (nodes[k] >= mesh.nodes.owned) continue;
      const auto row = rows.find({inclusion, static_cast<int>(mesh.nodes.number[nodes[k]])});
      if (row != rows.end()) parts.push_back({row->second, cell, k});
    }
  }
  std::ranges::sort(parts);  // by row, then by cell: sums do not depend on the ranks
  for (const Found& part : parts) {
    if (rows_.empty() || rows_.back() != part.row) {
      rows_.push_back(part.row);
      node_.push_back(mesh.cells.nodes_of(part.cell)[part.corner]);
      mass_.push_back(0);
      first_.push_back(first_.back());
    }
    const auto corners = mesh.cells.corners_of(part.cell);
    const Solid material = materials[region].at(part.cell);
    mass_.back() += material.density * corner_areas(corners)[part.corner];
    const auto shape = mesh.shape_of(part.cell);
    const auto k = element_stiffness(std::span(shape.data(), corners.size()), material.stiffness);
    parts_.push_back({part.cell, static_cast<int>(blocks_.size())});
    for (int axis = 0; axis < 2; ++axis)
      for (int j = 0; j < k.cols(); ++j) blocks_.push_back(k(2 * part.corner + axis, j));
    ++first_.back();
  }
}

Vector2 InterfaceForces::internal(std::size_t k, const Vector2* displacement) const {
  Vector2 force{};
  for (int p = first_[k]; p < first_[k + 1]; ++p) {
    const auto nodes = mesh_.cells.nodes_of(parts_[p].cell);
    const double* block = &blocks_[parts_[p].block];
    const Vector2& base = displacement[nodes[0]];  // as a body it needs no force
    for (double& component : force)
      for (const int node : nodes)
        for (int axis = 0; axis < 2; ++axis) component += *block++ * (displacement[node][axis] - base[axis]);
  }
  return force;
}

StressForces::StressForces(const PlaneGrid& grid, const RegionInclusions& found)
    : interface_(found.inclusions.interface.size()) {
  const auto rows = rows_by_node(found.inclusions);
  for (int c = 0; c < found.cells.size(); ++c) {
    const int cell = found.cells.number[c], begin = found.cells.first[c];
    bool used = false;
    for (int k = 0; k < grid.corner_count(cell); ++k) {
      const auto row = rows.find({found.inclusions.of_cell[c], found.cells.node[begin + k]});
      if (row == rows.end()) continue;
      const CellCorners corners = grid.corners_of(cell);
      const auto b = centre_strain_displacement(corners);
      const double size = area(grid, cell);
      if (!used) cells_.push_back(cell);
      used = true;
      parts_.push_back(
          {row->second, static_cast<int>(cells_.size()) - 1, {size * b(0, 2 * k), size * b(1, 2 * k + 1)}});
    }
  }
}

std::vector<Vector2> StressForces::operator()(std::span<const PlaneTensor> stress) const {
  std::vector<Vector2> force(interface_, {0, 0});
  for (const Part& part : parts_) {
    const PlaneTensor& s = stress[part.cell];
    const auto& g = part.area_gradient;
    force[part.row][0] += g[0] * s[0] + g[1] * s[2];
    force[part.row][1] += g[1] * s[1] + g[0] * s[2];
  }
  return force;
}

}  // namespace slipscale
