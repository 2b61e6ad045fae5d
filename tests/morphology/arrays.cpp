#include <gtest/gtest.h>

#include "slipscale/base/error.hpp"
#include "sound.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

/// 6 × 4 discs in cells of 1 mm × 1.2 mm: the gap is 1 mm less the diameter; in a hexagonal array rows are
/// 1.2 mm apart, and the nearest neighbour is still the one beside.
TEST(Array, HasItsFractionAndGap) {
  for (const Sides sides : {Sides::periodic, Sides::cut})
    for (const Arrangement arrangement : {Arrangement::square, Arrangement::hexagonal}) {
      const Room room = room_with(sides, 6);
      Family family = family_of(Shape::disc, 0);
      family.diameter = 8e-4;
      const Placement placement = place_in_array(family, room, {arrangement, 6, 4, 0});
      const bool halves = sides == Sides::cut && arrangement == Arrangement::hexagonal;
      EXPECT_EQ(placement.inclusions.size(), halves ? 26u : 24u);
      EXPECT_NEAR(placement.fraction[0], 24 * pi * 0.16 / (6 * 4.8), 1e-12);
      EXPECT_NEAR(placement.smallest_gap, 2e-4, 1e-15);
      EXPECT_EQ(placement.moved + placement.dropped, 0);
      expect_sound(placement, room);
    }
}

TEST(Array, FindsTheDiameterThatGivesTheFraction) {
  const Room room = room_with(Sides::periodic, 6);
  for (const Shape shape : {Shape::disc, Shape::ellipse, Shape::rectangle}) {
    Family family = family_of(shape, 0.25);
    family.diameter = 0;
    const Placement placement = place_in_array(family, room, {Arrangement::hexagonal, 6, 4, 0});
    EXPECT_NEAR(placement.fraction[0], 0.25, 1e-12);
    expect_sound(placement, room);
  }
}

/// The bottom row lies .6 mm above the bottom; with .4 mm kept out, and another .04 mm of clearance, discs of
/// .8 mm must rise by .24 mm.
TEST(Array, RepairsOrDropsInclusions) {
  Room room = room_with(Sides::kept_out, 6);
  Family family = family_of(Shape::disc, 0);
  family.diameter = 8e-4;
  const Placement repaired = place_in_array(family, room, {Arrangement::square, 6, 4, 2.5e-4});
  EXPECT_EQ(repaired.moved, 6);
  EXPECT_EQ(repaired.dropped, 0);
  EXPECT_NEAR(repaired.inclusions[0].centre[1], room.block.lower[1] + 8.4e-4, 1e-9);
  expect_sound(repaired, room);
  const Placement thinned = place_in_array(family, room, {Arrangement::square, 6, 4, 2.3e-4});
  EXPECT_EQ(thinned.dropped, 6);
  EXPECT_EQ(thinned.inclusions.size(), 18u);
}

/// Discs of 1 mm - .02 mm fit between their neighbours, .96² pi / 4 and so on in cells of 1.2 mm².
TEST(Array, RefusesTheImpossibleWithTheValueThatWorks) {
  const Room room = room_with(Sides::periodic, 6);
  const auto text = [&](const Family& family, const Array& array) -> std::string {
    try {
      place_in_array(family, room, array);
    } catch (const UserError& error) {
      return error.what();
    }
    return "placed";
  };
  Family family = family_of(Shape::disc, 0);
  family.diameter = 1.1e-3;
  EXPECT_EQ(
      text(family, {Arrangement::square, 6, 4, 0}),
      "-diameter 0.0011 leaves -0.0001 m between the inclusions of the array, less than the gap of 2e-05 "
      "m; give at most 0.00098, or a smaller -gap");
  family.diameter = 0.98e-3;
  EXPECT_EQ(text(family, {Arrangement::square, 6, 4, 0}), "placed");
  family.diameter = 0;
  family.fraction = 0.7;
  // .98² pi / 4 / 1.2
  EXPECT_NE(text(family, {Arrangement::square, 6, 4, 0}).find("; give at most 0.628, or"), std::string::npos);
  EXPECT_EQ(text(family, {Arrangement::hexagonal, 6, 3, 0}),
            "-rows 3: a hexagonal array that is periodic along y has an even number of rows; give 4");
}
