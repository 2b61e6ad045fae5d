#pragma once

#include <string>
#include <vector>

#include "slipscale/mesh/plane_grid.hpp"

namespace slipscale {

/// Displacement and velocity at the points of a mesh.
struct NodalSource {
  PlaneGrid grid;
  std::vector<Vector2> displacement, velocity;  ///< [points], m and m/s
  std::string description;
};

/// A table of text, see `read_nodal_fields`. `where` begins the sentences of UserError: "-initial_file:
/// 'state.csv'".
NodalSource nodal_table(const std::string& where, const std::string& text);

}  // namespace slipscale
