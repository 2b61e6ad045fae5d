// The inclusions of a mesh that the ranks share, or that one has whole: what inclusions.cpp finds in its
// cells.
#include <algorithm>

#include "slipscale/mesh/inclusions.hpp"
#include "slipscale/mesh/ordered_gather.hpp"

namespace slipscale {
namespace {

using EdgeEnds = std::array<int, 2>;  ///< low, high

/// Of a region, on all ranks.
RegionCells gathered(const Mesh& mesh, int region) {
  constexpr int width = 13;  // corners, their nodes and coordinates
  std::vector<PetscInt> keys;
  std::vector<double> rows;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    if (!mesh.cells.owned[cell] || mesh.cells.region[cell] != region) continue;
    keys.push_back(mesh.cells.number[cell]);
    const auto nodes = mesh.cells.nodes_of(cell);
    const auto corners = mesh.cells.corners_of(cell);
    std::array<double, width> row{static_cast<double>(nodes.size())};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      row[1 + k] = static_cast<double>(mesh.nodes.number[nodes[k]]);
      row[5 + 2 * k] = corners[k][0];
      row[6 + 2 * k] = corners[k][1];
    }
    rows.insert(rows.end(), row.begin(), row.end());
  }
  const OrderedGather gather(mesh.comm, keys);
  std::vector<double> all = gather(rows, width);
  std::vector<PetscInt> numbers = gather.keys();
  int count = gather.count();
  MPI_Bcast(&count, 1, MPI_INT, 0, mesh.comm);
  all.resize(static_cast<std::size_t>(count) * width);
  numbers.resize(static_cast<std::size_t>(count));
  MPI_Bcast(all.data(), count * width, MPI_DOUBLE, 0, mesh.comm);
  MPI_Bcast(numbers.data(), count, MPIU_INT, 0, mesh.comm);
  RegionCells cells;
  for (int c = 0; c < count; ++c) {
    const double* row = &all[static_cast<std::size_t>(c) * width];
    cells.number.push_back(static_cast<int>(numbers[c]));
    for (int k = 0; k < static_cast<int>(row[0]); ++k) {
      cells.node.push_back(static_cast<int>(row[1 + k]));
      cells.corner.push_back({row[5 + 2 * k], row[6 + 2 * k]});
    }
    cells.first.push_back(static_cast<int>(cells.node.size()));
  }
  for (int axis = 0; axis < 2; ++axis)
    if (mesh.periodic[axis]) cells.period[axis] = mesh.upper[axis] - mesh.lower[axis];
  cells.lower = mesh.lower;
  return cells;
}

/// Marks the edges among `edges` that a cell of another region has. `number(cell, corner)` is its node's.
template <class Number>
void mark_edges(const std::vector<EdgeEnds>& edges, std::size_t corners, Number&& number,
                std::vector<char>& mark) {
  for (std::size_t k = 0; k < corners; ++k) {
    const int a = number(k), b = number((k + 1) % corners);
    const EdgeEnds ends{std::min(a, b), std::max(a, b)};
    const auto found = std::ranges::lower_bound(edges, ends);
    if (found != edges.end() && *found == ends) mark[found - edges.begin()] = 1;
  }
}

}  // namespace

RegionInclusions find_inclusions(const Mesh& mesh, int region) {
  RegionInclusions found;
  found.cells = gathered(mesh, region);
  const auto edges = outline_edges(found.cells);
  std::vector<char> others(edges.size(), 0);
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    if (mesh.cells.region[cell] == region) continue;
    const auto nodes = mesh.cells.nodes_of(cell);
    mark_edges(
        edges, nodes.size(), [&](std::size_t k) { return static_cast<int>(mesh.nodes.number[nodes[k]]); },
        others);
  }
  MPI_Allreduce(MPI_IN_PLACE, others.data(), static_cast<int>(others.size()), MPI_CHAR, MPI_MAX, mesh.comm);
  found.inclusions = find_inclusions(found.cells, others);

  // Where the outline meets the outer boundary in a single node.
  auto& interface = found.inclusions.interface;
  std::vector<int> at_outside;
  for (const Boundary& boundary : mesh.boundaries)
    if (!boundary.interior)
      for (const int node : boundary.nodes) at_outside.push_back(static_cast<int>(mesh.nodes.number[node]));
  std::ranges::sort(at_outside);
  std::vector<char> outer;
  for (const InterfaceNode& node : interface)
    outer.push_back(node.outer || std::ranges::binary_search(at_outside, node.node) ? 1 : 0);
  MPI_Allreduce(MPI_IN_PLACE, outer.data(), static_cast<int>(outer.size()), MPI_CHAR, MPI_MAX, mesh.comm);
  for (std::size_t k = 0; k < interface.size(); ++k)
    if (outer[k]) interface[k].outer = true, found.inclusions.outer[interface[k].inclusion] = 1;
  return found;
}

RegionInclusions find_inclusions(const PlaneGrid& grid, int region, const std::vector<int>& node) {
  RegionInclusions found;
  const auto number = [&](int cell, std::size_t k) {
    return node[grid.corners[grid.first[cell] + static_cast<int>(k)]];
  };
  RegionCells& cells = found.cells;
  for (int cell = 0; cell < grid.cells(); ++cell) {
    if (grid.region[cell] != region) continue;
    cells.number.push_back(cell);
    for (int k = 0; k < grid.corner_count(cell); ++k) {
      cells.node.push_back(number(cell, static_cast<std::size_t>(k)));
      cells.corner.push_back(grid.points[grid.corners[grid.first[cell] + k]]);
    }
    cells.first.push_back(static_cast<int>(cells.node.size()));
  }
  const auto edges = outline_edges(cells);
  std::vector<char> others(edges.size(), 0);
  for (int cell = 0; cell < grid.cells(); ++cell)
    if (grid.region[cell] != region)
      mark_edges(
          edges, static_cast<std::size_t>(grid.corner_count(cell)),
          [&](std::size_t k) { return number(cell, k); }, others);
  found.inclusions = find_inclusions(cells, others);
  return found;
}

}  // namespace slipscale
