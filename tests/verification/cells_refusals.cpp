#include <gtest/gtest.h>

#include <fstream>

#include "cells_checks.hpp"
#include "slipscale/base/parallel.hpp"

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

/// Two squares of 2 × 2 cells, 1 m apart.
Mesh two_squares() {
  const std::string file = scratch("apart.msh");
  if (is_root(PETSC_COMM_WORLD)) {
    std::ofstream out(file);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"matrix\"\n$EndPhysicalNames\n"
           "$Nodes\n18\n";
    for (int i = 0; i < 18; ++i)
      out << i + 1 << ' ' << 0.5 * (i % 3) + (i < 9 ? 0 : 2) << ' ' << 0.5 * (i % 9 / 3) << " 0\n";
    out << "$EndNodes\n$Elements\n8\n";
    for (int cell = 0; cell < 8; ++cell) {
      const int a = 1 + 9 * (cell / 4) + 3 * (cell % 4 / 2) + cell % 2;
      out << cell + 1 << " 3 2 1 1 " << a << ' ' << a + 1 << ' ' << a + 4 << ' ' << a + 3 << '\n';
    }
    out << "$EndElements\n";
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  return read_mesh(PETSC_COMM_WORLD, {file});
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

TEST(CellRefusals, PartsMustNotFloat) {
  const Mesh mesh = two_squares();
  for (const CellBoundary boundary : {CellBoundary::kubc, CellBoundary::subc})
    expect_refused(mesh, boundary, {mesh.file, "2 parts", "share no node"});
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
