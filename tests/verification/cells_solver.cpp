#include <gtest/gtest.h>

#include <cmath>

#include "cells_checks.hpp"
#include "cells_composite.hpp"
#include "report.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

struct Contrast {
  double young, poisson;  ///< of the inclusion over that of the matrix; of both
};

PetscInt most_iterations(const CellSolution& solution) {
  PetscInt most = 0;
  for (const CaseCost& cost : solution.cost) most = std::max(most, cost.iterations);
  return most;
}

CellSolution solve(const Mesh& mesh, const Contrast& contrast) {
  return testing_support::solve(mesh, two_materials(mesh, isotropic(1e9, contrast.poisson, 1),
                                                    isotropic(1e9 * contrast.young, contrast.poisson, 1)));
}

/// Condition grows with (λ + 2G)/G = 2(1 − ν)/(1 − 2ν), and iterations with its square root; over ν = .3.
double growth_by_poisson(double poisson) { return std::sqrt(2 * (1 - poisson) / (1 - 2 * poisson) / 3.5); }

const std::string topic = "Multigrid, random discs, 40 000 unknowns, P1";

CellSolution solve_by_multigrid(const Mesh& mesh, const Contrast& contrast) {
  const PetscChoice chosen = multigrid();
  return solve(mesh, contrast);
}

CellSolution solve_directly(const Mesh& mesh, const Contrast& contrast) {
  const PetscChoice chosen = factorisation();
  return solve(mesh, contrast);
}

/// Solves by multigrid, in at most `allowed` iterations, and directly; the relative difference of C.
double compare(const Mesh& mesh, const Contrast& contrast, PetscInt allowed) {
  const CellSolution found = solve_by_multigrid(mesh, contrast), exact = solve_directly(mesh, contrast);
  EXPECT_EQ(found.solver, "cg + gamg");
  EXPECT_EQ(exact.solver, "preonly + cholesky");
  const PetscInt most = most_iterations(found);
  EXPECT_LE(most, allowed) << "contrast " << contrast.young << ", Poisson's ratio " << contrast.poisson;
  for (const CaseCost& cost : found.cost) EXPECT_EQ(cost.newton_steps, 1);
  return relative_difference(found.stiffness, exact.stiffness);
}

}  // namespace

/// Iterations at most triple from a contrast of 2 to one of 1e-4 or 1e4. Towards ν = .5 they grow as the
/// condition of displacement elements does, which lock. The factorisation gives the same C.
TEST(CellSolver, ConvergesAtAnyContrast) {
  const Mesh mesh = drawn_mesh(random_discs(0.3, 0.2, 130, CellShape::triangle));
  ASSERT_NEAR(2 * mesh.nodes.total, 40000, 2000);
  const PetscInt least = most_iterations(solve_by_multigrid(mesh, {2, 0.3}));
  EXPECT_LE(least, 40);  // twice those of an independent solver of this kind on a million unknowns
  double difference = 0;
  for (const double poisson : {0.3, 0.49}) {
    const double times = 3 * growth_by_poisson(poisson);
    for (const double young : {2.0, 1e-4, 1e-2, 1e2, 1e4})
      if (poisson == 0.3 || young == 2 || young == 1e4)
        difference = worse(difference, compare(mesh, {young, poisson},
                                               static_cast<PetscInt>(times * static_cast<double>(least))));
  }
  EXPECT_LE(difference, 1e-8);
  report({topic, "C against that by factorisation, largest relative difference of all these", "<= 1e-8",
          shown_error(difference, 3e-9), "", "factorisation by MUMPS"});
}
