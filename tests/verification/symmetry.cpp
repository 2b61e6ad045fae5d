#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "report.hpp"
#include "slipscale/base/print.hpp"
#include "symmetry_case.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// Scenes with an inclusion, on triangles, quadrilaterals and both, under both thresholds and both rates,
/// before rounding has had the time to grow: an instability amplifies it without end.
std::vector<Case> cases() {
  return {with_inclusion(pressed_case(Shape::triangles, true)),
          with_inclusion(pressed_case(Shape::quadrilaterals, false)), with_inclusion(landing_case(true)),
          with_inclusion(landing_case(false))};
}

constexpr double rounding = 1e-10;  ///< grown over the run; a defect of the method would be 1e-3
const char* const topic = "Symmetry and similarity, before saturation";

/// The largest difference over all cases between a run and the run `other` makes of the same case.
template <class Other>
double worst(const Other& other) {
  double most = 0;
  for (const Case& what : cases()) most = std::max(most, largest_difference(run(what), other(what)));
  return most;
}

void expect_rounding(const std::string& quantity, double difference) {
  EXPECT_LE(difference, rounding);
  report({topic, quantity, "at most 1e-10", format("{:.1e}", difference), "", "exact symmetry"});
}

void expect_same_bits(const std::string& quantity, double difference) {
  EXPECT_EQ(difference, 0);
  report({topic, quantity, "0, every bit", format("{:g}", difference), "", "exact symmetry"});
}

double change_of_units(const Units& units) {
  return worst(
      [&](const Case& what) { return divided(run(in_units(what, units)), units.length, units.speed()); });
}

double change_of_scale(double factor) {
  return worst([&](const Case& what) { return divided(run(scaled(what, factor)), factor, factor); });
}

}  // namespace

/// Without sticking, opening and lopsidedness the tests below would say little.
TEST(Symmetry, CasesShowAllThereIs) {
  StatusCount seen;
  for (const Case& what : cases()) {
    const State state = run(what);
    seen.open += state.count.open;
    seen.stick += state.count.stick;
    seen.slip += state.count.slip;
    EXPECT_GT(largest_difference(state, mirrored(state, what.block.nx)), 0.1) << what.name;
    Case plain = what;
    plain.materials[1] = plain.materials[0];
    EXPECT_GT(largest_difference(state, run(plain)), 0.01) << what.name;
  }
  EXPECT_TRUE(seen.all_seen()) << seen.open << ", " << seen.stick << ", " << seen.slip;
}

/// On the mirrored mesh nodes are summed in another order, so this holds to rounding only.
TEST(Symmetry, MirrorsWithTheDirectionOfSliding) {
  expect_rounding("V to -V on the mirrored mesh, largest relative difference of u and v",
                  worst([](const Case& what) { return mirrored(run(mirrored(what)), what.block.nx); }));
}

TEST(Similarity, KeepsInOtherUnits) {
  expect_rounding("units mm, us, kg", change_of_units({1e3, 1e6, 1}));
  // Powers of two scale without rounding: no hidden length, time or stress anywhere.
  expect_same_bits(
      "units that are powers of two of SI",
      std::max(change_of_units({0x1p10, 0x1p20, 0x1p-10}), change_of_units({0x1p-40, 0x1p-3, 0x1p40})));
}

/// Linear elasticity, a flat surface and a law without inner stress: all that moves scales.
TEST(Similarity, ScalesWithSpeedLoadAndSlipLength) {
  expect_rounding("V, load and L* times 3", change_of_scale(3));
  expect_same_bits("V, load and L* times 2^-7", change_of_scale(0x1p-7));
}

TEST(Similarity, CompositeWithoutContrastIsHomogeneous) {
  double most = 0;
  for (const Case& what : cases()) {
    Case composite = what, homogeneous = what;
    composite.materials[1] = composite.materials[0];
    homogeneous.materials.resize(1);
    homogeneous.block.region = [](double, double) { return 1; };
    most = std::max(most, largest_difference(run(homogeneous), run(composite)));
  }
  expect_same_bits("two regions of one material against one region", most);
}
