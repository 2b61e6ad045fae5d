#include "plex.hpp"

#include <algorithm>

#include "slipscale/base/parallel.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// The points of a stratum [begin, end) that carry `value` in the label of this name, ascending.
std::vector<PetscInt> labelled(DM dm, const std::string& name, int value, PetscInt begin, PetscInt end) {
  std::vector<PetscInt> points;
  DMLabel label = nullptr;
  petsc(DMGetLabel(dm, name.c_str(), &label));
  if (!label) return points;
  OwnedIS stratum;
  petsc(DMLabelGetStratumIS(label, value, stratum.put()));
  if (!stratum.get()) return points;
  PetscInt count = 0;
  const PetscInt* indices = nullptr;
  petsc(ISGetLocalSize(stratum, &count));
  petsc(ISGetIndices(stratum, &indices));
  std::copy_if(indices, indices + count, std::back_inserter(points),
               [&](PetscInt point) { return point >= begin && point < end; });
  petsc(ISRestoreIndices(stratum, &indices));
  std::ranges::sort(points);
  return points;
}

OwnedDM create_dm(MPI_Comm comm, const MeshSource& source, bool interpolate, std::string& fault) {
  // One label for each physical name; without it only the first group of an entity in several would be kept.
  petsc(PetscOptionsSetValue(nullptr, "-dm_plex_gmsh_use_regions", "true"));
  petsc(PetscOptionsSetValue(nullptr, "-dm_plex_gmsh_periodic", source.cut ? "false" : "true"));
  OwnedDM dm;
  const PetscErrorCode code =
      DMPlexCreateGmshFromFile(comm, source.file.c_str(), interpolate ? PETSC_TRUE : PETSC_FALSE, dm.put());
  petsc(PetscOptionsClearValue(nullptr, "-dm_plex_gmsh_use_regions"));
  petsc(PetscOptionsClearValue(nullptr, "-dm_plex_gmsh_periodic"));
  if (code)
    fault = "-mesh_file: '" + source.file + "' cannot be read as a gmsh mesh (" + take_petsc_message() +
            "); write it again with gmsh -2 -format msh41";
  return dm;
}

/// Whether more points than the vertices carry coordinates: cells of second or higher order.
bool is_curved(DM dm, PetscInt vertices) {
  Vec coordinates = nullptr;
  PetscInt size = 0;
  petsc(DMGetCoordinatesLocal(dm, &coordinates));
  petsc(VecGetLocalSize(coordinates, &size));
  return size != 2 * vertices;
}

std::string fault_in_cells(DM dm, const MeshSource& source) {
  PetscInt begin = 0, end = 0, first = 0, last = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  petsc(DMPlexGetDepthStratum(dm, 0, &first, &last));
  const PlexGeometry plex(dm);
  const bool curved = is_curved(dm, last - first);
  for (PetscInt cell = begin; cell < end; ++cell) {
    PetscInt sides = 0;
    petsc(DMPlexGetConeSize(dm, cell, &sides));
    const int own = plex.own_corners(cell);
    // A DMPlex merges the edges of a cell that have the same ends.
    if (sides < own && own <= 4) return too_narrow(source, plex.cell(cell).corners[0]);
    if (curved || (sides != 3 && sides != 4) || (own > 0 && own != sides))
      return "mesh '" + source.file +
             "' has cells that are not three- or four-cornered and straight; use gmsh -order 1";
  }
  return "";
}

CellSide side_of(DM dm, const PlainMesh& mesh, PetscInt edge, PetscInt first_vertex) {
  const PetscInt *ends = nullptr, *support = nullptr;
  petsc(DMPlexGetCone(dm, edge, &ends));
  petsc(DMPlexGetSupport(dm, edge, &support));
  const auto corners = corners_of(mesh.cells[support[0]]);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const PetscInt a = corners[k] + first_vertex, b = corners[(k + 1) % corners.size()] + first_vertex;
    if ((a == ends[0] && b == ends[1]) || (a == ends[1] && b == ends[0]))
      return {support[0], static_cast<int>(k)};
  }
  throw LibraryError("an edge is not among the edges of the cell beside it");
}

/// Reads back a DMPlex with edges whose labels are the regions and boundaries. Rank 0.
PlainMesh plain_mesh(DM dm, const std::vector<Region>& regions, const std::vector<Boundary>& boundaries) {
  PetscInt begin = 0, end = 0, first = 0, last = 0, first_edge = 0, last_edge = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  petsc(DMPlexGetDepthStratum(dm, 0, &first, &last));
  petsc(DMPlexGetDepthStratum(dm, 1, &first_edge, &last_edge));
  if (begin != 0) throw LibraryError("the points of a DMPlex do not begin with the cells");
  PetscBool is_torus = PETSC_FALSE;
  petsc(DMGetCoordinatesLocalizedLocal(dm, &is_torus));
  const PlexGeometry plex(dm);
  PlainMesh mesh;
  for (PetscInt vertex = first; vertex < last; ++vertex) mesh.position.push_back(plex.position(vertex));
  if (is_torus) mesh.own.assign(static_cast<std::size_t>(end), -1);
  for (PetscInt cell = 0; cell < end; ++cell) {
    const CellGeometry geometry = plex.cell(cell);
    CellVertices& corners = mesh.cells.emplace_back(geometry.vertices);
    for (std::size_t k = 0; k < geometry.size(); ++k) corners[k] -= first;
    if (!is_torus || plex.own_corners(cell) == 0) continue;
    mesh.own[cell] = static_cast<PetscInt>(mesh.own_corners.size());
    mesh.own_corners.push_back(geometry.corners);
  }
  if (is_torus) settle_seam(mesh);
  for (const Region& region : regions)
    mesh.region_cells.push_back(labelled(dm, region.name, region.tag, 0, end));
  for (const Boundary& boundary : boundaries) {
    BoundarySides& found = mesh.boundaries.emplace_back();
    for (const PetscInt edge : labelled(dm, boundary.name, boundary.tag, first_edge, last_edge)) {
      PetscInt cells = 0;
      petsc(DMPlexGetSupportSize(dm, edge, &cells));
      if (cells > 1) found.interior = true;
      found.sides.push_back(side_of(dm, mesh, edge, first));
    }
  }
  return mesh;
}

void mark(DM dm, const std::string& name, int value, const std::vector<PetscInt>& points) {
  petsc(DMCreateLabel(dm, name.c_str()));
  DMLabel label = nullptr;
  petsc(DMGetLabel(dm, name.c_str(), &label));
  for (const PetscInt point : points) petsc(DMLabelSetValue(label, point, value));
}

/// Sides in the order of the corners, as DMPlexInterpolate makes them of the cells.
std::vector<PetscInt> edges_of(DM dm, const std::vector<CellSide>& sides) {
  std::vector<PetscInt> edges;
  for (const CellSide& side : sides) {
    const PetscInt* cone = nullptr;
    petsc(DMPlexGetCone(dm, side.cell, &cone));
    edges.push_back(cone[side.corner]);
  }
  return edges;
}

}  // namespace

PlainMesh read_by_petsc(MPI_Comm comm, const MeshSource& source, const std::vector<Region>& regions,
                        const std::vector<Boundary>& boundaries) {
  const int rank = rank_of(comm), ranks = ranks_of(comm);
  // PETSc parses the file on rank 0 and would leave the other ranks waiting when it fails there; so the file
  // is first read by rank 0 alone.
  std::string fault;
  if (rank == 0 && ranks > 1) create_dm(PETSC_COMM_SELF, source, false, fault);
  throw_together(comm, fault);
  const OwnedDM dm = create_dm(comm, source, true, fault);
  throw_together(comm, fault);
  PetscInt dimension = 0;
  petsc(DMGetDimension(dm, &dimension));
  if (dimension != 2)
    throw UserError("mesh '" + source.file + "' has " + std::to_string(dimension) +
                    "-dimensional cells, but the model is plane; mesh the surfaces only (gmsh -2)");
  petsc(DMGetCellCoordinatesLocalSetUp(dm));
  throw_together(comm, rank == 0 ? fault_in_cells(dm, source) : "");
  return rank == 0 ? plain_mesh(dm, regions, boundaries) : PlainMesh{};
}

PlainMesh refine(MPI_Comm comm, const PlainMesh& mesh, int times, const std::vector<Region>& regions,
                 const std::vector<Boundary>& boundaries) {
  const int rank = rank_of(comm);
  OwnedDM dm = plex_of(comm, mesh, true);
  for (std::size_t r = 0; r < regions.size(); ++r)
    mark(dm, regions[r].name, regions[r].tag, rank == 0 ? mesh.region_cells[r] : std::vector<PetscInt>{});
  for (std::size_t b = 0; b < boundaries.size(); ++b)
    mark(dm, boundaries[b].name, boundaries[b].tag,
         rank == 0 ? edges_of(dm, mesh.boundaries[b].sides) : std::vector<PetscInt>{});
  for (int k = 0; k < times; ++k) {
    OwnedDM finer;
    petsc(DMPlexSetRefinementUniform(dm, PETSC_TRUE));
    petsc(DMRefine(dm, comm, finer.put()));
    dm = std::move(finer);
  }
  petsc(DMGetCellCoordinatesLocalSetUp(dm));
  return rank == 0 ? plain_mesh(dm, regions, boundaries) : PlainMesh{};
}

}  // namespace slipscale::mesh_stages
