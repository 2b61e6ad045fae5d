#include "slipscale/mesh/inclusions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

namespace slipscale {
namespace {

using Ends = std::array<int, 2>;

struct CellEdge {
  Ends ends;  ///< low, high
  int cell, corner;
  auto operator<=>(const CellEdge&) const = default;
};

/// Of all cells, ascending ends.
std::vector<CellEdge> edges_of(const RegionCells& cells) {
  std::vector<CellEdge> edges;
  edges.reserve(cells.node.size());
  for (int cell = 0; cell < cells.size(); ++cell) {
    const int begin = cells.first[cell], count = cells.first[cell + 1] - begin;
    for (int k = 0; k < count; ++k) {
      const int a = cells.node[begin + k], b = cells.node[begin + (k + 1) % count];
      edges.push_back({{std::min(a, b), std::max(a, b)}, cell, k});
    }
  }
  std::ranges::sort(edges);
  return edges;
}

bool alone(const std::vector<CellEdge>& edges, std::size_t e) {
  return (e == 0 || edges[e - 1].ends != edges[e].ends) &&
         (e + 1 == edges.size() || edges[e + 1].ends != edges[e].ends);
}

int root_of(std::vector<int>& parent, int cell) {
  while (parent[cell] != cell) cell = parent[cell] = parent[parent[cell]];
  return cell;
}

/// Of each cell the lowest cell of its part.
std::vector<int> parts_of(const std::vector<CellEdge>& edges, int cells) {
  std::vector<int> parent(static_cast<std::size_t>(cells));
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t e = 1; e < edges.size(); ++e)
    if (edges[e].ends == edges[e - 1].ends) {
      const int a = root_of(parent, edges[e].cell), b = root_of(parent, edges[e - 1].cell);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (int cell = 0; cell < cells; ++cell) parent[cell] = root_of(parent, cell);
  return parent;
}

/// Area, and its first moments about the first corner.
std::array<double, 3> moments(const RegionCells& cells, int cell) {
  const int begin = cells.first[cell], end = cells.first[cell + 1];
  const Vector2& o = cells.corner[begin];
  std::array<double, 3> sum{};
  for (int k = begin + 1; k + 1 < end; ++k) {
    const Vector2 a{cells.corner[k][0] - o[0], cells.corner[k][1] - o[1]},
        b{cells.corner[k + 1][0] - o[0], cells.corner[k + 1][1] - o[1]};
    const double area = 0.5 * (a[0] * b[1] - a[1] * b[0]);
    sum[0] += area;
    for (int axis = 0; axis < 2; ++axis) sum[1 + axis] += area * (a[axis] + b[axis]) / 3;
  }
  return sum;
}

/// How far a cell is moved, by whole periods, to lie beside another of its inclusion.
Vector2 moved_to(const RegionCells& cells, int cell, const Vector2& beside) {
  const Vector2& place = cells.corner[cells.first[cell]];
  Vector2 shift{};
  for (int axis = 0; axis < 2; ++axis)
    if (const double period = cells.period[axis]; period > 0)
      shift[axis] = std::round((beside[axis] - place[axis]) / period) * period;
  return shift;
}

/// Into the block.
Vector2 inside(const RegionCells& cells, Vector2 place) {
  for (int axis = 0; axis < 2; ++axis)
    if (const double period = cells.period[axis]; period > 0)
      place[axis] -= std::floor((place[axis] - cells.lower[axis]) / period) * period;
  return place;
}

void number_by_centre(Inclusions& found, std::vector<int>& part, double extent) {
  const double quantum = 1e-6 * extent;
  std::vector<int> order(found.area.size()), place(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int k) {
    return std::tuple(std::round(found.centre[k][1] / quantum), std::round(found.centre[k][0] / quantum), k);
  });
  Inclusions sorted;
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = static_cast<int>(k);
    sorted.centre.push_back(found.centre[order[k]]);
    sorted.area.push_back(found.area[order[k]]);
  }
  for (int& of : part) of = place[of];
  found.centre = std::move(sorted.centre);
  found.area = std::move(sorted.area);
}

/// Parts with their centres; `shift` [cells] moves each cell beside the others of its part.
void measure(const RegionCells& cells, Inclusions& found, std::vector<Vector2>& shift) {
  std::map<int, int> index;  // of the lowest cell
  std::vector<std::array<double, 2>> first_moments;
  shift.resize(static_cast<std::size_t>(cells.size()));
  Box box{{1e300, 1e300}, {-1e300, -1e300}};
  for (int cell = 0; cell < cells.size(); ++cell) {
    const int lowest = found.of_cell[cell];
    const auto [known, is_new] = index.try_emplace(lowest, static_cast<int>(found.area.size()));
    if (is_new) found.area.push_back(0), first_moments.push_back({0, 0});
    shift[cell] = moved_to(cells, cell, cells.corner[cells.first[lowest]]);
    const auto own = moments(cells, cell);
    found.area[known->second] += own[0];
    for (int axis = 0; axis < 2; ++axis) {
      const double corner = cells.corner[cells.first[cell]][axis];
      first_moments[known->second][axis] += own[1 + axis] + own[0] * (corner + shift[cell][axis]);
      box.lower[axis] = std::min(box.lower[axis], corner);
      box.upper[axis] = std::max(box.upper[axis], corner);
    }
    found.of_cell[cell] = known->second;
  }
  for (std::size_t k = 0; k < found.area.size(); ++k)
    found.centre.push_back({first_moments[k][0] / found.area[k], first_moments[k][1] / found.area[k]});
  std::vector<Vector2> unwrapped = found.centre;
  for (Vector2& centre : found.centre) centre = inside(cells, centre);
  for (int cell = 0; cell < cells.size(); ++cell) {
    const int k = found.of_cell[cell];
    for (int axis = 0; axis < 2; ++axis) shift[cell][axis] += found.centre[k][axis] - unwrapped[k][axis];
  }
  if (!found.area.empty())
    number_by_centre(found, found.of_cell, std::max({box.extent(0), box.extent(1), 1e-300}));
}

}  // namespace

std::array<double, 2> tractions(const InterfaceNode& node, const Vector2& force) {
  if (!(node.length > 0)) return {0, 0};
  return {(force[0] * node.normal[0] + force[1] * node.normal[1]) / node.length,
          (force[1] * node.normal[0] - force[0] * node.normal[1]) / node.length};
}

std::vector<Ends> outline_edges(const RegionCells& cells) {
  const auto edges = edges_of(cells);
  std::vector<Ends> found;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (alone(edges, e)) found.push_back(edges[e].ends);
  return found;
}

Inclusions find_inclusions(const RegionCells& cells, const std::vector<char>& others) {
  const auto edges = edges_of(cells);
  Inclusions found;
  found.of_cell = parts_of(edges, cells.size());
  std::vector<Vector2> shift;
  measure(cells, found, shift);
  found.outer.assign(found.area.size(), 0);

  std::map<std::pair<int, int>, InterfaceNode> nodes;  // by inclusion and node
  std::vector<std::pair<int, int>> outer;
  std::size_t outline = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!alone(edges, e)) continue;
    const CellEdge& edge = edges[e];
    const int begin = cells.first[edge.cell], count = cells.first[edge.cell + 1] - begin,
              k = found.of_cell[edge.cell];
    const int ends[2] = {begin + edge.corner, begin + (edge.corner + 1) % count};
    if (!others[outline++]) {
      for (const int end : ends) outer.emplace_back(k, cells.node[end]);
      continue;
    }
    const Vector2 &a = cells.corner[ends[0]], &b = cells.corner[ends[1]];
    for (const int end : ends) {
      InterfaceNode& node = nodes.try_emplace({k, cells.node[end]}, k, cells.node[end]).first->second;
      node.normal = {node.normal[0] + 0.5 * (b[1] - a[1]), node.normal[1] - 0.5 * (b[0] - a[0])};
      node.position = {cells.corner[end][0] + shift[edge.cell][0],
                       cells.corner[end][1] + shift[edge.cell][1]};
    }
  }
  for (const auto& where : outer)
    if (const auto node = nodes.find(where); node != nodes.end()) node->second.outer = true;
  for (auto& [where, node] : nodes) {
    node.length = std::hypot(node.normal[0], node.normal[1]);
    if (node.length > 0) node.normal = {node.normal[0] / node.length, node.normal[1] / node.length};
    const Vector2& centre = found.centre[node.inclusion];
    node.angle = std::atan2(node.position[1] - centre[1], node.position[0] - centre[0]);
    if (node.angle < 0) node.angle += 2 * std::numbers::pi;
    if (node.outer) found.outer[node.inclusion] = 1;
    found.interface.push_back(node);
  }
  std::ranges::sort(found.interface, {}, [](const InterfaceNode& node) {
    return std::tuple(node.inclusion, node.angle, node.node);
  });
  return found;
}

}  // namespace slipscale
