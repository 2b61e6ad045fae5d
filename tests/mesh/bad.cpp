#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "scenes.hpp"
#include "slipscale/base/parallel.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// A mesh file of parts, each of which a test may spoil: the unit square, two triangles.
struct File {
  std::string format = "4.1 0 8\n";
  std::string names = "2\n1 1 \"bottom\"\n2 1 \"matrix\"\n";
  std::string entities =
      "0 1 1 0\n"
      "1 0 0 0 1 0 0 1 1 0\n"
      "1 0 0 0 1 1 0 1 1 0\n";
  std::string nodes =
      "1 4 1 4\n"
      "2 1 0 4\n1\n2\n3\n4\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  std::string elements =
      "2 3 1 3\n"
      "1 1 1 1\n1 1 2\n"
      "2 1 2 2\n2 1 2 3\n3 1 3 4\n";
  std::string more;

  std::string text() const {
    return "$MeshFormat\n" + format + "$EndMeshFormat\n$PhysicalNames\n" + names +
           "$EndPhysicalNames\n$Entities\n" + entities + "$EndEntities\n$Nodes\n" + nodes +
           "$EndNodes\n$Elements\n" + elements + "$EndElements\n" + more;
  }
};

std::string written(const std::string& text) {
  const std::string path = scratch("bad.msh");
  if (is_root(PETSC_COMM_WORLD)) std::ofstream(path, std::ios::binary) << text;
  MPI_Barrier(PETSC_COMM_WORLD);
  return path;
}

/// The sentence of the UserError that reading raises; empty when it raises none on some rank.
std::string complaint(const std::string& path) {
  std::string text;
  try {
    read_mesh(PETSC_COMM_WORLD, {path});
  } catch (const UserError& error) {
    text = error.what();
  }
  int all = !text.empty();
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD);
  return all ? text : "";
}

std::string complaint(const File& file) { return complaint(written(file.text())); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// One sentence with the fault and the cure.
void expect(const std::string& complaint, const std::string& fault, const std::string& cure) {
  EXPECT_NE(complaint.find(fault), std::string::npos) << "fault '" << fault << "' not in: " << complaint;
  EXPECT_NE(complaint.find(cure), std::string::npos) << "cure '" << cure << "' not in: " << complaint;
  EXPECT_EQ(complaint.find('\n'), std::string::npos);
}

class BadMesh : public testing::Test {
 protected:
  void SetUp() override { keep_petsc_messages(); }
  void TearDown() override { petsc(PetscPopErrorHandler()); }
  File file;
};

}  // namespace

TEST_F(BadMesh, TheUnspoiltFileIsGood) {
  EXPECT_NEAR(read_mesh(PETSC_COMM_WORLD, {written(file.text())}).area(), 1, 1e-14);
}

TEST_F(BadMesh, Missing) {
  expect(complaint(std::string("/nowhere/x.msh")), "cannot read '/nowhere/x.msh'", "give the path");
}

TEST_F(BadMesh, Folder) { expect(complaint(std::string("/tmp")), "cannot read '/tmp'", "give the path"); }

TEST_F(BadMesh, NotFromGmsh) {
  expect(complaint(written("solid ascii\nfacet normal 0 0 1\n")), "not a gmsh mesh", "gmsh -2");
  expect(complaint(written("")), "not a gmsh mesh", "gmsh -2");
}

/// Cut after any part of its bytes: no rank may be left waiting for another.
TEST_F(BadMesh, CutShortAnywhere) {
  const std::string whole = file.text();
  for (std::size_t length = 30; length + 14 < whole.size(); length += 7)
    EXPECT_NE(complaint(written(whole.substr(0, length))), "") << "cut after " << whole.substr(0, length);
}

TEST_F(BadMesh, CutShortInOtherFormats) {
  const std::string old =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 "
      "\"matrix\"\n$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n"
      "2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n";
  EXPECT_EQ(complaint(written(old)), "");
  for (std::size_t length = 30; length + 14 < old.size(); length += 7)
    EXPECT_NE(complaint(written(old.substr(0, length))), "") << old.substr(0, length);
  // Complete as to its sections, yet one node is missing: PETSc notices on rank 0 only.
  expect(complaint(written(replaced(old, "3 0 1 0\n", ""))), "cannot be read", "gmsh -2 -format msh41");
}

TEST_F(BadMesh, CountsThatDoNotFit) {
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"1 4 1 4", "1 5 1 4"}, {"2 1 0 4", "2 1 0 5"}, {"1 4 1 4", "2 4 1 4"}, {"1 1 0\n", "1 x 0\n"}}) {
    File bad;
    bad.nodes = replaced(bad.nodes, from, to);
    expect(complaint(bad), "is damaged", "write it again");
  }
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"2 3 1 3", "2 4 1 3"}, {"2 1 2 2", "2 1 2 3"}, {"2 1 2 2", "2 1 2 -2"}}) {
    File bad;
    bad.elements = replaced(bad.elements, from, to);
    expect(complaint(bad), "is damaged: $Elements", "write it again");
  }
}

TEST_F(BadMesh, NumbersThatLeadNowhere) {
  file.elements = replaced(file.elements, "3 1 3 4", "3 1 3 7");
  expect(complaint(file), "names node 7", "write it again");
  file = {};
  file.elements = replaced(file.elements, "2 1 2 2\n", "2 9 2 2\n");
  expect(complaint(file), "$Entities does not list", "write it again");
  file = {};
  file.nodes = replaced(file.nodes, "\n4\n", "\n3\n");
  expect(complaint(file), "node tag 3", "write it again");
}

/// A block of lines cannot be part of a surface, nor a block of cells part of a curve.
TEST_F(BadMesh, CellsOfACurve) {
  file.elements = replaced(file.elements, "2 1 2 2\n", "1 1 2 2\n");
  expect(complaint(file), "$Entities does not list", "write it again");
}

TEST_F(BadMesh, PeriodsThatLeadNowhere) {
  file.more = "$Periodic\n1\n1 1 1\n0\n1\n4 9\n$EndPeriodic\n";
  expect(complaint(file), "$Periodic names node 9", "write it again");
  file.more = "$Periodic\n1\n1 1 1\n0\n3\n1 2\n2 3\n3 2\n$EndPeriodic\n";
  expect(complaint(file), "in a circle", "write it again");
}

/// The model is plane, yet what is no number stands for a damaged file.
TEST_F(BadMesh, NotANumberForTheThirdCoordinate) {
  file.nodes = replaced(file.nodes, "1 1 0\n", "1 1 nan\n");
  expect(complaint(file), "not a number", "write it again");
}

TEST_F(BadMesh, UnknownSection) {
  file.more = "$Nonsense\n1\n$EndNonsense\n";
  file.format = "4.1 0 8\n$EndMeshFormat\n$Nonsense\n1\n$EndNonsense\n$MeshFormat\n4.1 0 8\n";
  EXPECT_NE(complaint(file), "");
}

TEST_F(BadMesh, NoRegion) {
  file.names = "1\n1 1 \"bottom\"\n";
  expect(complaint(file), "names no region", "add Physical Surface");
}

/// As Mesh.SaveAll writes it: the surface carries no physical tag.
TEST_F(BadMesh, CellWithoutRegion) {
  file.entities = "0 1 2 0\n1 0 0 0 1 0 0 1 1 0\n1 0 0 0 1 1 0 1 1 0\n2 0 0 0 1 1 0 0 0\n";
  file.elements = "3 3 1 3\n1 1 1 1\n1 1 2\n2 1 2 1\n2 1 2 3\n2 2 2 1\n3 1 3 4\n";
  expect(complaint(file), "belongs to no region", "put its surface in a Physical Surface (known: matrix)");
}

TEST_F(BadMesh, CellInTwoRegions) {
  file.names = "3\n1 1 \"bottom\"\n2 1 \"matrix\"\n2 2 \"inclusion\"\n";
  file.entities = replaced(file.entities, "1 0 0 0 1 1 0 1 1 0", "1 0 0 0 1 1 0 2 1 2 0");
  expect(complaint(file), "both regions 'matrix' and 'inclusion'", "leave it in one");
}

TEST_F(BadMesh, InvertedCell) {
  file.elements = replaced(file.elements, "3 1 3 4", "3 1 4 3");
  expect(complaint(file), "is inverted", "reverse the surface's orientation");
}

TEST_F(BadMesh, ConcaveQuadrilateral) {
  file.nodes = replaced(file.nodes, "1 1 0\n", "0.2 0.2 0\n");
  file.elements = "2 2 1 2\n1 1 1 1\n1 1 2\n2 1 3 1\n2 1 2 3 4\n";
  expect(complaint(file), "not convex", "mend the mesh");
}

TEST_F(BadMesh, DegenerateCell) {
  file.nodes = replaced(file.nodes, "0 1 0\n", "0.5 0.5 0\n");
  expect(complaint(file), "is degenerate", "mend the mesh");
}

TEST_F(BadMesh, NotANumberForACoordinate) {
  for (const char* number : {"nan", "inf"}) {
    File bad;
    bad.nodes = replaced(bad.nodes, "1 1 0\n", std::string(number) + " 1 0\n");
    EXPECT_NE(complaint(bad), "") << number;
  }
}

TEST_F(BadMesh, NameUsedTwice) {
  file.names = "2\n1 1 \"matrix\"\n2 1 \"matrix\"\n";
  expect(complaint(file), "'matrix' for two physical groups", "give each its own");
}

TEST_F(BadMesh, NameWithASpace) {
  file.names = "2\n1 1 \"bottom\"\n2 1 \"soft matrix\"\n";
  expect(complaint(file), "named 'soft matrix'", "use letters");
}

TEST_F(BadMesh, EmptyGroups) {
  file.names = "3\n1 1 \"bottom\"\n2 1 \"matrix\"\n2 2 \"inclusion\"\n";
  expect(complaint(file), "region 'inclusion' holds no cell", "remove this physical surface");
  file.names = "3\n1 1 \"bottom\"\n1 2 \"top\"\n2 1 \"matrix\"\n";
  expect(complaint(file), "boundary 'top' holds no edge", "remove this physical curve");
}

TEST_F(BadMesh, Volume) {
  file.entities = replaced(file.entities, "0 1 1 0", "0 1 1 1") + "1 0 0 0 1 1 1 0 0\n";
  file.nodes = replaced(file.nodes, "0 1 0\n", "0 1 1\n");
  file.elements = replaced(file.elements, "2 3 1 3", "3 4 1 4") + "3 1 4 1\n4 1 2 3 4\n";
  expect(complaint(file), "3-dimensional", "gmsh -2");
}

TEST_F(BadMesh, SecondOrder) {
  file.nodes = "1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n1 1 0\n.5 0 0\n1 .5 0\n.5 .5 0\n";
  file.elements = "1 1 1 1\n2 1 9 1\n1 1 2 3 4 5 6\n";
  expect(complaint(file), "not three- or four-cornered and straight", "gmsh -order 1");
}

TEST_F(BadMesh, PeriodicInOldFormat) {
  const std::string old =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 "
      "\"matrix\"\n$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n"
      "2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n$Periodic\n1\n0 1 2\n1\n1 "
      "2\n"
      "$EndPeriodic\n";
  expect(complaint(written(old)), "loses periodicity", "msh41");
}

TEST_F(BadMesh, FewerThanThreeCellsAcrossATorus) {
  for (Shape shape : {Shape::triangles, Shape::quadrilaterals})
    for (int nx : {1, 2}) {
      Block block;
      block.nx = nx;
      block.shape = shape;
      block.periodic_x = true;
      const std::string path = scratch("narrow.msh");
      write_block(block, path);
      expect(complaint(path), "fewer than three cells across a period", "mesh it finer");
    }
}

/// The centre of a circle, say, is no part of the body.
TEST_F(BadMesh, NodeOfNoCellIsLeftOut) {
  file.nodes = "1 5 1 5\n2 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 2 0\n";
  const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {written(file.text())});
  EXPECT_EQ(mesh.nodes.total, 4);
  EXPECT_EQ(mesh.upper[1], 1);
}

TEST_F(BadMesh, LineBesideTheCells) {
  file.nodes = "1 5 1 5\n2 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 2 0\n";
  file.elements = "2 3 1 3\n1 1 1 1\n1 4 5\n2 1 2 2\n2 1 2 3\n3 1 3 4\n";
  expect(complaint(file), "belongs to no cell", "save only");
}

TEST_F(BadMesh, PointsOrLinesOnly) {
  file.elements = "1 1 1 1\n1 1 1 1\n1 1 2\n";
  expect(complaint(file), "only points or lines", "mesh its surfaces");
  file.entities = "1 1 1 0\n1 0 0 0 0\n1 0 0 0 1 0 0 1 1 0\n1 0 0 0 1 1 0 1 1 0\n";
  file.elements = "1 1 1 1\n0 1 15 1\n1 1\n";
  expect(complaint(file), "only points or lines", "mesh its surfaces");
  file.elements = "0 0 0 0\n";
  expect(complaint(file), "only points or lines", "mesh its surfaces");
}
