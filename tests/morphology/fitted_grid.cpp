#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "msh_file.hpp"
#include "recipes.hpp"
#include "scenes.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/dynamics/model.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/morphology/compose.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

Recipe fitted(std::uint64_t seed) {
  Recipe recipe = recipe_of(seed);
  recipe.mesh.cell = CellShape::grid;
  const double square = 0.05e-3;
  recipe.mesh.size = {square, square, square, 0};
  return recipe;
}

/// Discs of .5 mm in a block of 5 × 5 mm, area fraction .3, gap one square.
Recipe discs(std::uint64_t seed, int across) {
  Recipe recipe;
  recipe.composite = Composite::random;
  recipe.room.block.upper = {length, length};
  recipe.families = {family(slipscale::Shape::disc, 0.3, 0.5e-3)};
  recipe.families[0].diameter_deviation = 0;
  recipe.mesh.cell = CellShape::grid;
  recipe.mesh.size.bulk = recipe.mesh.size.interface = length / across;
  recipe.mesh.worst_angle = 15 * degree;
  recipe.room.gap = recipe.room.clearance = recipe.repair = 0.05e-3;
  recipe.seed = seed;
  return recipe;
}

/// Nodes of the sides lie on them, those at equal places on both sides of a period, and corners stay.
void expect_straight_sides(const Composed& composed, const Room& room) {
  const auto [columns, rows] = composed.grid;
  const auto at = [&](int column, int row) {
    return composed.mesh.nodes[static_cast<std::size_t>(row) * (columns + 1) + column];
  };
  for (int row = 0; row <= rows; ++row) {
    EXPECT_EQ(at(0, row)[0], room.block.lower[0]);
    EXPECT_EQ(at(columns, row)[0], room.block.upper[0]);
    if (room.periodic[0]) {
      EXPECT_EQ(at(0, row)[1], at(columns, row)[1]);
    }
  }
  for (int column = 0; column <= columns; ++column) {
    EXPECT_EQ(at(column, 0)[1], room.block.lower[1]);
    EXPECT_EQ(at(column, rows)[1], room.block.upper[1]);
    if (room.periodic[1]) {
      EXPECT_EQ(at(column, 0)[0], at(column, rows)[0]);
    }
  }
  EXPECT_EQ(at(0, 0), room.block.lower);
  EXPECT_EQ(at(columns, rows), room.block.upper);
  EXPECT_EQ(composed.mesh.nodes.size(), static_cast<std::size_t>(columns + 1) * (rows + 1));
}

/// No node belongs to two inclusions: none has grown together with another.
void expect_apart(const CompositeMesh& mesh) {
  std::map<int, int> owner;
  for (const CompositeMesh::Cell& cell : mesh.cells)
    for (int i = 0; cell.inclusion >= 0 && i < cell.count; ++i)
      EXPECT_EQ(owner.emplace(cell.corners[i], cell.inclusion).first->second, cell.inclusion);
}

/// Where a cell's middle lies farther than half a square from all interfaces, the drawing says what it is.
void expect_as_drawn(const Recipe& recipe, const Composed& composed) {
  const auto& inclusions = composed.placement.inclusions;
  for (const CompositeMesh::Cell& cell : composed.mesh.cells) {
    Inclusion middle;
    for (const Vector2& x : composed.mesh.corners(cell))
      for (int axis = 0; axis < 2; ++axis) middle.centre[axis] += x[axis] / cell.count;
    for (std::size_t k = 0; k < inclusions.size(); ++k)
      for (const Inclusion& image : images(inclusions[k], recipe.room)) {
        if (std::hypot(image.centre[0] - middle.centre[0], image.centre[1] - middle.centre[1]) > 0.7e-3)
          continue;
        const double distance = separation(image, middle), far = 0.5 * recipe.mesh.size.bulk;
        if (distance < -far) {
          EXPECT_EQ(cell.inclusion, static_cast<int>(k));
        }
        if (distance > far && cell.inclusion == static_cast<int>(k)) {
          EXPECT_GT(images(inclusions[k], recipe.room).size(), 1u);
        }
      }
  }
}

std::string refusal(const Recipe& recipe) {
  GmshModel gmsh;
  try {
    compose(recipe, gmsh);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

/// 200 composites of all shapes, arrangements and sides: every inclusion has its drawn area, cells are sound.
TEST(FittedGrid, MeetsEveryPromise) {
  GmshModel gmsh;
  int moved = 0, squeezed = 0, blunted = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Recipe recipe = fitted(seed);
    Composed composed;
    ASSERT_NO_THROW(composed = compose(recipe, gmsh));
    EXPECT_GE(composed.quality.smallest_angle, 15 * degree);
    EXPECT_LE(composed.quality.largest_angle, std::numbers::pi - 15 * degree);
    const std::vector<double> areas = inclusion_areas(composed.mesh, composed.drawn_area.size());
    for (std::size_t k = 0; k < areas.size(); ++k)
      EXPECT_NEAR(areas[k], composed.drawn_area[k], 1e-6 * composed.drawn_area[k]) << "inclusion " << k;
    expect_straight_sides(composed, recipe.room);
    expect_apart(composed.mesh);
    if (seed < 50) expect_as_drawn(recipe, composed);
    moved += composed.moved + composed.redrawn + composed.dropped;
    squeezed += composed.squeezed;
    blunted += composed.blunted;
  }
  std::printf("%d inclusions moved, %d edges squeezed, %d wedges left out\n", moved, squeezed, blunted);
}

/// slide reads the same cells, areas and sides from the file, whose nodes stand row by row.
TEST(FittedGrid, IsReadBack) {
  GmshModel gmsh;
  const std::string path = scratch("fitted.msh");
  for (const std::uint64_t seed : {0, 1, 3, 6, 11}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Recipe recipe = fitted(seed);
    const Composed composed = compose(recipe, gmsh);
    write_mesh(recipe, composed, gmsh, path);
    const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {path});
    EXPECT_EQ(mesh.cells.total, static_cast<PetscInt>(composed.mesh.cells.size()));
    const std::vector<double> areas = region_areas(composed.mesh);
    ASSERT_EQ(mesh.regions.size(), areas.size());
    for (std::size_t k = 0; k < areas.size(); ++k)
      EXPECT_NEAR(mesh.regions[k].area, areas[k], 1e-12 * mesh.area());
    const Boundary* bottom = mesh.find_boundary("bottom");
    ASSERT_TRUE(bottom);
    EXPECT_NEAR(bottom->length, length, 1e-12 * length);
    EXPECT_EQ(bottom->edge_count, composed.grid[0]);
    const int seams = int{recipe.room.periodic[0]} + int{recipe.room.periodic[1]};
    EXPECT_EQ(int{mesh.periodic[0]} + int{mesh.periodic[1]}, seams);
    const MshFile file = read_msh(path);
    for (std::size_t k = 0; k < composed.mesh.nodes.size(); ++k)
      EXPECT_EQ(file.nodes.at(static_cast<long>(k) + 1), composed.mesh.nodes[k]);
    for (const MshFile::Pair& pair : file.pairs)
      for (int axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(file.nodes.at(pair.node)[axis], file.nodes.at(pair.master)[axis] + pair.shift[axis],
                    1e-12 * length);
  }
}

/// Sharp stable step over the node spacing (square root of area per node) over the faster phase's
/// dilatational speed: at least .75, where gmsh's triangles have .43.
TEST(FittedGrid, AllowsALongStep) {
  GmshModel gmsh;
  const std::string path = scratch("fast.msh");
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Recipe recipe = discs(seed, 128);
    write_mesh(recipe, compose(recipe, gmsh), gmsh, path);
    const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {path});
    const Material soft = isotropic(30e9, 0.25, 1800), stiff = isotropic(80e9, 0.25, 1800);
    std::vector<Material> materials;
    for (const Region& region : mesh.regions) materials.push_back(region.name == "matrix" ? soft : stiff);
    const Model model(mesh, materials, Model::Storage::full);
    const double step = 2 / largest_frequency(PETSC_COMM_WORLD, model).sharp;
    const double speed = std::sqrt(stiff.stiffness(0, 0) / stiff.density);
    EXPECT_GE(step * speed / std::sqrt(length * length / mesh.nodes.total), 0.75);
  }
}

/// Two discs .02 mm apart, with squares of .05 mm, along x: no node is left between them.
TEST(FittedGrid, RefusesWhatItCannotResolve) {
  Recipe recipe = discs(1, 100);
  recipe.composite = Composite::array;
  recipe.families[0].diameter = 0.98e-3;
  recipe.array = {Arrangement::square, 5, 5, 0};
  recipe.room.gap = recipe.room.clearance = 1e-6;
  const std::string said = refusal(recipe);
  EXPECT_NE(said.find("-size 5e-05 is too coarse for the grid"), std::string::npos) << said;
  EXPECT_NE(
      said.find(
          "the inclusion at (0.0015, 0.0005) m and the inclusion at (0.0005, 0.0005) m, 2e-05 m apart (1)"),
      std::string::npos)
      << said;
  EXPECT_NE(said.find("2e-05 m apart"), std::string::npos) << said;
  EXPECT_NE(said.find("give at most about 2e-05"), std::string::npos) << said;
  recipe.mesh.size.bulk = recipe.mesh.size.interface = 2e-5;
  EXPECT_EQ(refusal(recipe), "");
}

TEST(FittedGrid, IsAPlainGridWithoutInclusions) {
  GmshModel gmsh;
  Recipe recipe = discs(1, 20);
  recipe.composite = Composite::homogeneous;
  recipe.families.clear();
  const Composed composed = compose(recipe, gmsh);
  EXPECT_EQ(composed.mesh.cells.size(), 400u);
  EXPECT_NEAR(composed.quality.smallest_angle, 90 * degree, 1e-12);
}
