// Patch tests: a linear displacement field is reproduced exactly, on any mesh and with any material.
#include <gtest/gtest.h>
#include <petscksp.h>

#include <algorithm>

#include "assembled.hpp"
#include "bodies.hpp"
#include "report.hpp"
#include "slipscale/dynamics/model.hpp"
#include "slipscale/solid/stress.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

const Eigen::Matrix2d gradient = (Eigen::Matrix2d() << 2e-4, -7e-4, 3e-4, 5e-4).finished();
const std::string patch_topic =
    "Linear field on a distorted mesh, P1, Q1 and mixed, isotropic and anisotropic";
const Eigen::Vector3d strain(2e-4, 5e-4, -4e-4);  // xx, yy, engineering shear

Vector2 linear(const Vector2& x) {
  return {gradient(0, 0) * x[0] + gradient(0, 1) * x[1], gradient(1, 0) * x[0] + gradient(1, 1) * x[1]};
}

struct Patch {
  Shape shape;
  Material material;
};

std::vector<Patch> patches() {
  std::vector<Patch> all;
  for (Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed})
    for (const Material& material : {isotropic(30e9, 0.25, 1800), anisotropic()})
      all.push_back({shape, material});
  return all;
}

Mesh mesh_of(const Patch& patch) {
  Block block = block_of(Body{patch.shape, false});
  block.region = [](double, double) { return 1; };
  return block_mesh(block);
}

std::vector<char> on_the_rim(const Mesh& mesh) {
  std::vector<char> rim(mesh.nodes.number.size(), 0);
  for (const Boundary& boundary : mesh.boundaries)
    for (int node : boundary.nodes) rim[node] = 1;
  return rim;
}

}  // namespace

TEST(Patch, InnerNodesAreInBalance) {
  double worst = 0;
  for (const Patch& patch : patches()) {
    const Mesh mesh = mesh_of(patch);
    const Model model(mesh, {patch.material}, Model::Storage::full);
    std::vector<Vector2> u, force(mesh.nodes.number.size());
    for (const Vector2& x : mesh.nodes.position) u.push_back(linear(x));
    model.multiply(u.data(), force.data());
    const auto rim = on_the_rim(mesh);
    double largest = 0, inner = 0;
    int inner_nodes = 0;
    for (int i = 0; i < mesh.nodes.owned; ++i) {
      const double size = worse(std::abs(force[i][0]), std::abs(force[i][1]));
      inner_nodes += !rim[i];
      (rim[i] ? largest : inner) = worse(rim[i] ? largest : inner, size);
    }
    largest = largest_of_ranks(largest);
    inner = largest_of_ranks(inner);
    MPI_Allreduce(MPI_IN_PLACE, &inner_nodes, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
    EXPECT_LT(inner, 1e-12 * largest);
    EXPECT_EQ(inner_nodes, 11 * 7);
    worst = worse(worst, inner / largest);
  }
  report({patch_topic, "force on inner nodes over that on the rim", "<= 1e-12", shown_error(worst, 1e-12), "",
          "exact solution"});
}

TEST(Patch, StressIsUniform) {
  double worst = 0;
  for (const Patch& patch : patches()) {
    const Mesh mesh = mesh_of(patch);
    std::vector<Vector2> u;
    for (const Vector2& x : mesh.nodes.position) u.push_back(linear(x));
    std::vector<std::array<double, 3>> stress;
    cell_stress(mesh, {patch.material}, u.data(), stress);
    ASSERT_EQ(static_cast<int>(stress.size()), mesh.cells.size());
    const Eigen::Vector3d expected = patch.material.stiffness * strain;
    for (const auto& s : stress)
      for (int k = 0; k < 3; ++k) worst = worse(worst, std::abs(s[k] - expected[k]) / expected.norm());
  }
  worst = largest_of_ranks(worst);
  EXPECT_LE(worst, 1e-12);
  report({patch_topic, "stress of any cell, relative error", "<= 1e-12", shown_error(worst, 1e-12), "",
          "exact solution"});
}

/// With the rim prescribed, a solver finds the linear field inside from a rough start.
TEST(Patch, AStaticSolutionRecoversTheField) {
  double worst = 0;
  for (const Patch& patch : patches()) {
    const Mesh mesh = mesh_of(patch);
    const OwnedMat matrix = assembled_stiffness(PETSC_COMM_WORLD, mesh, {patch.material}, MATAIJ);
    OwnedVec x, b;
    petsc(MatCreateVecs(matrix, x.put(), b.put()));
    PetscScalar* values = nullptr;
    petsc(VecGetArray(x, &values));
    PetscInt first = 0;
    petsc(MatGetOwnershipRange(matrix, &first, nullptr));
    std::vector<PetscInt> prescribed;
    const auto rim = on_the_rim(mesh);
    for (int i = 0; i < mesh.nodes.owned; ++i) {
      const Vector2 start = rim[i] ? linear(mesh.nodes.position[i]) : rough(mesh.nodes.number[i]);
      for (int axis = 0; axis < 2; ++axis) {
        values[2 * i + axis] = start[axis];
        if (rim[i]) prescribed.push_back(first + 2 * i + axis);
      }
    }
    petsc(VecRestoreArray(x, &values));
    petsc(
        MatZeroRowsColumns(matrix, static_cast<PetscInt>(prescribed.size()), prescribed.data(), 1e10, x, b));
    KSP solver = nullptr;
    PC preconditioner = nullptr;
    petsc(KSPCreate(PETSC_COMM_WORLD, &solver));
    petsc(KSPSetOperators(solver, matrix, matrix));
    petsc(KSPSetType(solver, KSPCG));
    petsc(KSPGetPC(solver, &preconditioner));
    petsc(PCSetType(preconditioner, PCJACOBI));
    petsc(KSPSetInitialGuessNonzero(solver, PETSC_TRUE));
    petsc(KSPSetTolerances(solver, 1e-15, 1e-50, PETSC_DEFAULT, 2000));
    petsc(KSPSolve(solver, b, x));
    petsc(KSPDestroy(&solver));
    petsc(VecGetArray(x, &values));
    for (int i = 0; i < mesh.nodes.owned; ++i)
      for (int axis = 0; axis < 2; ++axis)
        worst = worse(worst, std::abs(values[2 * i + axis] - linear(mesh.nodes.position[i])[axis]));
    petsc(VecRestoreArray(x, &values));
  }
  worst = largest_of_ranks(worst) / (7e-4 * 3e-3);  // the gradient times the size of the body
  EXPECT_LE(worst, 1e-12);
  report({patch_topic, "displacement of a static solution, relative error", "<= 1e-12",
          shown_error(worst, 1e-12), "", "exact solution"});
}
