#include <gtest/gtest.h>

#include "msh_text.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

class BadMesh : public testing::Test {
 protected:
  void SetUp() override { keep_petsc_messages(); }
  void TearDown() override { petsc(PetscPopErrorHandler()); }
  MshText file;
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

TEST_F(BadMesh, CutShortAnywhereInBinary) {
  const std::string whole = binary(file.text());
  EXPECT_EQ(complaint(written(whole)), "");
  for (std::size_t length = 30; length + 14 < whole.size(); length += 7)
    EXPECT_NE(complaint(written(whole.substr(0, length))), "") << "cut after " << length;
}

/// The other versions number their groups in other ways; gmsh knows them all.
TEST_F(BadMesh, OtherFormats) {
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
                    rest =
                        "$PhysicalNames\n1\n2 1 \"matrix\"\n$EndPhysicalNames\n$Nodes\n3\n1 0 0 0\n"
                        "2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n";
  for (const char* version : {"2.2 0 8", "2.2 1 8", "4 0 8", "4.2 0 8", "1 0 8"}) {
    const std::string path = written(replaced(head, "2.2 0 8", version) + rest);
    expect(complaint(path), "only MSH 4.1 is read", "convert it with gmsh -0 " + path + " -format msh41 -o ");
  }
  expect(complaint(written("$NOD\n3\n1 0 0 0\n$ENDNOD\n")), "only MSH 4.1 is read", "gmsh -0 ");
  expect(complaint(written(replaced(head, "2.2 0 8", "4.1 0 4") + rest)), "8-byte", "gmsh -0 ");
  expect(complaint(written(head + rest + "$Periodic\n1\n0 1 2\n1\n1 2\n$EndPeriodic\n")),
         "lose its periodicity", "gmsh -2 -format msh41");
}

TEST_F(BadMesh, ByteOrderOfAnotherMachine) {
  std::string bytes = binary(file.text());
  std::swap(bytes[bytes.find("4.1 1 8\n") + 8], bytes[bytes.find("4.1 1 8\n") + 11]);
  expect(complaint(written(bytes)), "byte order", "gmsh -0 ");
}

/// "4.1 1 8" written over a text, by hand or by a script.
TEST_F(BadMesh, TextThatSaysItIsBinary) {
  expect(complaint(written(replaced(file.text(), "4.1 0 8", "4.1 1 8"))), "what follows is not",
         "write 4.1 0 8");
}

TEST_F(BadMesh, PartitionedByGmsh) {
  file.entities += "$EndEntities\n$PartitionedEntities\n1\n0\n0 0 0 0\n$EndPartitionedEntities\n";
  std::string text = file.text();
  const auto at = text.find("$EndPartitionedEntities\n") + 24;
  text.erase(at, 13);  // the end of $Entities once more
  expect(complaint(written(text)), "is partitioned", "without -part");
}

TEST_F(BadMesh, CountsThatDoNotFit) {
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"1 4 1 4", "1 5 1 4"}, {"2 1 0 4", "2 1 0 5"}, {"1 4 1 4", "2 4 1 4"}, {"1 1 0\n", "1 x 0\n"}}) {
    MshText bad;
    bad.nodes = replaced(bad.nodes, from, to);
    expect(complaint(bad), "is damaged", "write it again");
  }
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"2 3 1 3", "2 4 1 3"}, {"2 1 2 2", "2 1 2 3"}, {"2 1 2 2", "2 1 2 -2"}}) {
    MshText bad;
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

/// The head of a block is gone, or another section stands amid the elements.
TEST_F(BadMesh, LinesMissingAndForeign) {
  file.nodes = replaced(file.nodes, "2 1 0 4\n", "");
  expect(complaint(file), "is damaged: $Nodes", "write it again");
  file = {};
  file.elements = replaced(file.elements, "2 1 2 2\n", "");
  expect(complaint(file), "is damaged: $Elements", "write it again");
  file = {};
  file.elements = replaced(file.elements, "3 1 3 4\n", "$Foo\n3 1 3 4\n");
  expect(complaint(file), "is damaged: $Elements", "write it again");
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

/// gmsh passes over sections that it does not know, and so do we; all others must follow one another.
TEST_F(BadMesh, Sections) {
  file.more = "$Nonsense\n1 2 3\nwords\n$EndNonsense\n";
  EXPECT_EQ(complaint(file), "");
  file.more = "$Nonsense\n1 2 3\n";
  expect(complaint(file), "$Nonsense has no end", "write it again");
  file.more = "stray words\n";
  expect(complaint(file), "outside its sections", "write it again");
  file.more = "$Nodes\n0 0 0 0\n$EndNodes\n";
  expect(complaint(file), "$Nodes stands there twice", "write it again");
  file = {};
  file.elements += "7\n";
  expect(complaint(file), "$Elements holds more than it announces", "write it again");
  std::string text = MshText().text();
  text.erase(text.find("$Entities"), text.find("$Nodes") - text.find("$Entities"));
  expect(complaint(written(text)), "$Nodes stands before $Entities", "write it again");
}

TEST_F(BadMesh, NoRegion) {
  file.names = "1\n1 1 \"bottom\"\n";
  file.entities = replaced(file.entities, "1 0 0 0 1 1 0 1 1 0", "1 0 0 0 1 1 0 0 0");
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
  expect(complaint(file), "is inverted", "mend the mesh");
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
    MshText bad;
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

TEST_F(BadMesh, CellsOfOtherShapes) {
  file.elements = "1 1 1 1\n2 1 37 1\n1 1 2 3 4\n";  // a quadrilateral of fourth order
  expect(complaint(file), "not three- or four-cornered", "gmsh -2 -order 1");
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

/// The centre of a circle, say, is no part of the body, even if it is saved with the mesh.
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
