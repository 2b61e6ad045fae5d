#include <cmath>
#include <cstdio>

#include "slipscale/morphology/compose.hpp"

/// Draws and meshes a disc in a periodic cell; 0 when its polygon has the area of the disc.
int main() {
  using namespace slipscale;
  constexpr double fraction = 0.4;
  Family family;
  family.region = "inclusion";
  family.fraction = fraction;
  Recipe recipe;
  recipe.composite = Composite::array;
  recipe.array = {Arrangement::square, 1, 1, 0};
  recipe.families = {family};
  recipe.room.block.upper = {1, 1};
  recipe.room.periodic = {true, true};
  recipe.room.gap = recipe.room.clearance = 0.05;
  recipe.mesh.size = {0.05, 0.05, 0.05, 0};
  GmshModel gmsh;
  const Composed composed = compose(recipe, gmsh);
  double area = 0;
  for (const CompositeMesh::Cell& cell : composed.mesh.cells)
    if (cell.inclusion >= 0) area += polygon_area(composed.mesh.corners(cell));
  std::printf("gmsh %s: %zu cells, inclusion %.12g of the cell\n", GmshModel::version().c_str(),
              composed.mesh.cells.size(), area);
  return std::abs(area - fraction) < 1e-9 ? 0 : 1;
}
