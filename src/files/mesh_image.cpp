#include "slipscale/files/mesh_image.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "slipscale/base/parallel.hpp"

namespace slipscale {
namespace {

constexpr int xdmf_triangle = 4, xdmf_quadrilateral = 5;
constexpr int corner_width = 5;  ///< code and up to four points

auto key(const auto& extra) { return std::tuple(extra.node, extra.side[0], extra.side[1]); }

void keep_first_of_each(auto& extras) {
  std::sort(extras.begin(), extras.end(), [](const auto& a, const auto& b) {
    return std::tuple_cat(key(a), std::tuple(a.cell)) < std::tuple_cat(key(b), std::tuple(b.cell));
  });
  const auto same = [](const auto& a, const auto& b) { return key(a) == key(b); };
  extras.erase(std::unique(extras.begin(), extras.end(), same), extras.end());
}

/// On which side of the node's position a corner is drawn; {0, 0} when it is drawn there.
std::array<int, 2> side_of(const Mesh& mesh, const Vector2& corner, const Vector2& position) {
  std::array<int, 2> side{};
  for (int d = 0; d < 2; ++d) {
    const double shift = corner[d] - position[d], little = 0.5 * mesh.shortest_edge;
    side[d] = (shift > little) - (shift < -little);
  }
  return side;
}

/// Numbers the chosen ones among all `numbers` of the whole mesh in that order, -1 for the others. `chosen`
/// [owned] is the owner's word, and `owned` the places that this rank owns. Collective.
std::vector<PetscInt> renumber(MPI_Comm comm, PetscInt total, const std::vector<PetscInt>& numbers,
                               const std::vector<int>& owned, const std::vector<PetscInt>& chosen,
                               PetscInt& count) {
  std::vector<PetscInt> owned_numbers;
  for (const int place : owned) owned_numbers.push_back(numbers[place]);
  std::vector<PetscInt> slice = FileOrder(comm, total, owned_numbers).to_file(chosen.data(), 1);
  PetscInt mine = 0, next = 0;
  for (const PetscInt one : slice) mine += one;
  MPI_Exscan(&mine, &next, 1, MPIU_INT, MPI_SUM, comm);
  MPI_Allreduce(&mine, &count, 1, MPIU_INT, MPI_SUM, comm);
  for (PetscInt& entry : slice) entry = entry ? next++ : -1;
  return FileOrder(comm, total, numbers).from_file(slice.data(), 1);
}

}  // namespace

std::vector<char> cells_in(const Cells& cells, const Box& box) {
  std::vector<char> inside;
  for (int cell = 0; cell < cells.size(); ++cell) {
    Vector2 centre{};
    for (int k = cells.first[cell]; k < cells.first[cell + 1]; ++k)
      for (int d = 0; d < 2; ++d) centre[d] += cells.corners[k][d] / cells.corner_count(cell);
    inside.push_back(box.lower[0] <= centre[0] && centre[0] <= box.upper[0] && box.lower[1] <= centre[1] &&
                     centre[1] <= box.upper[1]);
  }
  return inside;
}

MeshImage::MeshImage(MPI_Comm comm, const Mesh& mesh, const std::optional<Box>& box)
    : checksum_(mesh.checksum), block_{mesh.lower, mesh.upper}, region_names_(mesh.region_names()) {
  const Rows rows = box ? rows_in(comm, mesh, *box)
                        : Rows{mesh.nodes.number, mesh.cells.number, mesh.nodes.total, mesh.cells.total};
  std::vector<Extra> extras;
  if (mesh.periodic[0] || mesh.periodic[1]) extras = extra_points(comm, mesh, rows);
  set_points(comm, mesh, rows, extras);
  set_cells(comm, mesh, rows, extras);
}

/// The owner of a node knows every cell around it, and so whether it is drawn.
MeshImage::Rows MeshImage::rows_in(MPI_Comm comm, const Mesh& mesh, const Box& box) {
  const Cells& cells = mesh.cells;
  const std::vector<char> inside = cells_in(cells, box);
  std::vector<int> owned_nodes(static_cast<std::size_t>(mesh.nodes.owned)), owned_cells;
  std::iota(owned_nodes.begin(), owned_nodes.end(), 0);
  std::vector<PetscInt> drawn_nodes(owned_nodes.size(), 0), drawn_cells;
  for (int cell = 0; cell < cells.size(); ++cell) {
    if (cells.owned[cell]) {
      owned_cells.push_back(cell);
      drawn_cells.push_back(inside[cell]);
    }
    for (int k = cells.first[cell]; inside[cell] && k < cells.first[cell + 1]; ++k) {
      const int node = cells.corner_nodes[k];
      if (node < mesh.nodes.owned &&
          side_of(mesh, cells.corners[k], mesh.nodes.position[node]) == std::array{0, 0})
        drawn_nodes[node] = 1;
    }
  }
  Rows rows;
  rows.node = renumber(comm, mesh.nodes.total, mesh.nodes.number, owned_nodes, drawn_nodes, rows.node_count);
  rows.cell = renumber(comm, cells.total, cells.number, owned_cells, drawn_cells, rows.cell_count);
  return rows;
}

std::vector<MeshImage::Extra> MeshImage::extra_points(MPI_Comm comm, const Mesh& mesh, const Rows& rows) {
  std::vector<Extra> mine;
  const Cells& cells = mesh.cells;
  for (int cell = 0; cell < cells.size(); ++cell) {
    if (!cells.owned[cell] || rows.cell[cell] < 0) continue;
    for (int k = cells.first[cell]; k < cells.first[cell + 1]; ++k) {
      const int node = cells.corner_nodes[k];
      const auto side = side_of(mesh, cells.corners[k], mesh.nodes.position[node]);
      if (side[0] || side[1])
        mine.push_back({mesh.nodes.number[node], side, cells.number[cell], cells.corners[k]});
    }
  }
  keep_first_of_each(mine);
  auto all = gather(comm, mine);
  keep_first_of_each(all);
  return all;
}

/// The extra points of all ranks on all ranks: as many as a seam has nodes, so few.
std::vector<MeshImage::Extra> MeshImage::gather(MPI_Comm comm, const std::vector<Extra>& mine) {
  static_assert(std::is_trivially_copyable_v<Extra>);
  const int ranks = ranks_of(comm), bytes = static_cast<int>(mine.size() * sizeof(Extra));
  std::vector<int> counts(ranks), starts(ranks + 1, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int r = 0; r < ranks; ++r) starts[r + 1] = starts[r] + counts[r];
  std::vector<Extra> all(static_cast<std::size_t>(starts[ranks]) / sizeof(Extra));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, comm);
  return all;
}

void MeshImage::set_points(MPI_Comm comm, const Mesh& mesh, const Rows& rows,
                           const std::vector<Extra>& extras) {
  std::vector<PetscInt> held;
  const auto hold = [&](PetscInt row, int node, const Vector2& position) {
    held.push_back(row);
    point_nodes_.push_back(node);
    positions_.push_back(position);
  };
  for (int node = 0; node < mesh.nodes.owned; ++node)
    if (rows.node[node] >= 0) hold(rows.node[node], node, mesh.nodes.position[node]);
  const auto owned_end = mesh.nodes.number.begin() + mesh.nodes.owned;
  for (std::size_t k = 0; k < extras.size(); ++k) {
    const auto at = std::lower_bound(mesh.nodes.number.begin(), owned_end, extras[k].node);
    if (at == owned_end || *at != extras[k].node) continue;
    hold(rows.node_count + static_cast<PetscInt>(k), static_cast<int>(at - mesh.nodes.number.begin()),
         extras[k].position);
  }
  points_ = FileOrder(comm, rows.node_count + static_cast<PetscInt>(extras.size()), held);
}

void MeshImage::set_cells(MPI_Comm comm, const Mesh& mesh, const Rows& rows,
                          const std::vector<Extra>& extras) {
  const Cells& cells = mesh.cells;
  const auto point_of = [&](int corner) {
    const int node = cells.corner_nodes[corner];
    const auto side = side_of(mesh, cells.corners[corner], mesh.nodes.position[node]);
    if (extras.empty() || (!side[0] && !side[1])) return rows.node[node];
    const Extra wanted{mesh.nodes.number[node], side, 0, {}};
    const auto found = std::lower_bound(extras.begin(), extras.end(), wanted,
                                        [](const Extra& a, const Extra& b) { return key(a) < key(b); });
    return rows.node_count + static_cast<PetscInt>(found - extras.begin());
  };
  std::vector<PetscInt> held;
  for (int cell = 0; cell < cells.size(); ++cell) {
    if (!cells.owned[cell] || rows.cell[cell] < 0) continue;
    held.push_back(rows.cell[cell]);
    std::vector<PetscInt> points;
    for (int k = cells.first[cell]; k < cells.first[cell + 1]; ++k) points.push_back(point_of(k));
    add_cell(cell, cells.region[cell], points);
  }
  agree_on_topology(comm);
  cells_ = FileOrder(comm, rows.cell_count, held);
}

MeshImage::MeshImage(MPI_Comm comm, const PlaneGrid& grid, std::size_t begin, std::size_t end)
    : block_(bounding_box(grid)), region_names_(grid.regions) {
  const int rank = rank_of(comm), ranks = ranks_of(comm);
  std::vector<PetscInt> held_points, held_cells;
  for (std::size_t point = rank; point < grid.points.size(); point += ranks) {
    held_points.push_back(static_cast<PetscInt>(point));
    point_nodes_.push_back(static_cast<int>(point));
    positions_.push_back(grid.points[point]);
  }
  for (std::size_t cell = begin; cell < end; ++cell) {
    held_cells.push_back(static_cast<PetscInt>(cell));
    const auto corners = grid.corners.begin();
    add_cell(static_cast<int>(cell - begin), grid.region[cell],
             {corners + grid.first[cell], corners + grid.first[cell + 1]});
  }
  agree_on_topology(comm);
  points_ = FileOrder(comm, static_cast<PetscInt>(grid.points.size()), held_points);
  cells_ = FileOrder(comm, static_cast<PetscInt>(grid.cells()), held_cells);
}

void MeshImage::add_cell(int place, int region, const std::vector<PetscInt>& points) {
  const bool triangle = points.size() == 3;
  cell_places_.push_back(place);
  region_rows_.push_back(region);
  corner_rows_.push_back(triangle ? xdmf_triangle : xdmf_quadrilateral);
  corner_rows_.insert(corner_rows_.end(), points.begin(), points.end());
  if (triangle) corner_rows_.push_back(-1);
}

void MeshImage::agree_on_topology(MPI_Comm comm) {
  std::array<int, 2> shapes{};  // are there triangles, quadrilaterals
  for (std::size_t row = 0; row < corner_rows_.size(); row += corner_width)
    shapes[corner_rows_[row] == xdmf_triangle ? 0 : 1] = 1;
  MPI_Allreduce(MPI_IN_PLACE, shapes.data(), 2, MPI_INT, MPI_MAX, comm);
  topology_ = !shapes[1] ? Topology::triangles : !shapes[0] ? Topology::quadrilaterals : Topology::mixed;
}

std::vector<double> MeshImage::coordinates() const {
  return points_.to_file(positions_.empty() ? nullptr : positions_.front().data(), 2);
}

std::vector<PetscInt> MeshImage::regions() const { return cells_.to_file(region_rows_.data(), 1); }

std::vector<PetscInt> MeshImage::connectivity() const {
  const auto rows = cells_.to_file(corner_rows_.data(), corner_width);
  const int skipped = topology_ == Topology::mixed ? 0 : 1;
  std::vector<PetscInt> packed;
  packed.reserve(rows.size());
  for (std::size_t row = 0; row < rows.size(); row += corner_width)
    for (int k = skipped; k < corner_width; ++k)
      if (rows[row + k] >= 0) packed.push_back(rows[row + k]);
  return packed;
}

}  // namespace slipscale
