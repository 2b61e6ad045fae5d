#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "block_mesh.hpp"
#include "recipes.hpp"
#include "scenes.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/morphology/compose.hpp"
#include "slipscale/morphology/drawing.hpp"

using namespace slipscale;
using testing_support::length;
using testing_support::recipe_of;
using testing_support::scratch;
using testing_support::size;

namespace {

Recipe strip_of(std::uint64_t seed) {
  Recipe recipe = recipe_of(seed);
  recipe.room.periodic[1] = false;
  recipe.microstructure_height = (0.5 + 0.05 * static_cast<double>(seed % 9)) * length;
  if (seed % 5 == 4) recipe.mesh.cell = CellShape::grid;
  return recipe;
}

std::vector<double> areas_of_inclusions(const Composed& composed) {
  std::vector<double> areas(composed.placement.inclusions.size());
  for (const CompositeMesh::Cell& cell : composed.mesh.cells)
    if (cell.inclusion >= 0) areas[cell.inclusion] += polygon_area(composed.mesh.corners(cell));
  return areas;
}

double middle(const CompositeMesh& mesh, const CompositeMesh::Cell& cell) {
  double y = 0;
  for (const Vector2& x : mesh.corners(cell)) y += x[1] / cell.count;
  return y;
}

/// Corners of the edges that a cell of the matrix shares with one of the region above.
std::vector<Vector2> ends_of_matrix(const CompositeMesh& mesh, int above) {
  std::map<std::array<int, 2>, std::array<bool, 2>> edges;
  for (const CompositeMesh::Cell& cell : mesh.cells) {
    if (cell.region != 0 && cell.region != above) continue;
    for (int i = 0; i < cell.count; ++i) {
      const int a = cell.corners[i], b = cell.corners[(i + 1) % cell.count];
      edges[{std::min(a, b), std::max(a, b)}][cell.region == above] = true;
    }
  }
  std::vector<Vector2> found;
  for (const auto& [edge, regions] : edges)
    if (regions[0] && regions[1])
      for (const int node : edge) found.push_back(mesh.nodes[node]);
  return found;
}

}  // namespace

/// 100 strips of all shapes, arrangements and cells: slide reads each, inclusions keep their drawn area, the
/// homogeneous part begins on one straight line, and no inclusion begins above it.
TEST(Strips, EndInAStraightLine) {
  GmshModel gmsh;
  const std::string path = scratch("strip.msh");
  int across = 0, left_out = 0, made = 0;
  for (std::uint64_t seed = 0; made < 100; ++seed) {
    const Recipe recipe = strip_of(seed);
    if (recipe.composite == Composite::laminate) continue;
    ++made;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Composed composed;
    ASSERT_NO_THROW(composed = compose(recipe, gmsh));
    write_mesh(recipe, composed, gmsh, path);
    const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {path});
    EXPECT_EQ(mesh.cells.total, static_cast<PetscInt>(composed.mesh.cells.size()));
    ASSERT_EQ(composed.mesh.regions.back(), "homogenized");
    const int above = static_cast<int>(composed.mesh.regions.size()) - 1;
    const double end = composed.strip->end;
    EXPECT_NEAR(end, *recipe.microstructure_height, 0.1 * *recipe.microstructure_height + size);
    const bool grid = recipe.mesh.cell == CellShape::grid;
    // A grid moves nodes beside the inclusions that reach across, by half a cell at most.
    const double off = grid ? 0.75 * size : 1e-12;
    for (const CompositeMesh::Cell& cell : composed.mesh.cells) {
      EXPECT_FALSE(cell.region == 0 && middle(composed.mesh, cell) > end + off);
      EXPECT_FALSE(cell.region == above && middle(composed.mesh, cell) < end - off);
    }
    const std::vector<Vector2> line = ends_of_matrix(composed.mesh, above);
    EXPECT_FALSE(line.empty());
    long on_line = 0;
    for (const Vector2& x : line) {
      EXPECT_NEAR(x[1], end, off);
      on_line += std::abs(x[1] - end) < 1e-12;
    }
    EXPECT_GE(on_line, static_cast<long>(line.size()) * 2 / 3);
    const std::vector<double> areas = areas_of_inclusions(composed);
    for (std::size_t k = 0; k < areas.size(); ++k) {
      EXPECT_NEAR(areas[k] / composed.drawn_area[k], 1, 1e-6) << "inclusion " << k;
      EXPECT_LT(composed.placement.inclusions[k].centre[1],
                std::max(end, *recipe.microstructure_height) + size);
    }
    across += composed.strip->whole;
    left_out += composed.strip->left_out;
  }
  EXPECT_GT(across, 0);
  EXPECT_GT(left_out, 0);
}

TEST(Strips, RefuseToBeEmpty) {
  GmshModel gmsh;
  Recipe recipe = strip_of(0);
  recipe.room.keep_out = 2e-3;
  recipe.microstructure_height = 2.1e-3;
  EXPECT_THROW(compose(recipe, gmsh), UserError);
}

/// What the contact feels is the microstructure of the whole block: the same seed puts the same inclusions
/// below the end.
TEST(Strips, KeepTheMicrostructureOfTheWholeBlock) {
  GmshModel gmsh;
  for (const std::uint64_t seed : {0, 7, 14, 21}) {
    Recipe recipe = recipe_of(seed);
    recipe.room.periodic = {true, false};
    recipe.mesh.cell = CellShape::triangle;
    const Composed whole = compose(recipe, gmsh);
    recipe.microstructure_height = 0.5 * length;
    const Composed strip = compose(recipe, gmsh);
    if (whole.moved + whole.redrawn + whole.dropped + strip.moved + strip.redrawn + strip.dropped) continue;
    std::size_t below = 0;
    for (const Inclusion& inclusion : whole.placement.inclusions) {
      const auto& kept = strip.placement.inclusions;
      if (below < kept.size() && kept[below].centre == inclusion.centre)
        ++below;
      else
        EXPECT_GT(inclusion.centre[1] + inclusion.half_length, 0.49 * length - size) << "seed " << seed;
    }
    EXPECT_EQ(below, strip.placement.inclusions.size()) << "seed " << seed;
    EXPECT_EQ(strip.placement.inclusions.size() + strip.strip->left_out + strip.strip->above,
              whole.placement.inclusions.size());
  }
}
