#include <gtest/gtest.h>

#include "cells_checks.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

const std::vector<Material> material{isotropic(1e9, 0.3, 1)};

Mesh block(bool along_x, bool along_y) {
  Block block;
  block.periodic_x = along_x;
  block.periodic_y = along_y;
  return block_mesh(block);
}

void expect_refused(const Mesh& mesh, CellBoundary boundary, const std::vector<std::string>& words) {
  try {
    solve(mesh, material, boundary);
    ADD_FAILURE() << "accepted, though it should complain of " << words.front();
  } catch (const UserError& error) {
    for (const std::string& word : words)
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << ": " << error.what();
  }
}

}  // namespace

TEST(CellRefusals, PeriodicNeedsATorus) {
  const Mesh open = block(false, false), strip = block(true, false);
  expect_refused(open, CellBoundary::periodic,
                 {"-cell_boundary periodic", open.file, "outer edges", "-cell_boundary kubc or subc"});
  expect_refused(strip, CellBoundary::periodic, {"-cell_boundary periodic", "along one axis only"});
}

TEST(CellRefusals, TheOthersNeedABoundary) {
  const Mesh torus = block(true, true);
  expect_refused(torus, CellBoundary::kubc,
                 {"-cell_boundary kubc", torus.file, "outer boundary", "-cell_boundary periodic"});
  expect_refused(torus, CellBoundary::subc,
                 {"-cell_boundary subc", torus.file, "outer boundary", "-cell_boundary periodic"});
}

/// The reason, the case, and what to try.
TEST(CellRefusals, ASolverThatStopsEarlySaysSo) {
  const PetscChoice hasty({{"-cell_ksp_type", "cg"}, {"-cell_pc_type", "none"}, {"-cell_ksp_max_it", "1"}});
  Block uneven;
  uneven.distortion = 0.2;
  uneven.nx = uneven.ny = 12;
  expect_refused(block_mesh(uneven), CellBoundary::subc,
                 {"unit load xx", "did not converge", "KSP", "DIVERGED_ITS", "-cell_ksp_max_it",
                  "-cell_pc_type cholesky"});
}
