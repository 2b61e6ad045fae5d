#pragma once

#include <optional>

#include "fitting.hpp"
#include "slipscale/morphology/composite_mesh.hpp"

namespace slipscale::morphology {

/// A grid of squares fitted to the interfaces of the bodies: a node of each edge that an interface crosses
/// lies on it, squares with corners on both sides are split along it, and each part has the area `drawn`
/// [parts, m²] to rounding. Nodes and cells row by row from the bottom, both ends of periodic rows included.
struct FittedGrid {
  CompositeMesh mesh;
  int squeezed = 0;  ///< places where two interfaces were nearer than a square is wide
  int blunted = 0;   ///< nodes on the sides through which a wedge thinner than half a square was cut off
  int relieved = 0;  ///< nodes moved along sides and interfaces for a longer step
  std::map<std::array<int, 2>, int> unresolved;  ///< as in Fit; the mesh is empty when there are any
};

FittedGrid fitted_grid(const Lattice& lattice, const std::vector<Body>& bodies,
                       const std::vector<double>& drawn, const std::vector<std::string>& regions);

/// The same for the contour of a picture. Its inside gets the area `drawn` [m²] where that takes nodes a
/// twentieth of a cell or less; without it, the area of the level, and no node is relieved, which is quick.
/// Places that are not resolved are counted, and the mesh is there all the same.
FittedGrid fitted_grid(const Lattice& lattice, const Contour& contour,
                       const std::vector<std::string>& regions, std::optional<double> drawn = {});

/// Moves the interface of each part, where it is curved, in or out until the part has its drawn area.
void correct_areas(Fit& fit, const std::vector<double>& drawn);

}  // namespace slipscale::morphology
