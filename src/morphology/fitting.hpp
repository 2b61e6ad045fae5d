#pragma once

#include <map>
#include <vector>

#include "body.hpp"
#include "contour.hpp"
#include "lattice.hpp"

namespace slipscale::morphology {

constexpr int nobody = -1;

/// A node of the lattice on an interface.
struct OnInterface {
  int body;    ///< index
  Place seen;  ///< the node's place as the body's image meets it
};

/// A lattice with nodes moved onto interfaces such that no edge joins the inside of a part to its outside.
struct Fit {
  const Lattice& lattice;
  const std::vector<Body>& bodies;
  std::vector<int> inside;             ///< [nodes] part that covers the node's place, or `nobody`
  std::vector<int> on;                 ///< [nodes] part on whose interface the node was moved, or `nobody`
  std::vector<Vector2> moved;          ///< [nodes] from its place, m
  std::map<int, OnInterface> touches;  ///< of nodes on interfaces
  /// Parts whose interfaces meet at an edge of the lattice, and there is no node left for one of them: number
  /// of such edges. The second is `nobody` where one part is too thin.
  std::map<std::array<int, 2>, int> unresolved;
  int squeezed = 0;  ///< edges for which the farther node had to move, the nearer lying on another interface
  int blunted = 0;   ///< nodes on sides of the block through which a wedge too thin for the grid was cut off
  std::map<int, int> surrounded;  ///< lower left node of squares with all corners on interfaces -> their part
  const Contour* contour = nullptr;  ///< in place of bodies; its inside is part 0

  Vector2 position(const Place& place) const {
    const Vector2& by = moved[lattice.node(place)];
    const Vector2 at = lattice.position(place);
    return {at[0] + by[0], at[1] + by[1]};
  }
  /// The interface that the node lies on, near the node.
  Foot foot(int node, const Vector2& moved_by) const;
};

/// Decides what squares with all corners on interfaces are part of.
void decide_surrounded(Fit& fit);

Fit fit(const Lattice& lattice, const std::vector<Body>& bodies);

/// The same for the contour of a picture, with an empty list of bodies. Two interfaces that pass through one
/// edge are left out there and counted as unresolved; a tip of less than half a cell does not count.
Fit fit(const Lattice& lattice, const std::vector<Body>& none, const Contour& contour);

/// What a square of the lattice becomes: one cell, or two triangles.
struct Square {
  struct Cell {
    std::array<int, 4> corners{};  ///< of the square, counter-clockwise from the lower left
    int count = 0, part = nobody;
  };
  std::array<Cell, 2> cells;
  int count = 1;
};
Square square(const Fit& fit, const Place& low);

/// The places of a square's corners, counter-clockwise.
inline std::array<Place, 4> corners(const Place& low) {
  return {low, {low[0] + 1, low[1]}, {low[0] + 1, low[1] + 1}, {low[0], low[1] + 1}};
}

}  // namespace slipscale::morphology
