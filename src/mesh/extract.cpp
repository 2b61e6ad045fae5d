#include <algorithm>
#include <numeric>

#include "plex.hpp"
#include "slipscale/base/parallel.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// 1 for the points this rank owns, by plex point.
std::vector<char> owned_points(DM dm) {
  PetscInt points = 0, leaves = 0;
  petsc(DMPlexGetChart(dm, nullptr, &points));
  std::vector<char> owned(static_cast<std::size_t>(points), 1);
  PetscSF sf = nullptr;
  petsc(DMGetPointSF(dm, &sf));
  const PetscInt* local = nullptr;
  petsc(PetscSFGetGraph(sf, nullptr, &leaves, &local, nullptr));
  for (PetscInt k = 0; k < leaves; ++k) owned[local ? local[k] : k] = 0;
  return owned;
}

/// Fills the plain arrays of a mesh from the rank's DMPlex.
class Extraction {
 public:
  Extraction(MPI_Comm comm, DM dm, const std::vector<PetscInt>& number, const std::vector<PetscInt>& region,
             Mesh& mesh)
      : comm_(comm),
        dm_(dm),
        geometry_(dm_),
        number_(number),
        region_(region),
        owned_(owned_points(dm_)),
        mesh_(mesh) {
    petsc(DMPlexGetHeightStratum(dm_, 0, &cell_begin_, &cell_end_));
    petsc(DMPlexGetDepthStratum(dm_, 0, &node_begin_, &node_end_));
  }

  void run() {
    nodes();
    ghosts();
    cells();
    report();
  }

 private:
  void nodes() {
    std::vector<PetscInt> vertices(static_cast<std::size_t>(node_end_ - node_begin_));
    std::iota(vertices.begin(), vertices.end(), node_begin_);
    std::sort(vertices.begin(), vertices.end(), [&](PetscInt a, PetscInt b) {
      return std::pair(!owned_[a], number_[a]) < std::pair(!owned_[b], number_[b]);
    });
    local_.resize(vertices.size());
    mesh_.nodes.number.reserve(vertices.size());
    mesh_.nodes.position.reserve(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      local_[vertices[k] - node_begin_] = static_cast<int>(k);
      mesh_.nodes.number.push_back(number_[vertices[k]]);
      mesh_.nodes.position.push_back(geometry_.position(vertices[k]));
      if (owned_[vertices[k]]) ++mesh_.nodes.owned;
    }
  }

  /// Every ghost learns its place in PETSc's numbering, where each rank's owned nodes are contiguous.
  void ghosts() {
    PetscInt offset = 0, mine = mesh_.nodes.owned;
    MPI_Exscan(&mine, &offset, 1, MPIU_INT, MPI_SUM, comm_);
    std::vector<PetscInt> index(number_.size(), -1);
    for (PetscInt v = node_begin_; v < node_end_; ++v)
      if (owned_[v]) index[v] = offset + local_[v - node_begin_];
    PetscSF sf = nullptr;
    petsc(DMGetPointSF(dm_, &sf));
    PetscInt roots = -1;
    petsc(PetscSFGetGraph(sf, &roots, nullptr, nullptr, nullptr));
    if (roots >= 0) {
      const std::vector<PetscInt> own = index;
      petsc(PetscSFBcastBegin(sf, MPIU_INT, own.data(), index.data(), MPI_REPLACE));
      petsc(PetscSFBcastEnd(sf, MPIU_INT, own.data(), index.data(), MPI_REPLACE));
    }
    mesh_.nodes.ghosts.assign(static_cast<std::size_t>(mesh_.nodes.size() - mesh_.nodes.owned), -1);
    for (PetscInt v = node_begin_; v < node_end_; ++v)
      if (!owned_[v]) mesh_.nodes.ghosts[local_[v - node_begin_] - mesh_.nodes.owned] = index[v];
  }

  void cells() {
    std::vector<PetscInt> order(static_cast<std::size_t>(cell_end_ - cell_begin_));
    std::iota(order.begin(), order.end(), cell_begin_);
    std::sort(order.begin(), order.end(), [&](PetscInt a, PetscInt b) { return number_[a] < number_[b]; });
    Cells& cells = mesh_.cells;
    reserve(order.size());
    cells.first.push_back(0);
    for (PetscInt cell : order) {
      const CellGeometry geometry = geometry_.cell(cell);
      const auto points = geometry.points();
      const std::size_t n = points.size();
      const auto by_number = [&](PetscInt a, PetscInt b) { return number_[a] < number_[b]; };
      const auto lowest =
          static_cast<std::size_t>(std::ranges::min_element(points, by_number) - points.begin());
      for (std::size_t k = 0; k < n; ++k) {
        cells.corner_nodes.push_back(local_[geometry.vertices[(lowest + k) % n] - node_begin_]);
        cells.corners.push_back(geometry.corners[(lowest + k) % n]);
      }
      cells.first.push_back(static_cast<int>(cells.corner_nodes.size()));
      cells.number.push_back(number_[cell]);
      cells.owned.push_back(owned_[cell]);
      cells.region.push_back(static_cast<int>(region_[cell]));
    }
  }

  /// They stay for the whole run, so they take what they need and not what lists that grow take.
  void reserve(std::size_t cells) {
    std::size_t corners = 0;
    for (PetscInt cell = cell_begin_; cell < cell_end_; ++cell) corners += geometry_.corner_count(cell);
    mesh_.cells.first.reserve(cells + 1);
    mesh_.cells.corner_nodes.reserve(corners);
    mesh_.cells.corners.reserve(corners);
    mesh_.cells.number.reserve(cells);
    mesh_.cells.owned.reserve(cells);
    mesh_.cells.region.reserve(cells);
  }

  /// Edges between cells of this rank and cells of others.
  PetscInt cut_edges() const {
    const Cells& cells = mesh_.cells;
    const auto node_count = static_cast<std::size_t>(mesh_.nodes.size());
    std::array<std::vector<char>, 2> beside{std::vector<char>(node_count, 0),
                                            std::vector<char>(node_count, 0)};
    for (int cell = 0; cell < cells.size(); ++cell)
      for (int k = cells.first[cell]; k < cells.first[cell + 1]; ++k)
        beside[cells.owned[cell]][cells.corner_nodes[k]] = 1;
    const auto between = [&](int node) { return beside[0][node] && beside[1][node]; };
    std::array<std::vector<std::pair<int, int>>, 2>
        sides;  // of other ranks' cells, of own ones; ends ascending
    for (int cell = 0; cell < cells.size(); ++cell)
      for (int k = 0, n = cells.corner_count(cell); k < n; ++k) {
        const int a = cells.corner_nodes[cells.first[cell] + k],
                  b = cells.corner_nodes[cells.first[cell] + (k + 1) % n];
        if (between(a) && between(b)) sides[cells.owned[cell]].emplace_back(std::min(a, b), std::max(a, b));
      }
    for (auto& each : sides) std::ranges::sort(each);
    std::vector<std::pair<int, int>> shared;
    std::ranges::set_intersection(sides[0], sides[1], std::back_inserter(shared));
    return static_cast<PetscInt>(shared.size());
  }

  void report() {
    const int ranks = ranks_of(comm_);
    PetscInt mine[5] = {0, 0, mesh_.nodes.owned, mesh_.nodes.size() - mesh_.nodes.owned, cut_edges()};
    for (char owned : mesh_.cells.owned) ++mine[owned ? 0 : 1];
    std::vector<PetscInt> all(static_cast<std::size_t>(5 * ranks));
    MPI_Allgather(mine, 5, MPIU_INT, all.data(), 5, MPIU_INT, comm_);
    PartitionReport& report = mesh_.partition;
    for (int r = 0; r < ranks; ++r) {
      report.owned_cells.push_back(all[5 * r]);
      report.overlap_cells.push_back(all[5 * r + 1]);
      report.owned_nodes.push_back(all[5 * r + 2]);
      report.ghost_nodes.push_back(all[5 * r + 3]);
      report.edge_cut += all[5 * r + 4];
    }
    report.edge_cut /= 2;  // both owners have counted it
  }

  MPI_Comm comm_;
  DM dm_;
  const PlexGeometry geometry_;
  const std::vector<PetscInt>&number_, &region_;
  std::vector<char> owned_;
  Mesh& mesh_;
  std::vector<int> local_;  ///< local node of each vertex
  PetscInt cell_begin_ = 0, cell_end_ = 0, node_begin_ = 0, node_end_ = 0;
};

}  // namespace

void extract(MPI_Comm comm, DM dm, const std::vector<PetscInt>& number, const std::vector<PetscInt>& region,
             Mesh& mesh) {
  Extraction(comm, dm, number, region, mesh).run();
}

}  // namespace slipscale::mesh_stages
