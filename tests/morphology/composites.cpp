#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "block_mesh.hpp"
#include "msh_file.hpp"
#include "recipes.hpp"
#include "scenes.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/morphology/compose.hpp"
#include "slipscale/morphology/drawing.hpp"

using namespace slipscale;
using testing_support::length;
using testing_support::MshFile;
using testing_support::outer_edge_count;
using testing_support::read_msh;
using testing_support::recipe_of;
using testing_support::scratch;

namespace {

std::string describe(std::uint64_t seed) { return "seed " + std::to_string(seed); }

double area(const MshFile& file, const MshFile::Cell& cell) {
  std::vector<Vector2> corners;
  for (long node : cell.corners) corners.push_back(file.nodes.at(node));
  return polygon_area(corners);
}

bool contains(const Inclusion& inclusion, const Room& room, const Vector2& x) {
  Inclusion point;
  point.centre = x;
  for (const Inclusion& image : images(inclusion, room))
    if (separation(image, point) < 0) return true;
  return false;
}

/// Area of the surfaces in the file that lie in each inclusion.
std::vector<double> areas_in_file(const MshFile& file, const std::vector<Inclusion>& inclusions,
                                  const Room& room) {
  std::map<int, double> area_of;
  std::map<int, Vector2> middle_of;  // area times centre
  for (const MshFile::Cell& cell : file.cells) {
    const double a = area(file, cell);
    area_of[cell.surface] += a;
    for (int axis = 0; axis < 2; ++axis)
      for (long node : cell.corners)
        middle_of[cell.surface][axis] +=
            a * file.nodes.at(node)[axis] / static_cast<double>(cell.corners.size());
  }
  std::vector<double> areas(inclusions.size());
  for (const auto& [surface, a] : area_of) {
    const Vector2 middle{middle_of[surface][0] / a, middle_of[surface][1] / a};
    for (std::size_t k = 0; k < inclusions.size(); ++k)  // the middle of the matrix may lie in an inclusion
      if (a < 1.001 * area(inclusions[k]) && contains(inclusions[k], room, middle)) areas[k] += a;
  }
  return areas;
}

void check_pairs(const MshFile& file, const Room& room) {
  std::size_t along[2] = {0, 0};
  for (const MshFile::Pair& pair : file.pairs) {
    const Vector2 &slave = file.nodes.at(pair.node), &master = file.nodes.at(pair.master);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(slave[axis], master[axis] + pair.shift[axis], 1e-12 * length);
      along[axis] += pair.shift[axis] != 0;
    }
  }
  for (int axis = 0; axis < 2; ++axis) {
    std::size_t on_side = 0;
    for (const auto& [number, x] : file.nodes) on_side += x[axis] == room.block.upper[axis];
    if (room.periodic[axis]) {
      EXPECT_GE(along[axis], on_side) << "axis " << axis;
    }
  }
}

void check_fractions(const Recipe& recipe, const Composed& composed) {
  for (std::size_t k = 0; k < recipe.families.size(); ++k) {
    double largest = 0;
    for (const Inclusion& inclusion : composed.placement.inclusions)
      if (inclusion.family == static_cast<int>(k)) largest = std::max(largest, area(inclusion));
    EXPECT_LE(std::abs(composed.placement.fraction[k] - recipe.families[k].fraction),
              (1 + composed.dropped + composed.placement.dropped) * largest / (length * length));
  }
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

/// 200 composites of all shapes: slide reads each, every inclusion has its drawn area to 1e-6, periodic sides
/// match to 1e-12, and a torus has no edge left.
TEST(Composites, MeetEveryPromise) {
  GmshModel gmsh;
  const std::string path = scratch("composite.msh");
  int moved = 0, redrawn = 0, dropped = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(describe(seed));
    const Recipe recipe = recipe_of(seed);
    Composed composed;
    ASSERT_NO_THROW(composed = compose(recipe, gmsh));
    write_mesh(recipe, composed, gmsh, path);
    const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {path});
    EXPECT_EQ(mesh.cells.total, static_cast<PetscInt>(composed.mesh.cells.size()));
    if (recipe.room.periodic[0] && recipe.room.periodic[1]) {
      EXPECT_EQ(outer_edge_count(mesh), 0);
    }
    const MshFile file = read_msh(path);
    check_pairs(file, recipe.room);
    const auto& inclusions = composed.placement.inclusions;
    const std::vector<double> areas = areas_in_file(file, inclusions, recipe.room);
    for (std::size_t k = 0; k < inclusions.size(); ++k) {
      double drawn = 0;
      for (const Inclusion& image : images(inclusions[k], recipe.room))
        drawn += area_inside(image, recipe.room.block);
      EXPECT_NEAR(areas[k] / drawn, 1, 1e-6) << "inclusion " << k;
    }
    check_fractions(recipe, composed);
    moved += composed.moved;
    redrawn += composed.redrawn;
    dropped += composed.dropped;
  }
  std::printf("repaired: %d moved, %d drawn anew, %d dropped\n", moved, redrawn, dropped);
}

TEST(Composites, SameSeedGivesTheSameBytes) {
  const std::string one = scratch("one.msh"), two = scratch("two.msh"), other = scratch("other.msh");
  for (const std::uint64_t seed : {0, 1, 2, 3, 8}) {
    {
      GmshModel gmsh;
      compose(recipe_of(seed), gmsh);
      gmsh.write(one);
      compose(recipe_of(seed + 7 * 24), gmsh);
      gmsh.write(other);
      compose(recipe_of(seed), gmsh);  // what was meshed before leaves no trace
      gmsh.write(two);
    }
    EXPECT_EQ(text_of(one), text_of(two)) << describe(seed);
    EXPECT_NE(text_of(one), text_of(other)) << describe(seed);
  }
}
