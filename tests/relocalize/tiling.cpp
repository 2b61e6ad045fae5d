#include <gtest/gtest.h>

#include <numeric>

#include "grids.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/relocalize/tiling.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// A disc in a periodic cell of .3 by .2, whose mesh has its corner at (5, 7).
bool in_disc(double x, double y) { return std::hypot(x - 0.15, y - 0.1) < 0.08; }

PlaneGrid disc_cell(int per_width) {
  Block block;
  block.width = 0.3;
  block.height = 0.2;
  block.nx = per_width;
  block.ny = per_width * 2 / 3;
  block.shape = Shape::quadrilaterals;
  block.region = [](double x, double y) { return in_disc(x - 5, y - 7) ? 2 : 1; };
  return block_grid(block, {5, 7});
}

PlaneGrid macro_block(double width = 1, double height = 0.5) {
  Block block;
  block.nx = 7;
  block.ny = 5;
  block.width = width;
  block.height = height;
  block.shape = Shape::mixed;
  block.distortion = 0.2;
  return block_grid(block);
}

/// In units of the period from the origin of the tiles, the fraction.
double fraction(double x, double origin, double period) {
  const double f = (x - origin) / period;
  return f - std::floor(f);
}

bool in_tiled_disc(const Vector2& x, const Vector2& origin) {
  return in_disc(0.3 * fraction(x[0], origin[0], 0.3), 0.2 * fraction(x[1], origin[1], 0.2));
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(Tiling, RepeatsTheCellOverTheBlock) {
  const PlaneGrid micro = disc_cell(30), macro = macro_block();
  // The first is a corner of the block, the others are no multiple of anything.
  for (const Vector2& origin : {Vector2{0, 0}, Vector2{0.137, 0.0719}, Vector2{-4.1, 31.3}}) {
    const Tiling tiles = tiling(micro, true, bounding_box(macro), origin);
    const TwoScales scales(macro, micro, tiles);
    const Targets targets = scales.tiles();
    const std::vector<Vector2> middles = centres(targets.grid), micro_middles = centres(micro);
    ASSERT_EQ(targets.sites.size(), targets.grid.region.size());
    ASSERT_EQ(targets.source_cell.size(), targets.grid.region.size());
    const PointLocation macro_location(macro);
    for (int cell = 0; cell < targets.grid.cells(); ++cell) {
      const Vector2& x = middles[cell];
      const int from = targets.source_cell[cell];
      EXPECT_EQ(targets.sites[cell].micro_cell, from);
      EXPECT_EQ(targets.sites[cell].macro.cell, macro_location.find(x).cell);
      EXPECT_EQ(targets.grid.region[cell] == 1, in_tiled_disc(x, origin)) << x[0] << ' ' << x[1];
      const Vector2 local = tiles.micro_point(x);
      for (int d = 0; d < 2; ++d)
        EXPECT_NEAR(local[d], micro_middles[from][d], 1e-13 * (1 + std::abs(origin[d]) + 7));
      EXPECT_NEAR(area(targets.grid, cell), area(micro, from), 1e-15);
    }
    EXPECT_EQ(count_of_other_regions(targets, micro), 0);
  }
}

/// Lines of the micro mesh fall on the sides of the block, so that the cells that are kept fill it.
TEST(Tiling, FillsTheBlockWhereMeshLinesMeetItsSides) {
  const PlaneGrid micro = disc_cell(30), macro = macro_block();
  const Targets targets =
      TwoScales(macro, micro, tiling(micro, true, bounding_box(macro), Vector2{0.07, 0.03})).tiles();
  const std::vector<double> parts = areas(targets.grid);
  EXPECT_NEAR(std::accumulate(parts.begin(), parts.end(), 0.0), 0.5, 1e-12);
  const Box box = bounding_box(targets.grid);
  for (int d = 0; d < 2; ++d) {
    EXPECT_NEAR(box.lower[d], 0, 1e-12);
    EXPECT_NEAR(box.upper[d], bounding_box(macro).upper[d], 1e-12);
  }
}

/// By default a copy lies where the micro mesh lies; a block that is one period falls on its cells one to
/// one.
TEST(Tiling, MapsTheWholeBlockOneToOne) {
  const PlaneGrid macro = macro_block(), micro = macro_block();
  for (const bool periodic : {false, true}) {
    const Tiling tiles = tiling(micro, periodic, bounding_box(macro));
    EXPECT_FALSE(tiles.repeats);
    const Targets targets = TwoScales(macro, micro, tiles).tiles();
    ASSERT_EQ(targets.grid.cells(), micro.cells());
    EXPECT_EQ(targets.grid.corners.size(), micro.corners.size());
    for (int cell = 0; cell < micro.cells(); ++cell) {
      EXPECT_EQ(targets.source_cell[cell], cell);
      EXPECT_EQ(targets.sites[cell].micro_cell, cell);
      EXPECT_EQ(targets.sites[cell].macro.cell, cell);
      EXPECT_EQ(centre(targets.grid, cell), centre(micro, cell));
    }
  }
}

/// A part of the block is filled by the whole block's tensors: the rest of them is left out.
TEST(Tiling, LeavesOutWhatTheMacroMeshDoesNotCover) {
  const PlaneGrid whole = macro_block();
  PlaneGrid part;
  part.regions = whole.regions;
  const std::vector<int> kept{3, 4, 11, 12};
  append_cells(part, whole, kept, {});
  const Targets targets = TwoScales(part, whole, tiling(whole, false, bounding_box(whole))).tiles();
  EXPECT_EQ(targets.source_cell, kept);
}

/// The mesh of the heterogeneous run draws the discs with other cells; those away from an interface get the
/// phase they are in.
TEST(Tiling, FindsTheMicroCellsOfAnotherMesh) {
  const PlaneGrid micro = disc_cell(60), macro = macro_block();
  const Vector2 origin{0.137, 0.0719};
  Block fine;
  fine.nx = 111;
  fine.ny = 53;
  fine.height = 0.5;
  fine.shape = Shape::quadrilaterals;
  fine.distortion = 0.1;
  fine.region = [&](double x, double y) { return in_tiled_disc({x, y}, origin) ? 2 : 1; };
  const PlaneGrid reference = block_grid(fine);
  const TwoScales scales(macro, micro, tiling(micro, true, bounding_box(macro), origin));
  const Targets targets = scales.cells_of(reference);
  ASSERT_EQ(targets.grid.cells(), reference.cells());
  int others = 0;
  for (int cell = 0; cell < reference.cells(); ++cell) {
    EXPECT_EQ(targets.source_cell[cell], cell);
    const bool stated = targets.grid.region[cell] == 1,
               given = micro.region[targets.sites[cell].micro_cell] == 1;
    others += stated != given;
    const Vector2 x = centre(reference, cell);
    const double x0 = 0.3 * fraction(x[0], origin[0], 0.3) - 0.15,
                 y0 = 0.2 * fraction(x[1], origin[1], 0.2) - 0.1;
    const bool near_interface = std::abs(std::hypot(x0, y0) - 0.08) < 0.016;
    EXPECT_TRUE(stated == given || near_interface) << x[0] << ' ' << x[1];
  }
  EXPECT_EQ(count_of_other_regions(targets, micro), others);
}

TEST(Tiling, SitesOfPoints) {
  const PlaneGrid micro = disc_cell(30), macro = macro_block();
  const TwoScales scales(macro, micro, tiling(micro, true, bounding_box(macro), Vector2{0, 0}));
  EXPECT_FALSE(scales.site({1.2, 0.1}));
  const auto site = scales.site({0.45, 0.3});  // the middle of the second cell of the second row
  ASSERT_TRUE(site);
  EXPECT_EQ(micro.region[site->micro_cell], 1);
  // Corners of the block and of the copies have sites too.
  for (const double x : {0.0, 0.3, 0.6, 1.0})
    for (const double y : {0.0, 0.2, 0.5}) EXPECT_TRUE(scales.site({x, y})) << x << ' ' << y;
}

TEST(Tiling, RefusesTensorsOfAnotherBlock) {
  const PlaneGrid micro = disc_cell(30), macro = macro_block();
  const std::string text = refusal([&] { tiling(micro, false, bounding_box(macro)); });
  EXPECT_EQ(text,
            "-relocalize_tensors are those of a whole block, and their mesh [5, 5.3] x [7, 7.2] m is not the "
            "block [0, 1] x [0, 0.5] m of -relocalize_run; homogenise that block, or a periodic cell "
            "(-cell_boundary periodic)");
  EXPECT_NE(refusal([&] {
              tiling(macro, false, bounding_box(macro), Vector2{0.1, 0});
            }).find("with another -relocalize_origin"),
            std::string::npos);
  // Within 1e-6 of the block's size it is the same block, beyond it is not.
  EXPECT_EQ(refusal([&] { tiling(macro_block(1 + 4e-7), false, bounding_box(macro)); }), "");
  EXPECT_NE(refusal([&] { tiling(macro_block(1 + 4e-6), false, bounding_box(macro)); }), "");
}

TEST(Tiling, RefusesACellWithAHole) {
  const PlaneGrid micro = disc_cell(30), macro = macro_block();
  PlaneGrid holed;
  holed.regions = micro.regions;
  std::vector<int> matrix;
  for (int cell = 0; cell < micro.cells(); ++cell)
    if (micro.region[cell] == 0) matrix.push_back(cell);
  append_cells(holed, micro, matrix, {});
  EXPECT_NE(refusal([&] { tiling(holed, true, bounding_box(macro)); }).find("does not fill its rectangle"),
            std::string::npos);
}

TEST(Tiling, RefusesAReferenceElsewhere) {
  const PlaneGrid micro = disc_cell(30), macro = macro_block(), far = disc_cell(3);
  const TwoScales scales(macro, micro, tiling(micro, true, bounding_box(macro)));
  EXPECT_NE(refusal([&] { scales.cells_of(far); }).find("shares no place"), std::string::npos);
}
