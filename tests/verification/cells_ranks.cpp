#include <gtest/gtest.h>

#include <cmath>

#include "cells_checks.hpp"
#include "report.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// Discs in a distorted cell of triangles and quadrilaterals.
Block discs(CellBoundary boundary) {
  Block block;
  block.nx = 24;
  block.ny = 20;
  block.shape = Shape::mixed;
  block.distortion = 0.15;
  block.periodic_x = block.periodic_y = boundary == CellBoundary::periodic;
  block.region = [](double x, double y) { return std::hypot(x - 0.3, y - 0.4) < 0.27 || x > 0.9 ? 2 : 1; };
  return block;
}

/// Largest difference between what these ranks find and what one rank finds alone.
double difference_to_one_rank(CellBoundary boundary) {
  const std::string file = scratch("ranks.msh");
  write_block(discs(boundary), file);
  const Material matrix = isotropic(1e9, 0.3, 1), inclusion = isotropic(20e9, 0.3, 1);
  const Mesh parts = read_mesh(PETSC_COMM_WORLD, {file}), whole = read_mesh(PETSC_COMM_SELF, {file});
  const CellSolution found = solve(parts, two_materials(parts, matrix, inclusion), boundary),
                     alone = solve_cell(PETSC_COMM_SELF, whole, two_materials(whole, matrix, inclusion),
                                        boundary);
  double difference = worse(relative_difference(found.stiffness, alone.stiffness),
                            relative_difference(found.energy_stiffness, alone.energy_stiffness));
  for (int cell = 0; cell < parts.cells.size(); ++cell)
    difference =
        worse(difference, largest(found.localisation[cell] - alone.localisation[parts.cells.number[cell]]));
  MPI_Allreduce(MPI_IN_PLACE, &difference, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return difference;
}

}  // namespace

/// Every rank solves the whole cell alone as well. The tolerance of the residual is 1e-10, and a strain is
/// off by up to the contrast times that of it.
TEST(CellSolver, FindsTheSameOnAnyRanks) {
  for (const bool iterative : {false, true}) {
    double worst = 0;
    for (const CellBoundary boundary : {CellBoundary::periodic, CellBoundary::kubc, CellBoundary::subc}) {
      const PetscChoice chosen = iterative ? multigrid() : PetscChoice({});
      worst = worse(worst, difference_to_one_rank(boundary));
    }
    const double bound = iterative ? 1e-8 : 1e-10;
    EXPECT_LE(worst, bound) << (iterative ? "multigrid" : "factorisation");
    report({"Same cell on any number of ranks",
            std::string("difference of C (relative) and of A to one rank, ") +
                (iterative ? "multigrid" : "factorisation"),
            format("<= {:.0e}", bound), shown_error(worst, bound / 4), "", "residual to 1e-10"});
  }
}
