#include <gtest/gtest.h>

#include <cmath>

#include "cells_checks.hpp"
#include "cells_composite.hpp"
#include "report.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// The solver's tolerance, which is 1e-10 of the residual.
constexpr double tolerance = 1e-9;

const Material soft = isotropic(30e9, 0.3, 2000), stiff = isotropic(80e9, 0.3, 4000);

double symmetry_defect(const Eigen::Matrix3d& c) { return largest(c - c.transpose()) / largest(c); }

/// Largest residual of f (C₂ − C₁):⟨A⟩₂ = C_eff − C₁ over the largest of C_eff − C₁.
double identity_residual(const Mesh& mesh, const CellSolution& solution) {
  const std::vector<Eigen::Matrix3d> means = phase_means(PETSC_COMM_WORLD, mesh, solution);
  for (std::size_t k = 0; k < mesh.regions.size(); ++k)
    if (mesh.regions[k].name == "inclusion")
      return relative_difference(
          mesh.regions[k].area / mesh.area() * (stiff.stiffness - soft.stiffness) * means[k],
          solution.stiffness - soft.stiffness);
  return 1;
}

/// Smallest eigenvalue of a − b over the largest of a, of the symmetric parts in Mandel's scaling.
double excess(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Eigen::DiagonalMatrix<double, 3> scale(1, 1, std::sqrt(2.0));
  const auto spectrum = [&](const Eigen::Matrix3d& c) {
    const Eigen::Matrix3d mandel = scale * (0.5 * (c + c.transpose())) * scale;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mandel).eigenvalues();
  };
  return spectrum(a - b)[0] / spectrum(a)[2];
}

struct Compared {
  std::array<CellSolution, 3> by;                           ///< periodic, kubc, subc
  double mean = 0, energy = 0, symmetry = 0, identity = 0;  ///< largest defects
};

/// One composite as a torus, and with its sides cut open.
Compared compare(CellShape shape) {
  const std::string file = drawn_file(random_discs(0.3, 0.25, 40, shape));
  Compared compared;
  for (const CellBoundary boundary : {CellBoundary::periodic, CellBoundary::kubc, CellBoundary::subc}) {
    MeshSource source{file};
    source.cut = boundary != CellBoundary::periodic;
    const Mesh mesh = read_mesh(PETSC_COMM_WORLD, source);
    CellSolution& solution = compared.by[static_cast<int>(boundary)];
    solution = solve(mesh, two_materials(mesh, soft, stiff), boundary);
    compared.mean =
        std::max(compared.mean, largest(solution.mean_localisation - Eigen::Matrix3d::Identity()));
    compared.energy =
        std::max(compared.energy, relative_difference(solution.stiffness, solution.energy_stiffness));
    compared.symmetry = std::max(compared.symmetry, symmetry_defect(solution.stiffness));
    compared.identity = std::max(compared.identity, identity_residual(mesh, solution));
  }
  return compared;
}

}  // namespace

/// Mean strain, Hill's and Mandel's energy, Maxwell-Betti symmetry and the identity of two phases hold for
/// the discrete solution as for the exact one, under each of the three conditions.
TEST(CellConditions, KeepTheIdentitiesAndTheirOrder) {
  for (const CellShape shape : {CellShape::triangle, CellShape::quadrilateral}) {
    const Compared found = compare(shape);
    for (const double defect : {found.mean, found.energy, found.symmetry, found.identity})
      EXPECT_LE(defect, tolerance);
    const auto& [periodic, kubc, subc] = found.by;
    const double above = excess(kubc.stiffness, periodic.stiffness),
                 below = excess(periodic.stiffness, subc.stiffness);
    EXPECT_GT(above, 1e-4);  // a cell that touches inclusions with its sides feels the conditions
    EXPECT_GT(below, 1e-4);
    const std::string topic = format("Random discs, f .3, 30/80 GPa, {}, periodic, kubc and subc",
                                     shape == CellShape::triangle ? "P1" : "Q1");
    const auto row = [&](const char* quantity, double defect, const char* source) {
      report({topic, quantity, "<= 1e-9", shown_error(defect, 1e-11), "", source});
    };
    row("largest component of the mean of A - I", found.mean, "mean strain theorem");
    row("C from the mean stress against C from the energy", found.energy, "Hill and Mandel");
    row("symmetry defect of C", found.symmetry, "Maxwell and Betti");
    row("f (C2 - C1):A2 = C - C1, relative residual", found.identity, "identity of two phases");
    report({topic, "smallest eigenvalue of C_kubc - C_periodic; C_periodic - C_subc, over the largest",
            "> 0; > 0", format("{:.4f}; {:.4f}", above, below), "", "minimum principles"});
  }
}
