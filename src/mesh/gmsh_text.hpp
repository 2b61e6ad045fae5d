#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gmsh_sections.hpp"
#include "slipscale/base/vector2.hpp"

namespace slipscale::mesh_stages {

/// A plane mesh as a gmsh file holds it. Nodes are counted from 0 in the order of the file, and so are the
/// curves and surfaces that gmsh calls entities.
struct GmshMesh {
  struct Cell {
    std::array<int, 4> nodes{};  ///< counter-clockwise; a triangle's last is -1
    int surface = 0;
  };
  struct Line {
    std::array<int, 2> nodes{};
    int curve = 0;
  };
  std::vector<Vector2> nodes;  ///< m
  std::vector<Cell> cells;     ///< triangles before quadrilaterals, each in the order of the file
  std::vector<Line> lines;     ///< all of them along cells
  std::vector<std::vector<long>> curve_groups, surface_groups;  ///< physical tags of each entity
  /// By node, the one that it repeats a period away, itself where there is none; empty without a period.
  std::vector<int> original;
};

/// What became of the text of a gmsh file.
struct GmshText {
  /// What is wrong and how to mend it, to be put behind the file's name; empty when nothing is.
  std::string fault;
  /// Nothing when the file is no text of version 4.1 or has unusual sections: such files are PETSc's to read.
  std::optional<GmshMesh> mesh;
};

/// Looks at every number before it is used: a damaged file must not lead anywhere. One rank.
GmshText read_gmsh_text(std::string_view bytes, const GmshSections& sections);

}  // namespace slipscale::mesh_stages
