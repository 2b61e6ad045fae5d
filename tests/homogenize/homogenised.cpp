#include "slipscale/homogenize/homogenised.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "../../src/solid/effective_file.hpp"
#include "block_mesh.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;

namespace {

Eigen::Matrix3d matrix(double xx, double yy, double xy, double shear) {
  Eigen::Matrix3d c;
  c << xx, xy, 0, xy, yy, 0, 0, 0, shear;
  return c;
}

/// Exact: laminate of 30 and 80 GPa, half and half, normal y.
Eigen::Matrix3d laminate() { return matrix(71.228771e9, 58.741259e9, 25.174825e9, 16.783217e9); }

CellSolution solution(CellBoundary boundary, const Eigen::Matrix3d& stiffness) {
  CellSolution made;
  made.boundary = boundary;
  made.stiffness = made.energy_stiffness = stiffness;
  made.mean_localisation = Eigen::Matrix3d::Identity();
  made.solver = "cg + gamg";
  made.unknowns = 20402;
  made.set_up_seconds = 0.25;
  for (int k = 0; k < load_cases; ++k) made.cost[k] = {1, 17 + k, 0.5, "CONVERGED_RTOL"};
  return made;
}

Homogenised laminate_found() {
  Homogenised found;
  found.phases = {
      {"matrix", 0.5, {isotropic_stiffness(30e9, 0.3), 1200, "E 30 GPa, nu 0.3, 1200 kg/m3"}},
      {"glass: fibre", 0.5, {isotropic_stiffness(80e9, 0.3), 2600, "E 80 GPa, nu 0.3, 2600 kg/m3"}}};
  found.solutions = {solution(CellBoundary::periodic, laminate())};
  found.cells = 20000;
  found.nodes = 10201;
  found.ranks = 2;
  found.memory = 123e6;
  found.seconds = 2.5;
  return found;
}

/// The text with one blank for every run of blanks: how columns are padded is the table's matter.
std::string words(const std::string& text) {
  std::string squeezed;
  for (const char c : text)
    if (c != ' ' || squeezed.empty() || squeezed.back() != ' ') squeezed += c;
  return squeezed;
}

void expect_line(const std::string& text, const std::string& line) {
  EXPECT_NE(words("\n" + text).find("\n" + line + "\n"), std::string::npos)
      << "'" << line << "' is not a line of\n"
      << text;
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in\n" << text;
}

/// The file as `slide` reads it, which is by PETSc.
EffectiveFile read_by_slide(const std::string& text) {
  const std::string path = testing_support::scratch("effective.yaml");
  std::ofstream(path) << text;
  return read_effective_file(path, "material_file");
}

}  // namespace

TEST(EffectiveYaml, IsReadBySlide) {
  Homogenised found = laminate_found();
  found.solutions[0].stiffness(0, 2) = found.solutions[0].stiffness(2, 0) = -1.23456789e9;
  found.phase_means = {Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity()};
  found.solutions.push_back(solution(CellBoundary::kubc, 1.01 * laminate()));
  found.refined = {laminate(), laminate()};
  const EffectiveFile file = read_by_slide(effective_yaml(found, {{"stiffness", "1,2"},
                                                                  {"density", "-7"},
                                                                  {"mesh_file", "a: #b.msh"},
                                                                  {"material_all_young", "30e9"},
                                                                  {"cell_ksp_view", ""}}));
  const std::vector<double> expected{71.228771e9, 58.741259e9, 25.174825e9, 16.783217e9, -1.23456789e9, 0};
  ASSERT_EQ(file.stiffness.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(file.stiffness[k], expected[k], 1e-12 * 71e9) << k;
  EXPECT_EQ(file.density, 1900);
}

TEST(EffectiveYaml, NeedsNeitherErrorNorMeansNorOptions) {
  const EffectiveFile file = read_by_slide(effective_yaml(laminate_found(), {}));
  EXPECT_EQ(file.stiffness.size(), 6u);
  EXPECT_EQ(file.density, 1900);
}

TEST(EffectiveYaml, GivesTheSymmetricPartToSlideAndKeepsWhatWasFound) {
  Homogenised found = laminate_found();
  found.solutions[0].stiffness(0, 1) *= 1 + 1e-6;
  const std::string text = effective_yaml(found, {});
  EXPECT_NEAR(read_by_slide(text).stiffness[2] / 25.174825e9, 1 + 0.5e-6, 1e-12);
  expect_part(text, format("stiffness_xx: [7.122877100000e+10, {:.12e}, 0.000000000000e+00]",
                           25.174825e9 * (1 + 1e-6)));
  expect_part(text, "stiffness_yy: [2.517482500000e+10, 5.874125900000e+10, 0.000000000000e+00]");
}

TEST(EffectiveYaml, NestsTheReport) {
  Homogenised found = laminate_found();
  const Eigen::Matrix3d fine = laminate() - 3e6 * Eigen::Matrix3d::Identity();
  found.refined = {fine};
  const std::string text = effective_yaml(found, {{"mesh_file", "block.msh"}});
  for (const char* part :
       {"homogenize:\n", "  boundary: periodic", "  cells: 20000\n", "    \"glass: fibre\":\n",
        "      fraction: 0.5", "  periodic:\n", "    discretisation_error_xx: [4.000000000000e+06,",
        "    extrapolated_stiffness_xx: [7.122477100000e+10,", "      iterations: [17, 18, 19]\n",
        "  engineering_constants:", "  bounds:\n",
        "    hashin_shtrikman_bulk: [4.391504018370e+10, 4.597701149425e+10]", "  wave_speeds_y: [5560.26,",
        "  options:  # in effect\n    mesh_file: block.msh\n"})
    expect_part(text, part);
}

TEST(Report, TellsTheCellAndItsStiffness) {
  Homogenised found = laminate_found();
  found.solutions[0].stiffness(0, 2) = found.solutions[0].stiffness(2, 0) =
      -1e3;  // Pa: nothing, and not -0.0000
  const std::string text = describe(found);
  expect_line(text, "cell: 20000 cells, 10201 nodes");
  expect_line(text, "matrix 0.500000 28.8462 11.5385 E 30 GPa, nu 0.3, 1200 kg/m3");
  expect_line(text, "xx 71.2288 25.1748 0.0000");
  expect_line(text, "xy 0.0000 0.0000 16.7832");
  expect_line(text, "symmetry defect 0.0e+00");
  expect_line(text, "no error estimate (-cell_estimate_error)");
}

/// An error of second order leaves 4/3 of the difference of the meshes: here 4 MPa on the diagonal.
TEST(Report, ShowsRichardsonsErrorBar) {
  Homogenised found = laminate_found();
  found.refined = {laminate() - 3e6 * Eigen::Matrix3d::Identity()};
  const std::string text = describe(found);
  expect_part(text, "71.2288 ± 0.0040  25.1748 ± 0.0000");
  expect_part(text, "geometry error is not included");
  EXPECT_EQ(text.find("no error estimate"), std::string::npos);
}

TEST(Report, ComparesBoundaryConditions) {
  Homogenised found = laminate_found();
  const Eigen::Matrix3d middle = matrix(68e9, 62e9, 26e9, 18e9);
  found.solutions = {solution(CellBoundary::periodic, middle), solution(CellBoundary::kubc, 1.01 * middle),
                     solution(CellBoundary::subc, 0.99 * middle)};
  std::string text = describe(found);
  expect_line(text, "C11 67.3200 68.0000 68.6800");
  expect_part(text, "subc <= periodic  ok (");
  expect_part(text, "periodic <= kubc  ok (");
  found.solutions[1].stiffness = 0.98 * middle;
  text = describe(found);
  expect_part(text, "periodic <= kubc  VIOLATED (-");
}

TEST(Report, ChecksVoigtAndReuss) {
  Homogenised found = laminate_found();
  std::string text = describe(found);
  EXPECT_EQ(text.find("VIOLATED"), std::string::npos) << text;
  found.solutions[0].stiffness =
      laminate() + 1e6 * Eigen::Matrix3d::Identity();  // the laminate attains Voigt's
  text = describe(found);
  expect_part(words(text), "C <= Voigt VIOLATED (-");
  EXPECT_EQ(text.find("VIOLATED"), text.rfind("VIOLATED"));
}

/// Half and half of 30 and 80 GPa: 43.915 <= k <= 45.977 and 17.800 <= G <= 18.737 GPa.
TEST(Report, ChecksHashinAndShtrikman) {
  Homogenised found = laminate_found();
  std::string text = describe(found);
  expect_line(text, "plane bulk modulus k 43.9150 45.0799 45.9770 ok");
  expect_part(text, "shear modulus from 16.7832 to 19.9051 GPa");
  // Stiffer in k than the bound by .023 GPa, .05 %.
  const auto of = [](double k, double g) { return matrix(k + g, k + g, k - g, g); };
  found.solutions[0] = solution(CellBoundary::periodic, of(46e9, 18e9));
  expect_part(describe(found), "outside by 5.0e-04, no error bar to judge it by");
  found.refined = {of(45.95e9, 18e9)};  // 4/3 of .05 GPa is more than the .023
  expect_part(describe(found), "ok within the error bar");
  found.refined = {of(45.99e9, 18e9)};
  expect_part(describe(found), "outside by 5.0e-04, twice the error bar at most");
  EXPECT_TRUE(doubts(found).empty());
  found.refined = {of(45.995e9, 18e9)};
  expect_part(describe(found), "VIOLATED by 5.0e-04");
  ASSERT_EQ(doubts(found).size(), 1u);
  expect_part(effective_yaml(found, {}), "doubt: the plane bulk modulus k of 46.0000 GPa violates");
  found.solutions[0].boundary = CellBoundary::kubc;
  expect_part(describe(found), "outside by 5.0e-04, as kubc may be");
  found.phases.push_back({"third", 0, {isotropic_stiffness(1e9, 0.2), 1000, ""}});
  expect_part(describe(found), "Hashin-Shtrikman bounds: for two isotropic phases only");
}

TEST(Report, Residuals) {
  Homogenised found = laminate_found();
  CellSolution& first = found.solutions[0];
  first.energy_stiffness = laminate() * (1 + 2e-7);
  first.mean_localisation(0, 2) = -3e-5;
  EXPECT_NEAR(hill_mandel_residual(first), 2e-7, 1e-15);
  EXPECT_NEAR(mean_localisation_defect(first), 3e-5, 1e-18);
  expect_line(describe(found), "Hill-Mandel 2.0e-07");
  expect_line(describe(found), "mean of A less I 3.0e-05");
}

/// A in the second phase from the identity itself; its region comes in two parts of different mean.
TEST(Report, TwoPhaseIdentityOverAllRegionsOfAPhase) {
  Homogenised found = laminate_found();
  EXPECT_FALSE(two_phase_residual(found));  // without means
  const Eigen::Matrix3d c1 = found.phases[0].material.stiffness, c2 = found.phases[1].material.stiffness;
  const Eigen::Matrix3d second = (c2 - c1).inverse() * (laminate() - c1) / 0.5;
  found.phases.push_back({"more fibres", 0.2, found.phases[1].material});
  found.phases[1].fraction = 0.3;
  const Eigen::Matrix3d shift = 0.1 * Eigen::Matrix3d::Identity();
  found.phase_means = {2 * Eigen::Matrix3d::Identity() - second, second + shift / 0.3, second - shift / 0.2};
  EXPECT_LT(two_phase_residual(found).value(), 1e-14);
  expect_part(describe(found), "two-phase identity  ");
  found.phase_means[2] += shift;
  EXPECT_GT(two_phase_residual(found).value(), 1e-2);
}

/// Along y of the laminate: √(C22/ρ) and √(C66/ρ), ρ = 1900 kg/m³.
TEST(Report, WavesAndCosts) {
  const std::string text = describe(laminate_found());
  expect_part(
      text, format("density 1900 kg/m3; waves along x {:.6g} and {:.6g} m/s, along y {:.6g} and {:.6g} m/s\n",
                   std::sqrt(71.228771e9 / 1900), std::sqrt(16.783217e9 / 1900),
                   std::sqrt(58.741259e9 / 1900), std::sqrt(16.783217e9 / 1900)));
  expect_line(text, "periodic cg + gamg 20402 17 18 19 0.25 1.50");
  expect_line(text, "in all 2.5 s on 2 ranks, memory 123 MB");
}
