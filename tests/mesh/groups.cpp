#include "msh_text.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

Mesh read(const MshText& file) { return read_mesh(PETSC_COMM_WORLD, {written(file.text())}); }

/// The sentences about the mesh that hold the words.
int notes_with(const Mesh& mesh, const std::string& words) {
  return static_cast<int>(
      std::ranges::count_if(mesh.notes, [&](const auto& note) { return note.find(words) != note.npos; }));
}

}  // namespace

/// The sign of a tag tells how gmsh runs along the curve, not what belongs to the group.
TEST(Groups, SignsOfTagsDoNotMatter) {
  MshText file;
  file.entities = "0 1 1 0\n1 0 0 0 1 0 0 1 -1 0\n1 0 0 0 1 1 0 1 -1 0\n";
  const Mesh mesh = read(file);
  EXPECT_EQ(mesh.find_boundary("bottom")->edge_count, 1);
  EXPECT_EQ(mesh.regions[0].cells, 2);
  EXPECT_TRUE(mesh.notes.empty());
}

/// Numbers of curves are no numbers of groups: of the curves 1, 2 and 3 the group 2 holds the third.
TEST(Groups, NothingByTheNumberOfACurve) {
  MshText file;
  file.names = "2\n1 2 \"left\"\n2 1 \"matrix\"\n";
  file.entities = "0 3 1 0\n1 0 0 0 1 0 0 0 0\n2 1 0 0 1 1 0 0 0\n3 0 0 0 0 1 0 1 2 0\n1 0 0 0 1 1 0 1 1 0\n";
  file.elements = "4 5 1 5\n1 1 1 1\n1 1 2\n1 2 1 1\n2 2 3\n1 3 1 1\n3 4 1\n2 1 2 2\n4 1 2 3\n5 1 3 4\n";
  const Mesh mesh = read(file);
  ASSERT_EQ(mesh.boundary_names(), std::vector<std::string>{"left"});
  EXPECT_EQ(mesh.boundaries[0].edge_count, 1);
  EXPECT_EQ(mesh.boundaries[0].normal, (Vector2{-1, 0}));
}

TEST(Groups, WithoutName) {
  MshText file;
  file.names = "0\n";
  const Mesh mesh = read(file);
  EXPECT_EQ(mesh.region_names(), std::vector<std::string>{"surface_1"});
  EXPECT_EQ(mesh.boundary_names(), std::vector<std::string>{"curve_1"});
  EXPECT_EQ(notes_with(mesh, "surface_1, curve_1"), 1);
  MshText bare = file;  // as gmsh writes it where nobody has a name
  std::string text = bare.text();
  text.erase(text.find("$PhysicalNames"), text.find("$Entities") - text.find("$PhysicalNames"));
  EXPECT_EQ(read_mesh(PETSC_COMM_WORLD, {written(text)}).region_names(),
            std::vector<std::string>{"surface_1"});
}

TEST(Groups, NamesThatAreNumbers) {
  MshText file;
  file.names = "2\n1 1 \"42\"\n2 1 \"matrix\"\n";
  const Mesh mesh = read(file);
  EXPECT_EQ(mesh.boundary_names(), std::vector<std::string>{"curve_1"});
  EXPECT_EQ(notes_with(mesh, "'42' is called curve_1"), 1);
}

TEST(Groups, ThatWouldHaveOneName) {
  MshText file;
  file.names = "1\n2 1 \"curve_1\"\n";
  expect(complaint(file), "'curve_1' for two physical groups", "give each its own");
}

/// A surface that runs clockwise as a whole is drawn from the other side; a single such cell is a fault.
TEST(Groups, ClockwiseSurfacesAreTurned) {
  MshText file;
  file.entities = "0 1 2 0\n1 0 0 0 1 0 0 1 1 0\n1 0 0 0 1 1 0 1 1 0\n7 0 0 0 1 1 0 1 1 0\n";
  file.elements = "3 3 1 3\n1 1 1 1\n1 1 2\n2 1 2 1\n2 1 2 3\n2 7 2 1\n3 1 4 3\n";
  const Mesh mesh = read(file);
  EXPECT_NEAR(mesh.area(), 1, 1e-14);
  EXPECT_EQ(mesh.find_boundary("bottom")->normal, (Vector2{0, -1}));
  EXPECT_EQ(notes_with(mesh, "surface 7 of gmsh"), 1);
  EXPECT_EQ(mesh.notes.size(), 1u);
}

TEST(Groups, CellsOfSecondOrderGiveTheirCorners) {
  MshText file;
  file.nodes =
      "1 9 1 9\n2 1 0 9\n1\n2\n3\n4\n5\n6\n7\n8\n9\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 -.1 0\n1 .5 0\n.5 .5 "
      "0\n.5 1 0\n"
      "0 .5 0\n";
  file.elements = "2 3 1 3\n1 1 8 1\n1 1 2 5\n2 1 9 2\n2 1 2 3 5 6 7\n3 1 3 4 7 8 9\n";
  for (const std::string& bytes : {file.text(), binary(file.text())}) {
    const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {written(bytes)});
    EXPECT_EQ(mesh.nodes.total, 4);
    EXPECT_NEAR(mesh.area(), 1, 1e-14);
    EXPECT_NEAR(mesh.find_boundary("bottom")->length, 1, 1e-14);
    EXPECT_EQ(notes_with(mesh, "higher order"), 1);
  }
}
