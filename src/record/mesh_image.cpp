#include "slipscale/record/mesh_image.hpp"

#include <algorithm>
#include <tuple>

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

}  // namespace

MeshImage::MeshImage(MPI_Comm comm, const Mesh& mesh) {
  std::vector<Extra> extras;
  if (mesh.periodic[0] || mesh.periodic[1]) extras = extra_points(comm, mesh);
  set_points(comm, mesh, extras);
  set_cells(comm, mesh, extras);
}

std::vector<MeshImage::Extra> MeshImage::extra_points(MPI_Comm comm, const Mesh& mesh) const {
  std::vector<Extra> mine;
  const Cells& cells = mesh.cells;
  for (int cell = 0; cell < cells.size(); ++cell)
    for (int k = cells.first[cell]; cells.owned[cell] && k < cells.first[cell + 1]; ++k) {
      const int node = cells.corner_nodes[k];
      const auto side = side_of(mesh, cells.corners[k], mesh.nodes.position[node]);
      if (side[0] || side[1])
        mine.push_back({mesh.nodes.number[node], side, cells.number[cell], cells.corners[k]});
    }
  keep_first_of_each(mine);
  auto all = gather(comm, mine);
  keep_first_of_each(all);
  return all;
}

/// The extra points of all ranks on all ranks: as many as a seam has nodes, so few.
std::vector<MeshImage::Extra> MeshImage::gather(MPI_Comm comm, const std::vector<Extra>& mine) {
  static_assert(std::is_trivially_copyable_v<Extra>);
  int ranks = 1, bytes = static_cast<int>(mine.size() * sizeof(Extra));
  MPI_Comm_size(comm, &ranks);
  std::vector<int> counts(ranks), starts(ranks + 1, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int r = 0; r < ranks; ++r) starts[r + 1] = starts[r] + counts[r];
  std::vector<Extra> all(static_cast<std::size_t>(starts[ranks]) / sizeof(Extra));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, comm);
  return all;
}

void MeshImage::set_points(MPI_Comm comm, const Mesh& mesh, const std::vector<Extra>& extras) {
  const auto owned_end = mesh.nodes.number.begin() + mesh.nodes.owned;
  std::vector<PetscInt> rows(mesh.nodes.number.begin(), owned_end);
  positions_.assign(mesh.nodes.position.begin(), mesh.nodes.position.begin() + mesh.nodes.owned);
  for (int node = 0; node < mesh.nodes.owned; ++node) point_nodes_.push_back(node);
  for (std::size_t k = 0; k < extras.size(); ++k) {
    const auto at = std::lower_bound(mesh.nodes.number.begin(), owned_end, extras[k].node);
    if (at == owned_end || *at != extras[k].node) continue;
    rows.push_back(mesh.nodes.total + static_cast<PetscInt>(k));
    positions_.push_back(extras[k].position);
    point_nodes_.push_back(static_cast<int>(at - mesh.nodes.number.begin()));
  }
  points_ = FileOrder(comm, mesh.nodes.total + static_cast<PetscInt>(extras.size()), rows);
}

void MeshImage::set_cells(MPI_Comm comm, const Mesh& mesh, const std::vector<Extra>& extras) {
  const Cells& cells = mesh.cells;
  std::vector<PetscInt> rows;
  std::array<int, 2> shapes{};  // are there triangles, quadrilaterals
  for (int cell = 0; cell < cells.size(); ++cell) {
    if (!cells.owned[cell]) continue;
    const int corners = cells.corner_count(cell);
    shapes[corners == 3 ? 0 : 1] = 1;
    rows.push_back(cells.number[cell]);
    cell_places_.push_back(cell);
    corner_rows_.push_back(corners == 3 ? xdmf_triangle : xdmf_quadrilateral);
    for (int k = cells.first[cell]; k < cells.first[cell + 1]; ++k) {
      const int node = cells.corner_nodes[k];
      PetscInt point = mesh.nodes.number[node];
      const auto side = side_of(mesh, cells.corners[k], mesh.nodes.position[node]);
      if (!extras.empty() && (side[0] || side[1])) {
        const Extra wanted{point, side, 0, {}};
        const auto found = std::lower_bound(extras.begin(), extras.end(), wanted,
                                            [](const Extra& a, const Extra& b) { return key(a) < key(b); });
        point = mesh.nodes.total + static_cast<PetscInt>(found - extras.begin());
      }
      corner_rows_.push_back(point);
    }
    if (corners == 3) corner_rows_.push_back(-1);
  }
  MPI_Allreduce(MPI_IN_PLACE, shapes.data(), 2, MPI_INT, MPI_MAX, comm);
  topology_ = !shapes[1] ? Topology::triangles : !shapes[0] ? Topology::quadrilaterals : Topology::mixed;
  cells_ = FileOrder(comm, cells.total, rows);
}

std::vector<double> MeshImage::coordinates() const {
  return points_.to_file(positions_.empty() ? nullptr : positions_.front().data(), 2);
}

std::vector<PetscInt> MeshImage::regions(const Mesh& mesh) const {
  std::vector<PetscInt> regions;
  for (int cell : cell_places_) regions.push_back(mesh.cells.region[cell]);
  return cells_.to_file(regions.data(), 1);
}

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
