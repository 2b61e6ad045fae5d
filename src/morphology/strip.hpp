#pragma once

#include "slipscale/morphology/compose.hpp"
#include "slipscale/morphology/drawing.hpp"

namespace slipscale::morphology {

/// The name of the region above the microstructure.
inline const std::string region_above = "homogenized";

/// Ends the microstructure near -microstructure_height: at a row of a grid, and otherwise where the end keeps
/// the clearance from outlines that it does not cross properly. Inclusions with their centre above the height
/// asked for are left out, and those that the end cannot cross, or must not with -edge inside. Throws
/// UserError where that empties a region.
Strip end_strip(const Recipe& recipe, Placement& placement);

/// The number of inclusions that reach across the end.
int across(const std::vector<Inclusion>& inclusions, const Strip& strip);

/// The strip as a room of its own.
Room room_below(const Room& room, const Strip& strip);

/// The strip with its inclusions and the homogeneous part above it, which share the straight line between
/// them; an inclusion that the end cuts reaches across it.
Drawing draw_strip(const Recipe& recipe, const std::vector<Inclusion>& inclusions, const Strip& strip);

/// Gives the matrix above the end, in a grid of `columns` cells, to the region above.
void name_above(CompositeMesh& mesh, int columns, int row);

}  // namespace slipscale::morphology
