#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "gmsh_stream.hpp"
#include "slipscale/base/vector2.hpp"

namespace slipscale::mesh_stages {

/// A physical group that has a name of its own.
struct PhysicalName {
  int dimension = 0, tag = 0;
  std::string name;
};

/// One entry of $Periodic: an entity that repeats another.
struct PeriodicLink {
  int dimension = 0, entity = 0, original = 0;  ///< gmsh's tags of point, curve or surface
  bool is_turned = false;                       ///< its map is no mere shift
  std::vector<std::array<int, 2>> pairs;        ///< node and the one that it repeats
};

/// A plane mesh as a gmsh file holds it. Nodes are counted from 0 in the order of the file, and so are the
/// curves and surfaces that gmsh calls entities.
struct GmshMesh {
  struct Cell {
    std::array<int, 4> nodes{};  ///< a triangle's last is -1
    int surface = 0;
  };
  struct Line {
    std::array<int, 2> nodes{};
    int curve = 0;
  };
  std::vector<PhysicalName> names;
  std::vector<Vector2> nodes;  ///< m
  std::vector<Cell> cells;     ///< triangles before quadrilaterals, each in the order of the file
  std::vector<Line> lines;
  std::vector<int> surface_tags;  ///< gmsh's, of each surface
  /// Physical tags of each entity. The sign, which tells the orientation of the entity, is dropped.
  std::vector<std::vector<int>> curve_groups, surface_groups;
  std::vector<PeriodicLink> links;
  bool is_periodic = false;         ///< has the section
  bool is_of_higher_order = false;  ///< cells have nodes besides their corners, which are left out
};

/// Reads what follows the section $MeshFormat of version 4.1, in text or binary. Throws GmshFault. One rank.
GmshMesh read_gmsh_mesh(GmshStream& stream);

}  // namespace slipscale::mesh_stages
