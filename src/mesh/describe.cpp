#include <algorithm>
#include <numeric>

#include "slipscale/base/print.hpp"
#include "slipscale/mesh/read.hpp"

namespace slipscale {

const Boundary* Mesh::find_boundary(const std::string& name) const {
  const auto found =
      std::find_if(boundaries.begin(), boundaries.end(), [&](const auto& b) { return b.name == name; });
  return found == boundaries.end() ? nullptr : &*found;
}

std::vector<std::string> Mesh::region_names() const {
  std::vector<std::string> names;
  for (const auto& region : regions) names.push_back(region.name);
  return names;
}

std::vector<std::string> Mesh::boundary_names() const {
  std::vector<std::string> names;
  for (const auto& boundary : boundaries) names.push_back(boundary.name);
  return names;
}

double Mesh::area() const {
  return std::accumulate(regions.begin(), regions.end(), 0.0,
                         [](double sum, const Region& region) { return sum + region.area; });
}

std::string describe(const Mesh& mesh, const std::vector<std::string>& region_materials) {
  std::string text =
      format("mesh {}: {} nodes, {} cells, x {:g} to {:g} m, y {:g} to {:g} m{}\n", mesh.file,
             static_cast<long long>(mesh.nodes.total), static_cast<long long>(mesh.cells.total),
             mesh.lower[0], mesh.upper[0], mesh.lower[1], mesh.upper[1],
             mesh.periodic[0] && mesh.periodic[1] ? ", periodic in x and y"
             : mesh.periodic[0]                   ? ", periodic in x"
             : mesh.periodic[1]                   ? ", periodic in y"
                                                  : "");
  std::vector<std::vector<std::string>> rows{{"name", "tag", "cells/edges", "size", "material"}};
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const Region& region = mesh.regions[r];
    rows.push_back({region.name, std::to_string(region.tag), std::to_string(region.cells),
                    format("{:.4g} m2", region.area),
                    r < region_materials.size() ? region_materials[r] : ""});
  }
  for (const Boundary& boundary : mesh.boundaries)
    rows.push_back({boundary.name, std::to_string(boundary.tag), std::to_string(boundary.edge_count),
                    format("{:.4g} m", boundary.length), boundary.interior ? "(interior)" : ""});
  text += table(rows);

  const PartitionReport& parts = mesh.partition;
  rows = {{"rank", "cells", "overlap", "nodes", "ghosts"}};
  for (std::size_t r = 0; r < parts.owned_cells.size(); ++r)
    rows.push_back({std::to_string(r), std::to_string(parts.owned_cells[r]),
                    std::to_string(parts.overlap_cells[r]), std::to_string(parts.owned_nodes[r]),
                    std::to_string(parts.ghost_nodes[r])});
  if (rows.size() > 2) text += table(rows) + format("edge cut {}\n", static_cast<long long>(parts.edge_cut));
  return text;
}

}  // namespace slipscale
