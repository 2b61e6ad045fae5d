#include <algorithm>
#include <map>
#include <numeric>

#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// Sends one integer a point from the whole mesh to the parts. Null `migration`: the mesh has not moved.
std::vector<PetscInt> migrate(PetscSF migration, DM part, std::vector<PetscInt> whole) {
  if (!migration) return whole;
  PetscInt points = 0;
  petsc(DMPlexGetChart(part, nullptr, &points));
  std::vector<PetscInt> local(static_cast<std::size_t>(points), -1);
  petsc(PetscSFBcastBegin(migration, MPIU_INT, whole.data(), local.data(), MPI_REPLACE));
  petsc(PetscSFBcastEnd(migration, MPIU_INT, whole.data(), local.data(), MPI_REPLACE));
  return local;
}

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
  Extraction(MPI_Comm comm, DM dm, const std::vector<PetscInt>& number, Mesh& mesh)
      : comm_(comm), dm_(dm), geometry_(dm), number_(number), owned_(owned_points(dm)), mesh_(mesh) {
    petsc(DMPlexGetHeightStratum(dm, 0, &cell_begin_, &cell_end_));
    petsc(DMPlexGetDepthStratum(dm, 1, &edge_begin_, &edge_end_));
    petsc(DMPlexGetDepthStratum(dm, 0, &node_begin_, &node_end_));
  }

  void run() {
    nodes();
    ghosts();
    cells();
    for (Boundary& boundary : mesh_.boundaries) edges(boundary);
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
    const auto region = regions();
    Cells& cells = mesh_.cells;
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
      cells.region.push_back(region[cell - cell_begin_]);
    }
  }

  std::vector<int> regions() const {
    std::vector<int> region(static_cast<std::size_t>(cell_end_ - cell_begin_), -1);
    for (std::size_t r = 0; r < mesh_.regions.size(); ++r)
      for (PetscInt cell : labelled(dm_, mesh_.regions[r].name, mesh_.regions[r].tag, cell_begin_, cell_end_))
        region[cell - cell_begin_] = static_cast<int>(r);
    return region;
  }

  void edges(Boundary& boundary) {
    for (PetscInt edge : labelled(dm_, boundary.name, boundary.tag, edge_begin_, edge_end_)) {
      const PetscInt *ends = nullptr, *support = nullptr;
      petsc(DMPlexGetCone(dm_, edge, &ends));
      petsc(DMPlexGetSupport(dm_, edge, &support));
      if (owned_[ends[0]] || owned_[ends[1]]) boundary.edges.push_back(local_edge(support[0], edge));
    }
    const auto& number = mesh_.nodes.number;
    std::sort(boundary.edges.begin(), boundary.edges.end(),
              [&](const BoundaryEdge& a, const BoundaryEdge& b) {
                return std::pair(number[a.nodes[0]], number[a.nodes[1]]) <
                       std::pair(number[b.nodes[0]], number[b.nodes[1]]);
              });
    for (const auto& edge : boundary.edges)
      for (int node : edge.nodes)
        if (node < mesh_.nodes.owned) boundary.nodes.push_back(node);
    std::sort(boundary.nodes.begin(), boundary.nodes.end());
    boundary.nodes.erase(std::unique(boundary.nodes.begin(), boundary.nodes.end()), boundary.nodes.end());
  }

  BoundaryEdge local_edge(PetscInt cell, PetscInt edge) const {
    const CellSide side = geometry_.side(cell, edge);
    const bool ascending = number_[side.vertices[0]] < number_[side.vertices[1]];
    BoundaryEdge result;
    for (int end = 0; end < 2; ++end) {
      const int from = ascending ? end : 1 - end;
      result.nodes[end] = local_[side.vertices[from] - node_begin_];
      result.ends[end] = side.ends[from];
    }
    result.outward = side.outward;
    return result;
  }

  void report() {
    int ranks = 1;
    MPI_Comm_size(comm_, &ranks);
    PetscInt mine[5] = {0, 0, mesh_.nodes.owned, mesh_.nodes.size() - mesh_.nodes.owned, 0};
    for (char owned : mesh_.cells.owned) ++mine[owned ? 0 : 1];
    for (PetscInt edge = edge_begin_; edge < edge_end_; ++edge) {
      PetscInt sides = 0;
      const PetscInt* cells = nullptr;
      petsc(DMPlexGetSupportSize(dm_, edge, &sides));
      petsc(DMPlexGetSupport(dm_, edge, &cells));
      if (sides == 2 && owned_[cells[0]] != owned_[cells[1]]) ++mine[4];
    }
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
  const std::vector<PetscInt>& number_;
  std::vector<char> owned_;
  Mesh& mesh_;
  std::vector<int> local_;  ///< local node of each vertex
  PetscInt cell_begin_ = 0, cell_end_ = 0, edge_begin_ = 0, edge_end_ = 0, node_begin_ = 0, node_end_ = 0;
};

}  // namespace

void distribute(MPI_Comm comm, Whole&& whole, Partitioner partitioner, Mesh& mesh) {
  // Overlap by shared nodes: every cell around an owned node must be local.
  petsc(DMSetBasicAdjacency(whole.dm, PETSC_FALSE, PETSC_TRUE));
  set_partition(whole.dm, partitioner, whole.number);
  OwnedSF migration;
  OwnedDM parts;
  petsc(DMPlexDistribute(whole.dm, 1, migration.put(), parts.put()));
  mesh.dm = parts.get() ? std::move(parts) : std::move(whole.dm);
  petsc(DMGetCellCoordinatesLocalSetUp(mesh.dm));  // collective, so before the cells are looked at one by one
  const auto number = migrate(migration, mesh.dm, std::move(whole.number));
  mesh.regions = std::move(whole.regions);
  mesh.boundaries = std::move(whole.boundaries);
  mesh.periodic = whole.periodic;
  mesh.lower = whole.lower;
  mesh.upper = whole.upper;
  mesh.shortest_edge = whole.shortest_edge;
  mesh.nodes.total = whole.node_count;
  mesh.cells.total = whole.cell_count;
  Extraction(comm, mesh.dm, number, mesh).run();
  petsc(DMViewFromOptions(mesh.dm, nullptr, "-dm_view_distributed"));
}

}  // namespace slipscale::mesh_stages
