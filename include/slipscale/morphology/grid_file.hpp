#pragma once

#include <array>
#include <string>

#include "slipscale/base/box.hpp"
#include "slipscale/morphology/composite_mesh.hpp"

namespace slipscale {

/// Writes a mesh whose nodes are those of a grid of columns × rows squares, row by row from the bottom, as
/// MSH 4.1 text: regions as physical surfaces, bottom, right, top and left as physical curves, pairs of
/// periodic nodes. Nodes keep their order, and cells are numbered in theirs. Throws UserError when the file
/// cannot be written.
void write_grid_msh(const CompositeMesh& mesh, const Box& block, const std::array<int, 2>& cells,
                    const std::array<bool, 2>& periodic, const std::string& path);

}  // namespace slipscale
