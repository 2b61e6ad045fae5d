#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/solid/element.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

struct Case {
  std::string name;
  Block block;
};

std::vector<Case> cases() {
  Block block;
  block.nx = 7;
  block.ny = 6;
  block.width = 1.3;
  block.distortion = 0.2;
  std::vector<Case> list;
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed}) {
    block.shape = shape;
    for (const bool periodic : {false, true}) {
      block.periodic_x = periodic;
      for (const bool two : {false, true}) {
        block.region = [two](double x, double y) { return two && x < 0.6 && y > 0.4 ? 2 : 1; };
        list.push_back({std::string(shape == Shape::triangles ? "P1"
                                    : shape == Shape::mixed   ? "mixed"
                                                              : "Q1") +
                            (periodic ? " periodic" : "") + (two ? " two regions" : ""),
                        block});
      }
    }
  }
  return list;
}

std::vector<Material> materials_of(const Mesh& mesh) {
  std::vector<Material> materials;
  for (const Region& region : mesh.regions)
    materials.push_back(region.name == "inclusion" ? isotropic(80e9, 0.2, 2500) : isotropic(30e9, 0.3, 1800));
  return materials;
}

/// √ of the largest eigenvalue of M⁻¹K, dense; the mesh is whole on this rank.
double dense_frequency(const Mesh& mesh, const std::vector<Material>& materials) {
  const int n = mesh.nodes.size();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(2 * n);
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const int count = mesh.cells.corner_count(cell);
    const auto corners = mesh.cells.corners_of(cell);
    const auto nodes = mesh.cells.nodes_of(cell);
    const Material& material = materials[mesh.cells.region[cell]];
    const ElementStiffness element = element_stiffness(corners, material.stiffness);
    const auto areas = corner_areas(corners);
    const auto dof = [&](int q) { return 2 * nodes[q / 2] + q % 2; };
    for (int p = 0; p < 2 * count; ++p) {
      mass[dof(p)] += material.density * areas[p / 2];
      for (int q = 0; q < 2 * count; ++q) k(dof(p), dof(q)) += element(p, q);
    }
  }
  const Eigen::VectorXd scale = mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * k * scale.asDiagonal();
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
                       .eigenvalues()
                       .maxCoeff());
}

}  // namespace

/// The sharp value is a bound from above that is hardly larger than ω_max (Lanczos stops
/// at a residual of 1e-4 of ω², which is added, and the result is rounded up to 4 digits: at most 5e-5 +
/// 1e-3); the element bound lies above. Neither depends on the number of ranks.
TEST(LargestFrequency, AgreesWithDenseEigenvaluesOnAnyNumberOfRanks) {
  double least = HUGE_VAL, most = 0;
  for (const Case& c : cases()) {
    const std::string path = scratch("frequency.msh");
    write_block(c.block, path);
    const Mesh whole = read_mesh(PETSC_COMM_SELF, {path});
    const Model serial(whole, materials_of(whole), Model::Storage::full);
    const FrequencyBounds alone = largest_frequency(PETSC_COMM_SELF, serial);
    const double exact = dense_frequency(whole, serial.materials);
    EXPECT_GE(alone.sharp, exact * (1 - 1e-12)) << c.name;
    EXPECT_LE(alone.sharp, exact * (1 + 1.1e-3)) << c.name;
    EXPECT_GE(alone.safe, exact) << c.name;
    least = std::min(least, alone.sharp / exact);
    most = std::max(most, alone.sharp / exact);

    for (const Partitioner partitioner : {Partitioner::metis, Partitioner::simple}) {
      const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {path, partitioner});
      const Model model(mesh, materials_of(mesh), Model::Storage::full);
      const FrequencyBounds together = largest_frequency(PETSC_COMM_WORLD, model);
      EXPECT_EQ(together.sharp, alone.sharp) << c.name;
      EXPECT_EQ(together.safe, alone.safe) << c.name;
    }
  }
  report({format("Largest frequency of {} bodies", cases().size()), "bound by Lanczos over the frequency",
          "1 to 1.0011", format("{:.4f} to {:.4f}", least, most), "", "dense eigenvalues, in the test"});
}

/// A Q1 square with one element across has the frequencies of its element: the space is exhausted at once.
TEST(LargestFrequency, OfASingleElementIsThatOfTheElement) {
  Block block;
  block.nx = block.ny = 1;
  block.shape = Shape::quadrilaterals;
  const std::string path = scratch("single.msh");
  write_block(block, path);
  const Mesh mesh = read_mesh(PETSC_COMM_SELF, {path});
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  const FrequencyBounds found = largest_frequency(PETSC_COMM_SELF, model);
  EXPECT_NEAR(found.safe, dense_frequency(mesh, model.materials), 1e-10);
  EXPECT_NEAR(found.sharp / found.safe, 1, 1.1e-3);
}

namespace {

std::string refusal(const Model& model, const Scene& scene, const TimeChoice& time) {
  try {
    choose_step(PETSC_COMM_WORLD, model, scene, time);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

/// An automatic step is no longer than the run.
TEST(ChooseStep, EndsWithTheRun) {
  const Mesh mesh = block_mesh({});
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  for (const double end : {1e-6, 1.0, 10.0}) {
    const TimeStep step = choose_step(PETSC_COMM_WORLD, model, {}, {std::nullopt, 0.9, end});
    EXPECT_LE(step.step, std::min(end, 0.9 * step.limit));
    EXPECT_GE(static_cast<double>(step.count) * step.step, end * (1 - 1e-12));
    EXPECT_LT(static_cast<double>(step.count - 1) * step.step, end);
  }
}

/// What is not a number passes no check, and the sentence names what made it so.
TEST(ChooseStep, RefusesWhatIsNotANumber) {
  const Mesh mesh = block_mesh({});
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Material& material :
       {isotropic(nan, 0.3, 1), isotropic(1e300, 0.3, 1e-300), isotropic(1, 0.3, 0)}) {
    const Model model(mesh, {material}, Model::Storage::full);
    EXPECT_NE(refusal(model, {}, {std::nullopt, 0.9, 1}).find("largest frequency"), std::string::npos);
    EXPECT_NE(refusal(model, {}, {1e-3, 0.9, 1}).find("largest frequency"), std::string::npos);
  }
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.damping.stiffness = nan;
  EXPECT_NE(refusal(model, scene, {std::nullopt, 0.9, 1}).find("-damping_stiffness"), std::string::npos);
  EXPECT_NE(refusal(model, {}, {nan, 0.9, 1}).find("-time_step"), std::string::npos);
}
