#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

#include "slipscale/base/print.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

std::string at(const Vector2& x) { return format("(%g, %g) m", x[0], x[1]); }

Vector2 centre(const CellGeometry& cell) {
  Vector2 sum{};
  for (std::size_t k = 0; k < cell.size; ++k)
    sum = {sum[0] + cell.corners[k][0], sum[1] + cell.corners[k][1]};
  const double n = static_cast<double>(cell.size);
  return {sum[0] / n, sum[1] / n};
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

/// PETSc parses the file on rank 0 and would leave the other ranks waiting when it fails there; so a file
/// that was not looked through number by number is first read by rank 0 alone.
OwnedDM create_dm(MPI_Comm comm, const MeshSource& source, const GmshFile& file) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  std::string fault;
  if (rank == 0 && ranks > 1 && !file.vouched) create_dm(PETSC_COMM_SELF, source, false, fault);
  throw_together(comm, fault);
  OwnedDM dm = create_dm(comm, source, true, fault);
  throw_together(comm, fault);
  petsc(DMViewFromOptions(dm, nullptr, "-dm_view"));
  return dm;
}

void refine(MPI_Comm comm, int times, OwnedDM& dm) {
  for (int k = 0; k < times; ++k) {
    OwnedDM finer;
    petsc(DMPlexSetRefinementUniform(dm, PETSC_TRUE));
    petsc(DMRefine(dm, comm, finer.put()));
    dm = std::move(finer);
  }
}

/// Whether more points than the vertices carry coordinates: cells of second or higher order.
bool is_curved(DM dm, PetscInt vertices) {
  Vec coordinates = nullptr;
  PetscInt size = 0;
  petsc(DMGetCoordinatesLocal(dm, &coordinates));
  petsc(VecGetLocalSize(coordinates, &size));
  return size != 2 * vertices;
}

/// What is measured on rank 0 and told to all.
struct Survey {
  Survey(const MeshSource& mesh_source, Whole& mesh) : source(mesh_source), whole(mesh) {}

  const MeshSource& source;
  Whole& whole;
  const PlexGeometry geometry{whole.dm};
  std::string fault;
  std::vector<int> region_of;  ///< by cell

  void regions() {
    PetscInt begin = 0, end = 0;
    petsc(DMPlexGetHeightStratum(whole.dm, 0, &begin, &end));
    region_of.assign(static_cast<std::size_t>(end - begin), -1);
    for (std::size_t r = 0; r < whole.regions.size() && fault.empty(); ++r) {
      Region& region = whole.regions[r];
      for (PetscInt cell : labelled(whole.dm, region.name, region.tag, begin, end)) {
        int& known = region_of[cell - begin];
        if (known >= 0) {
          fault = "mesh '" + source.file + "': cell at " + at(centre(geometry.cell(cell))) +
                  " belongs to both regions '" + whole.regions[known].name + "' and '" + region.name +
                  "'; leave it in one physical surface";
          return;
        }
        known = static_cast<int>(r);
        ++region.cells;
        region.area += geometry.cell(cell).area();
      }
      if (region.cells == 0)
        fault = "mesh '" + source.file + "': region '" + region.name +
                "' holds no cell; remove this physical surface or mesh it";
    }
  }

  void cells() {
    PetscInt begin = 0, end = 0, node_begin = 0, node_end = 0;
    petsc(DMPlexGetHeightStratum(whole.dm, 0, &begin, &end));
    petsc(DMPlexGetDepthStratum(whole.dm, 0, &node_begin, &node_end));
    whole.lower.fill(std::numeric_limits<double>::max());
    whole.upper.fill(-std::numeric_limits<double>::max());
    whole.shortest_edge = std::numeric_limits<double>::max();
    std::vector<char> seen(static_cast<std::size_t>(node_end - node_begin), 0);
    curved = is_curved(whole.dm, node_end - node_begin);
    for (PetscInt cell = begin; cell < end && fault.empty(); ++cell) check(cell, begin, node_begin, seen);
    if (fault.empty() && std::find(seen.begin(), seen.end(), 0) != seen.end())
      fault = "mesh '" + source.file +
              "' has nodes that belong to no cell; save only the physical groups that are meshed";
    whole.cell_count = end - begin;
    whole.node_count = node_end - node_begin;
  }

  void check(PetscInt cell, PetscInt begin, PetscInt node_begin, std::vector<char>& seen) {
    const CellGeometry shape = geometry.cell(cell);
    const std::size_t n = shape.size;
    if ((n != 3 && n != 4) || shape.corner_count != n || curved) {
      fault = "mesh '" + source.file +
              "' has cells that are not three- or four-cornered and straight; use gmsh -order 1";
      return;
    }
    double longest = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vector2 &a = shape.corners[k], &b = shape.corners[(k + 1) % n];
      const double edge = std::hypot(b[0] - a[0], b[1] - a[1]);
      longest = std::max(longest, edge);
      whole.shortest_edge = std::min(whole.shortest_edge, edge);
      const Vector2 home = geometry.position(shape.vertices[k]);
      seen[shape.vertices[k] - node_begin] = 1;
      for (int axis = 0; axis < 2; ++axis) {
        whole.lower[axis] = std::min(whole.lower[axis], a[axis]);
        whole.upper[axis] = std::max(whole.upper[axis], a[axis]);
        if (a[axis] != home[axis]) shifts[axis] = std::max(shifts[axis], std::abs(a[axis] - home[axis]));
      }
    }
    // Relative to its longest edge, so that a mesh in millimetres or metres is judged alike.
    const double smallest = shape.smallest_corner();
    if (!(smallest > 1e-9 * longest * longest))  // not a number counts as well
      fault = "mesh '" + source.file + "': the cell at " + at(centre(shape)) +
              (smallest < 0 ? " is inverted (its corners do not run counter-clockwise, or it is not convex)"
                            : " is degenerate (it has next to no area)") +
              "; mend the mesh, or reverse the surface's orientation";
    else if (region_of[cell - begin] < 0)
      fault = "mesh '" + source.file + "': the cell at " + at(centre(shape)) +
              " belongs to no region; put its surface in a Physical Surface (known: " + names(whole.regions) +
              ")";
  }

  void boundaries() {
    PetscInt begin = 0, end = 0;
    petsc(DMPlexGetDepthStratum(whole.dm, 1, &begin, &end));
    for (Boundary& boundary : whole.boundaries) {
      if (!fault.empty()) return;
      Vector2 sum{};
      for (PetscInt edge : labelled(whole.dm, boundary.name, boundary.tag, begin, end)) {
        PetscInt sides = 0;
        const PetscInt* support = nullptr;
        petsc(DMPlexGetSupportSize(whole.dm, edge, &sides));
        petsc(DMPlexGetSupport(whole.dm, edge, &support));
        if (sides > 1) boundary.interior = true;
        const Vector2 outward = geometry.side(support[0], edge).outward;
        sum = {sum[0] + outward[0], sum[1] + outward[1]};
        boundary.length += std::hypot(outward[0], outward[1]);
        ++boundary.edge_count;
      }
      if (boundary.edge_count == 0)
        fault = "mesh '" + source.file + "': boundary '" + boundary.name +
                "' holds no edge; remove this physical curve or mesh it";
      const double size = std::hypot(sum[0], sum[1]);
      if (!boundary.interior && size > 1e-6 * boundary.length)
        boundary.normal = {sum[0] / size, sum[1] / size};
    }
  }

  static std::string names(const std::vector<Region>& regions) {
    std::string list;
    for (const auto& region : regions) list += (list.empty() ? "" : ", ") + region.name;
    return list;
  }

  bool curved = false;  ///< the file holds cells of second or higher order
  Vector2 shifts{};     ///< largest distance between a corner and its vertex: the period, where there is one
};

void tell_all(MPI_Comm comm, Whole& whole) {
  std::vector<double> numbers;
  std::size_t next = 0;
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  // The same list is walked twice: rank 0 writes it, the others read it.
  const auto exchange = [&](auto&& visit) {
    for (auto& r : whole.regions) visit(r.cells), visit(r.area);
    for (auto& b : whole.boundaries)
      visit(b.edge_count), visit(b.length), visit(b.interior), visit(b.normal[0]), visit(b.normal[1]);
    for (int k = 0; k < 2; ++k) visit(whole.periodic[k]), visit(whole.lower[k]), visit(whole.upper[k]);
    visit(whole.shortest_edge), visit(whole.node_count), visit(whole.cell_count);
  };
  exchange([&](auto& value) { numbers.push_back(static_cast<double>(value)); });
  MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0, comm);
  exchange(
      [&](auto& value) { value = static_cast<std::remove_reference_t<decltype(value)>>(numbers[next++]); });
}

}  // namespace

Whole load_whole(MPI_Comm comm, const MeshSource& source, const GmshFile& file) {
  Whole whole;
  for (const auto& entry : file.names) {
    if (entry.dimension == 2) whole.regions.push_back({entry.name, entry.tag});
    if (entry.dimension == 1) whole.boundaries.push_back({.name = entry.name, .tag = entry.tag});
  }
  whole.dm = create_dm(comm, source, file);
  PetscInt dimension = 0;
  petsc(DMGetDimension(whole.dm, &dimension));
  if (dimension != 2)
    throw UserError("mesh '" + source.file + "' has " + std::to_string(dimension) +
                    "-dimensional cells, but the model is plane; mesh the surfaces only (gmsh -2)");
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  throw_together(comm, rank == 0 ? fault_in_torus(whole.dm, source) : "");
  refine(comm, source.refine, whole.dm);
  petsc(DMGetCellCoordinatesLocalSetUp(whole.dm));
  settle_seam(whole.dm);

  Survey survey(source, whole);
  if (rank == 0) {
    survey.regions();
    if (survey.fault.empty()) survey.cells();
    if (survey.fault.empty()) survey.boundaries();
    for (int axis = 0; axis < 2; ++axis)
      whole.periodic[axis] = survey.shifts[axis] > 0.5 * whole.shortest_edge;
  }
  throw_together(comm, survey.fault);
  tell_all(comm, whole);
  if (rank == 0) whole.number = whole_mesh_order(whole.dm, survey.geometry);
  return whole;
}

}  // namespace slipscale::mesh_stages
