#include "slipscale/relocalize/comparison_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace slipscale;

namespace {

/// Every component σ in `reference`, σ (1 + e) and σ (1 + h) in the others, on a unit area; the layer has no
/// cells.
std::vector<StressSums> sums_of(double stress, double relocalised, double homogeneous) {
  StressSums sums;
  sums.area = 1;
  const double share[]{0, relocalised, homogeneous};
  for (std::size_t s = 0; s < 3; ++s)
    for (std::size_t i = 0; i < 3; ++i) {
      sums.linear[s][i] = stress * (1 + share[s]);
      sums.quadratic[s][i] = stress * stress * (s == 0 ? 1 : share[s] * share[s]);
    }
  return {sums, {}, sums, sums};
}

/// Two frames, of errors 0.1 and 0.3 at equal stress: √((0.1² + 0.3²) / 2) over both.
Comparison example() {
  Comparison found;
  found.reference = "out/heterogeneous";
  found.zones = {{{0, 0}, {10e-3, 5e-3}}, 0, 0.5e-3, 1e-3};
  found.parts = {{"all", false, {}}, {"layer", false, {}}, {"bulk", false, {}}, {"matrix", true, {}}};
  found.time = {1e-5, 2e-5};
  found.frames = {sums_of(-20e6, 0.1, 0.2), sums_of(-20e6, 0.3, 0.6)};
  found.levels = {0.01, 0.99};
  StressQuantiles quantiles;
  for (auto& source : quantiles) source.fill({-31.25e6, -7.5e6});
  found.quantiles.assign(4, quantiles);
  found.statistics = {{"deviation", sums_of(3e6, 0.098, 0.0214)}};
  HistoryAgreement good{0.999, 1.01, 0.05}, none{std::nan(""), std::nan(""), 1};
  found.probes = {{{2.5e-3, 1e-3}, "inclusion", {good, good, good}, {none, none, none}}};
  return found;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The line that begins with `start`; runs of blanks count as one.
std::string line_of(const std::string& text, const std::string& start) {
  std::string lines;
  for (const char c : text)
    if (c != ' ' || lines.empty() || lines.back() != ' ') lines += c;
  const std::size_t at = lines.find("\n" + start);
  return at == std::string::npos ? "" : lines.substr(at + 1, lines.find('\n', at + 1) - at - 1);
}

}  // namespace

TEST(ComparisonReport, Tables) {
  const std::string text = describe(example());
  EXPECT_TRUE(has(text, "against out/heterogeneous over space and time, 2 frames, 10.00 µs to 20.00 µs"));
  EXPECT_EQ(line_of(text, "all"), "all 100.0 % 0.4472 0.2236 2.00");
  EXPECT_EQ(line_of(text, "layer ("), "layer (500.0 µm at the contact) 0.0 % - - -");
  EXPECT_EQ(line_of(text, "single"),
            "single frames, all: homogeneous 0.2000 to 0.6000, relocalised 0.1000 to 0.3000");
  EXPECT_EQ(line_of(text, "σ_xx phase matrix"), "σ_xx phase matrix -20 -24 -28");
  EXPECT_EQ(line_of(text, "deviation"), "deviation 0.0214 → 0.0980 - 0.0214 → 0.0980 0.0214 → 0.0980");
  EXPECT_EQ(line_of(text, "2.5, 1"), "2.5, 1 inclusion - → 0.9990 - → 1.0100 1.0000 → 0.0500");
  EXPECT_LT(text.find("σ_yy"), text.find("σ_xx"));
}

TEST(ComparisonReport, SaysWhenRelocalisationLoses) {
  Comparison found = example();
  found.frames = {sums_of(-20e6, 0.2, 0.1)};
  found.time = {1e-5};
  EXPECT_TRUE(has(describe(found), "one frame, 10.00 µs"));
  EXPECT_EQ(line_of(describe(found), "all"), "all 100.0 % 0.1000 0.2000 0.50 WORSE");
  found.frames = {sums_of(-20e6, 0, 0.1)};
  EXPECT_EQ(line_of(describe(found), "all"), "all 100.0 % 0.1000 0.0000 exact");
}

TEST(ComparisonReport, WhatWasNotComparedIsNotShown) {
  Comparison found = example();
  found.frames.clear();
  found.time.clear();
  found.quantiles.clear();
  found.probes.clear();
  const std::string text = describe(found), yaml = comparison_yaml(found);
  EXPECT_TRUE(has(text, "deviation"));
  EXPECT_FALSE(has(text, "frames"));
  EXPECT_FALSE(has(text, "quantile"));
  EXPECT_TRUE(has(yaml, "statistics:"));
  for (const char* key : {"error:", "frames:", "quantiles:", "probes:"}) EXPECT_FALSE(has(yaml, key)) << key;
}

TEST(ComparisonYaml, NestsPartsComponentsAndSources) {
  const std::string yaml = comparison_yaml(example());
  EXPECT_TRUE(has(yaml, "layer: 0.0005"));
  EXPECT_TRUE(has(yaml,
                  "error:  # relative L2 error over space and all frames\n  all:\n    xx:\n"
                  "      relocalised: 0.223607\n      homogeneous: 0.447214\n    yy:\n"));
  EXPECT_TRUE(has(yaml, "  phases:\n    matrix:\n      xx:\n        relocalised: 0.223607\n"));
  EXPECT_TRUE(has(yaml, "  time: [1.0e-05, 2.0e-05]  # s\n  all:\n    xx:\n      relocalised: [0.1, 0.3]\n"));
  EXPECT_TRUE(
      has(yaml, "  levels: [0.01, 0.99]\n  all:\n    xx:\n      reference: [-3.125e+07, -7.5e+06]\n"));
  EXPECT_TRUE(has(yaml, "  layer:\n    xx:\n      relocalised: .nan\n"));
  EXPECT_TRUE(has(yaml,
                  "probes:  # histories against those of the heterogeneous run\n  0:\n"
                  "    x: [0.0025, 0.001]  # m\n    region: inclusion\n"));
  EXPECT_TRUE(has(yaml, "      relocalised:\n        correlation: 0.999\n        slope: 1.01\n"));
}
