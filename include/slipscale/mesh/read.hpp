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

/// Reads a gmsh file into a partitioned mesh with one layer of overlap.
///
/// Regions and boundaries are gmsh's physical surfaces and curves, by name. Throws `UserError` when the file
/// cannot be read, is not plane, names no region, leaves a cell without region, has an inverted or degenerate
/// cell, or is periodic but written as MSH 2 (which does not carry periodicity into a DMPlex). Collective.
Mesh read_mesh(MPI_Comm comm, const MeshSource& source);

/// The table printed at start: names, tags, sizes, and what each rank holds.
std::string describe(const Mesh& mesh, const std::vector<std::string>& region_materials);

}  // namespace slipscale
