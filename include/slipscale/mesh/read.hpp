#pragma once

#include "slipscale/base/options.hpp"
#include "slipscale/mesh/mesh.hpp"

namespace slipscale {

enum class Partitioner { metis, simple, ptscotch };

struct MeshSource {
  std::string file;
  Partitioner partitioner = Partitioner::metis;
  int refine = 0;              ///< uniform refinements, made before partitioning
  bool cut = false;            ///< leave the sides open that the file makes periodic
  bool cut_by_choice = false;  ///< because -mesh_periodic says so: refused where there is nothing to cut
};

Schema mesh_schema();
MeshSource mesh_source(const Options& options);

/// For programs that take a periodic mesh as a block too: the same, with the choice to open its sides.
Schema periodic_mesh_schema();
MeshSource periodic_mesh_source(const Options& options);

/// Reads a gmsh file of MSH 4.1, text or binary, into a partitioned mesh with one layer of overlap.
///
/// Regions and boundaries are gmsh's physical surfaces and curves, by name; a group without one is called
/// surface_<tag> or curve_<tag>. A group holds what gmsh says that it does, whatever the sign of its tag.
/// Surfaces that run clockwise are turned, and of cells of higher order the corners are taken; `Mesh::notes`
/// tells both.
///
/// Throws `UserError` when the file is of another format (with the command that converts it), damaged, not
/// plane, or no sound body: a cell without region or in two, inverted or degenerate; cells that overlap;
/// nodes that coincide but are not one; parts that share no node; periodic sides that are no shifts of one
/// another or are paired in part, or fewer than three cells across a period. Collective.
Mesh read_mesh(MPI_Comm comm, const MeshSource& source);

/// The table printed at start: names, tags, sizes, and what each rank holds.
std::string describe(const Mesh& mesh, const std::vector<std::string>& region_materials);

}  // namespace slipscale
