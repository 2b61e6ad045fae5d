#pragma once

#include <array>
#include <vector>

#include "slipscale/morphology/placement.hpp"
#include "slipscale/morphology/recipe.hpp"

namespace slipscale {

/// Which sides of the block a point lies on.
enum Side : unsigned { bottom = 1, right = 2, top = 4, left = 8 };

struct Vertex {
  Vector2 x;
  unsigned sides = 0;  ///< Side bits
};

/// A convex part of an inclusion in the block, cut at its sides: counter-clockwise, m.
struct Piece {
  std::vector<Vertex> corners;
  int inclusion = 0;  ///< index of the inclusion or layer that it is part of
  int region = 0;     ///< 1 and up; 0 is the matrix
};

/// The polygons of inclusions, whose edges are at most `length` long. A polygon drawn through points of a
/// curve has too little area, and that, not the order of the elements, would dominate the effective stiffness
/// of the mesh: its corners are moved outwards until the polygon's pieces in the block have the area of the
/// inclusion's. Corners on sides stay there.
std::vector<Piece> polygons(const std::vector<Inclusion>& inclusions, const Room& room, double length);

/// Layers of inclusion between low and high along the normal, from before the block to behind it, m.
struct LayerStack {
  Vector2 normal;
  struct Layer {
    int number;
    double low, high;
  };
  std::vector<Layer> layers;
};
LayerStack stack(const Laminate& laminate, const Room& room, double clearance);

/// The layers of a laminate in the block, one of inclusion in its middle; the layers are shifted as a whole
/// when an interface would come nearer than `clearance` to a corner of the block. Throws UserError when the
/// layers do not fit a periodic block.
std::vector<Piece> layers(const Laminate& laminate, const Room& room, double clearance);

/// The block as faces bounded by straight segments.
struct Drawing {
  std::vector<Vector2> points;
  struct Segment {
    int from, to;    ///< points
    unsigned sides;  ///< Side bits of the side it lies on; 0 for interfaces
  };
  std::vector<Segment> segments;
  /// Segments by number from 1, negative against their direction, as gmsh counts them.
  using Loop = std::vector<int>;
  struct Face {
    std::vector<Loop> loops;  ///< counter-clockwise outline, then clockwise holes
    int region = 0;           ///< 0 matrix
    int inclusion = -1;       ///< of the piece; -1 in the matrix
  };
  std::vector<Face> faces;
  /// Segments of a side in ascending order of x or y.
  std::vector<int> side(Side side) const;
};

/// Puts the pieces, which do not touch one another, into the matrix.
Drawing draw(const Box& block, const std::vector<Piece>& pieces);

double polygon_area(const std::vector<Vector2>& corners);

}  // namespace slipscale
