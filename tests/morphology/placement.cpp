#include "slipscale/morphology/placement.hpp"

#include <gtest/gtest.h>

#include <random>

#include "slipscale/base/error.hpp"
#include "sound.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

std::string refusal(const std::vector<Family>& families, const Room& room) {
  try {
    place_at_random(families, room, 1);
  } catch (const UserError& error) {
    return error.what();
  }
  return "placed";
}

}  // namespace

TEST(Placement, IsSoundForAllShapesAndSides) {
  for (const Sides sides : all_sides)
    for (const Shape shape : {Shape::disc, Shape::ellipse, Shape::rectangle})
      for (const std::uint64_t seed : {1, 2, 3}) {
        const Room room = room_with(sides, 6);
        const Family family = family_of(shape, seed == 3 ? 0.5 : 0.35);
        SCOPED_TRACE("sides " + std::to_string(static_cast<int>(sides)) + ", shape " +
                     std::to_string(static_cast<int>(shape)) + ", seed " + std::to_string(seed));
        const Placement placement = place_at_random({family}, room, seed);
        expect_sound(placement, room);
        const double one = area(placement.inclusions[0]) / (room.block.width() * room.block.height());
        EXPECT_NEAR(placement.fraction[0], family.fraction, 0.5 * one * (1 + 1e-9));
        EXPECT_NEAR(brute_force_fraction(placement, room, 0), placement.fraction[0], 4e-4);
      }
}

/// Random sequential placement of discs jams at .547 (Feder 1980), with this gap at .526.
TEST(Placement, RelaxesDiscsToSixTenths) {
  for (const Sides sides : all_sides) {
    const Room room = room_with(sides, 25);
    const Placement placement = place_at_random({family_of(Shape::disc, 0.6)}, room, 1);
    EXPECT_GT(placement.inclusions.size(), 350u);
    EXPECT_GT(placement.relaxed, 0);
    EXPECT_GE(placement.smallest_gap, room.gap);
    EXPECT_NEAR(placement.fraction[0], 0.6, 0.5 * pi / 4 / (25 * 20) + 1e-9);
    for (const Inclusion& inclusion : placement.inclusions) EXPECT_FALSE(side_fault(inclusion, room).found);
  }
}

TEST(Placement, ReachesTheFractionOfEachFamily) {
  for (const Sides sides : {Sides::periodic, Sides::cut}) {
    const Room room = room_with(sides, 9);
    Family small = family_of(Shape::disc, 0.25), large = family_of(Shape::rectangle, 0.25);
    small.diameter = 4e-4;
    const Placement placement = place_at_random({small, large}, room, 5);
    expect_sound(placement, room);
    for (const int k : {0, 1}) {
      double largest = 0;
      for (const Inclusion& inclusion : placement.inclusions)
        if (inclusion.family == k) largest = std::max(largest, area(inclusion));
      EXPECT_NEAR(placement.fraction[k], 0.25, 0.5 * largest / (room.block.width() * room.block.height()));
      EXPECT_NEAR(brute_force_fraction(placement, room, k), placement.fraction[k], 4e-4);
    }
  }
}

TEST(Placement, IsTheSameForTheSameSeed) {
  const Room room = room_with(Sides::cut, 8);
  const Family family = family_of(Shape::ellipse, 0.5);
  const Placement one = place_at_random({family}, room, 11), same = place_at_random({family}, room, 11),
                  other = place_at_random({family}, room, 12);
  ASSERT_GT(one.relaxed, 0);
  ASSERT_EQ(one.inclusions.size(), same.inclusions.size());
  for (std::size_t k = 0; k < one.inclusions.size(); ++k) {
    EXPECT_EQ(one.inclusions[k].centre, same.inclusions[k].centre);
    EXPECT_EQ(one.inclusions[k].angle, same.inclusions[k].angle);
  }
  EXPECT_NE(one.inclusions[0].centre, other.inclusions[0].centre);
}

/// The values in the sentences: the hexagonal packing .9069 (1 / 1.02)² = .8717; a disc and its distance from
/// both walls fill the height of 4.8 mm at a diameter of 4.8 - .08 mm.
TEST(Placement, RefusesTheImpossibleWithTheValueThatWorks) {
  const Room room = room_with(Sides::periodic, 6), inside = room_with(Sides::inside, 6);
  EXPECT_EQ(
      refusal({family_of(Shape::disc, 0.9)}, room),
      "-fraction 0.9 is more than the densest packing with a gap of 2e-05 m allows; give less than 0.871, "
      "or a smaller -gap");
  Family large = family_of(Shape::disc, 0.3);
  large.diameter = 5e-3;
  EXPECT_EQ(
      refusal({large}, inside),
      "-diameter 0.005 gives inclusions of 0.005 m along the height of the block (0.0048 m), where there "
      "is room for 0.00472 m; give at most 0.00472");
  Family few = family_of(Shape::disc, 0.01);
  few.region = "fibre";
  EXPECT_EQ(
      refusal({family_of(Shape::disc, 0.3), few}, room),
      "-families_fibre_fraction 0.01 is less than half an inclusion in the block; give at least 0.027, or "
      "a smaller -families_fibre_diameter");
}

/// Above the fraction of random close packing, .84 (Berryman 1983) with a gap of 2 %, .81, nothing relaxes
/// that is not a crystal. What the sentence recommends works.
TEST(Placement, RefusesWhatDoesNotRelax) {
  const Room room = room_with(Sides::inside, 8);
  Family family = family_of(Shape::disc, 0.8);
  const std::string text = refusal({family}, room), before = "random placement comes to ";
  ASSERT_EQ(text.find("-fraction 0.8 cannot be reached with a gap of 2e-05 m: "), 0u) << text;
  ASSERT_NE(text.find("; give that, a smaller -gap, or -edge cut"), std::string::npos) << text;
  family.fraction = std::stod(text.substr(text.find(before) + before.size()));
  EXPECT_GT(family.fraction, 0.55);
  expect_sound(place_at_random({family}, room, 1), room);
}

/// An inclusion at a fault is moved by the way that mends it, and no further than it takes to get over the
/// clearance; near a corner it may take several moves.
TEST(Placement, MendsInclusionsAtSides) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> part;
  for (const Sides sides : {Sides::periodic, Sides::cut})
    for (const Shape shape : {Shape::disc, Shape::ellipse, Shape::rectangle}) {
      const Room room = room_with(sides, 4);
      int found = 0;
      for (int k = 0; k < 3000; ++k) {
        Inclusion inclusion{shape, {}, 0.5e-3, shape == Shape::disc ? 0.5e-3 : 0.25e-3, 0, 0, 0};
        if (shape == Shape::rectangle) inclusion.corner = 1e-4;
        if (shape != Shape::disc) inclusion.angle = 2 * pi * part(engine);
        for (const int axis : {0, 1})
          inclusion.centre[axis] =
              room.block.lower[axis] + part(engine) * (room.block.upper[axis] - room.block.lower[axis]);
        const Fault fault = side_fault(inclusion, room);
        found += fault.found;
        EXPECT_LE(std::hypot(fault.way[0], fault.way[1]), 3 * room.clearance);
        for (const int axis : {0, 1}) inclusion.centre[axis] += fault.way[axis];
        expect_clear(reference_polygon(inclusion, corners), room);
      }
      EXPECT_GT(found, 100);
    }
}

/// A disc over a corner of a block that is periodic in both has images in the three other corners.
TEST(Placement, ImagesReachIntoTheBlock) {
  const Room room = room_with(Sides::periodic, 6);
  Inclusion disc{Shape::disc, room.block.lower, 0.5e-3, 0.5e-3, 0, 0, 0};
  EXPECT_EQ(images(disc, room).size(), 4u);
  // Beyond the corner of the block, though not beyond either side.
  disc.centre = {room.block.lower[0] + 0.4e-3, room.block.lower[1] + 0.4e-3};
  EXPECT_EQ(images(disc, room).size(), 3u);
  disc.centre = {room.block.lower[0] + 0.4e-3, room.block.lower[1] + 1e-3};
  EXPECT_EQ(images(disc, room).size(), 2u);
  EXPECT_EQ(images(disc, room_with(Sides::cut, 6)).size(), 1u);
}
