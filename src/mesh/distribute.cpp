#include <algorithm>

#include "plex.hpp"
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

/// By plex point of the whole mesh: cells first, then vertices. Rank 0.
std::vector<PetscInt> numbers(const Whole& whole) {
  std::vector<PetscInt> number = whole.cell_number;
  number.insert(number.end(), whole.node_number.begin(), whole.node_number.end());
  return number;
}

std::vector<PetscInt> regions(const Whole& whole) {
  std::vector<PetscInt> region(whole.cell_number.size() + whole.node_number.size(), -1);
  for (std::size_t r = 0; r < whole.plain.region_cells.size(); ++r)
    for (const PetscInt cell : whole.plain.region_cells[r]) region[cell] = static_cast<PetscInt>(r);
  return region;
}

/// The edges of each boundary, on rank 0 only and then on all ranks: they are few.
std::vector<std::vector<NumberedSide>> numbered_sides(MPI_Comm comm, const Whole& whole) {
  std::vector<std::vector<NumberedSide>> sides;
  for (std::size_t b = 0; b < whole.boundaries.size(); ++b) {
    auto& own = sides.emplace_back(static_cast<std::size_t>(whole.boundaries[b].edge_count));
    if (!whole.plain.cells.empty())
      std::ranges::transform(whole.plain.boundaries[b].sides, own.begin(), [&](const CellSide& side) {
        const auto corners = corners_of(whole.plain.cells[side.cell]);
        return NumberedSide{whole.cell_number[side.cell], whole.node_number[corners[side.corner]],
                            whole.node_number[corners[(side.corner + 1) % corners.size()]]};
      });
    MPI_Bcast(own.data(), static_cast<int>(3 * own.size()), MPIU_INT, 0, comm);
  }
  return sides;
}

/// The DMPlex of the rank's part; `migration` stays empty on one rank.
OwnedDM cut(MPI_Comm comm, const Whole& whole, Partitioner partitioner, OwnedSF& migration) {
  OwnedDM dm = plex_of(comm, whole.plain), part;
  petsc(DMViewFromOptions(dm, nullptr, "-dm_view"));
  // Overlap by shared nodes: every cell around an owned node must be local.
  petsc(DMSetBasicAdjacency(dm, PETSC_FALSE, PETSC_TRUE));
  set_partition(comm, dm, partitioner, whole);
  petsc(DMPlexDistribute(dm, 1, migration.put(), part.put()));
  return part.get() ? std::move(part) : std::move(dm);
}

}  // namespace

void distribute(MPI_Comm comm, Whole&& whole, Partitioner partitioner, Mesh& mesh) {
  const auto sides = numbered_sides(comm, whole);
  std::vector<PetscInt> number = numbers(whole), region = regions(whole);
  OwnedSF migration;
  {
    const OwnedDM dm = cut(comm, whole, partitioner, migration);
    whole.plain = {}, whole.around = {}, whole.node_number = {}, whole.cell_number = {};
    petsc(DMGetCellCoordinatesLocalSetUp(dm));  // collective, so before the cells are looked at one by one
    petsc(DMViewFromOptions(dm, nullptr, "-dm_view_distributed"));
    number = migrate(migration, dm, std::move(number));
    region = migrate(migration, dm, std::move(region));
    extract(comm, dm, number, region, mesh);
  }
  for (std::size_t b = 0; b < whole.boundaries.size(); ++b)
    fill_boundary(sides[b], mesh.nodes, mesh.cells, whole.boundaries[b]);
  mesh.regions = std::move(whole.regions);
  mesh.boundaries = std::move(whole.boundaries);
  mesh.periodic = whole.periodic;
  mesh.lower = whole.lower;
  mesh.upper = whole.upper;
  mesh.shortest_edge = whole.shortest_edge;
  mesh.edge_rounding = whole.edge_rounding;
  mesh.nodes.total = whole.node_count;
  mesh.cells.total = whole.cell_count;
}

}  // namespace slipscale::mesh_stages
