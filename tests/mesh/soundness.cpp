#include <sstream>

#include "msh_text.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

struct Corner {
  double x, y, z = 0;
};
using Cell = std::vector<int>;  ///< its nodes, counted from 1

/// A mesh of one region from its nodes and cells.
MshText mesh_of(const std::vector<Corner>& nodes, const std::vector<Cell>& cells) {
  MshText file;
  file.names = "1\n2 1 \"matrix\"\n";
  file.entities = "0 0 1 0\n1 0 0 0 1 1 0 1 1 0\n";
  std::ostringstream text;
  text << "1 " << nodes.size() << " 1 " << nodes.size() << "\n2 1 0 " << nodes.size() << '\n';
  for (std::size_t k = 1; k <= nodes.size(); ++k) text << k << '\n';
  for (const Corner& x : nodes) text << x.x << ' ' << x.y << ' ' << x.z << '\n';
  file.nodes = text.str();
  text.str("");
  text << cells.size() << ' ' << cells.size() << " 1 " << cells.size() << '\n';
  for (std::size_t k = 0; k < cells.size(); ++k) {
    text << "2 1 " << cells[k].size() - 1 << " 1\n" << k + 1;
    for (const int node : cells[k]) text << ' ' << node;
    text << '\n';
  }
  file.elements = text.str();
  return file;
}

std::string text_of(const Block& block) {
  const std::string path = scratch("block.msh");
  write_block(block, path);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

Block strip() {
  Block block;
  block.nx = 6;
  block.ny = 4;
  block.periodic_x = true;
  return block;
}

/// The file of a strip, whose pairs of the right side (of which there are 5) `change` spoils.
template <class Change>
std::string strip_with(Change change) {
  std::vector<std::string> lines = lines_of(text_of(strip()));
  const auto link = std::ranges::find(lines, "1 2 4");
  change(lines, link + 2);
  return joined(lines);
}

}  // namespace

TEST(Soundness, NodesThatCoincideButAreNotOne) {
  const MshText file =
      mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}, {1, 1}, {1, 2}, {0, 2}}, {{1, 2, 3, 4}, {5, 6, 7, 8}});
  expect(complaint(file), "coincide but are not one", "Coherence");
  // At one end they are one: a crack, whose sides would go through one another.
  expect(complaint(
             mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 1}, {1, 2}, {0, 2}}, {{1, 2, 3, 4}, {4, 5, 6, 7}})),
         "two nodes at (1, 1) m coincide", "common points and lines");
}

TEST(Soundness, NodeOnAnEdgeThatItIsNoEndOf) {
  expect(complaint(mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {.5, 1}, {.5, 2}, {0, 2}, {1, 2}},
                           {{1, 2, 3, 4}, {4, 5, 6, 7}, {5, 3, 8, 6}})),
         "the node at (0.5, 1) m lies on the edge", "common points and lines");
}

TEST(Soundness, Overlap) {
  expect(complaint(mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {.5, .5}, {2, .6}, {2, 2.5}},
                           {{1, 2, 3, 4}, {5, 6, 7}})),
         "bodies overlap", "BooleanFragments");
  // A corner of the one lies on a side of the other, besides.
  expect(complaint(
             mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {.5, .5}, {2, .6}, {2, 2}}, {{1, 2, 3, 4}, {5, 6, 7}})),
         "bodies overlap", "BooleanFragments");
  expect(complaint(mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{1, 2, 3}, {1, 2, 4}})),
         "two cells lie on the same side of their common edge", "mesh the surface again");
}

/// Bodies that hang together nowhere else would float when they are moved apart: that is no cure.
TEST(Soundness, TheCureCures) {
  const std::vector<Corner> below{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const std::vector<Corner>& above : {std::vector<Corner>{{0, 1}, {1, 1}, {1, 2}, {0, 2}},
                                           {{.25, 1}, {.75, 1}, {.75, 2}, {.25, 2}},
                                           {{.25, .5}, {.75, .5}, {.75, 2}, {.25, 2}}}) {
    std::vector<Corner> nodes = below;
    nodes.insert(nodes.end(), above.begin(), above.end());
    const std::string said = complaint(mesh_of(nodes, {{1, 2, 3, 4}, {5, 6, 7, 8}}));
    EXPECT_NE(said.find("BooleanFragments"), std::string::npos) << said;
    EXPECT_EQ(said.find("gap"), std::string::npos) << said;
    EXPECT_EQ(said.find("apart"), std::string::npos) << said;
  }
  expect(complaint(
             mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 1}, {1, 2}, {0, 2}}, {{1, 2, 3, 4}, {4, 5, 6, 7}})),
         "two nodes at (1, 1) m coincide", "or leave a gap");
}

/// A gap of a thousandth of an edge is a gap.
TEST(Soundness, PartsThatShareNoNode) {
  for (const double gap : {1e-3, 1.0})
    expect(complaint(mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1 + gap}, {1, 1 + gap}, {1, 3}, {0, 3}},
                             {{1, 2, 3, 4}, {5, 6, 7, 8}})),
           "falls into 2 parts that share no node", "keep one part");
}

/// An opening is no fault, nor are bodies that hang together at a node alone.
TEST(Soundness, WhatIsSound) {
  std::vector<Corner> nodes;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) nodes.push_back({1.0 * i, 1.0 * j});
  std::vector<Cell> ring;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      if (i != 1 || j != 1) ring.push_back({4 * j + i + 1, 4 * j + i + 2, 4 * j + i + 6, 4 * j + i + 5});
  EXPECT_EQ(complaint(mesh_of(nodes, ring)), "");
  EXPECT_EQ(complaint(mesh_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 1}, {2, 2}, {1, 2}},
                              {{1, 2, 3, 4}, {3, 5, 6, 7}})),
            "");
}

TEST(Soundness, ThirdCoordinate) {
  const std::vector<Cell> cell{{1, 2, 3, 4}};
  EXPECT_EQ(complaint(mesh_of({{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}}, cell)), "");
  expect(complaint(mesh_of({{0, 0, 0}, {1, 0, .5}, {1, 1, .5}, {0, 1, 0}}, cell)),
         "third coordinate varies from 0 to 0.5 m", "turn the geometry");
}

TEST(Soundness, PeriodicSidesThatDoNotMatch) {
  EXPECT_EQ(complaint(written(text_of(strip()))), "");
  const std::string moved = replaced(text_of(strip()), "\n1 0.5 0\n", "\n1 0.51 0\n");
  expect(complaint(written(moved)), "pairs sides that do not match: the node of curve 2 at (1, 0.51) m",
         "Periodic Curve");
  EXPECT_EQ(complaint(written(moved), true), "");  // opened, its sides need not match
}

/// Missing pairs leave a slit in the seam.
TEST(Soundness, PeriodicSidesPairedInPart) {
  const std::string slit = strip_with([](auto& lines, auto pairs) {
    *pairs = "4";
    lines.erase(pairs + 3);
  });
  expect(complaint(written(slit)), "two sides meet across a period that are not paired", "Periodic Curve");
  EXPECT_EQ(complaint(written(slit), true), "");
}

TEST(Soundness, PeriodicSidesThatAreMirrored) {
  const std::string mirrored = strip_with([](auto&, auto pairs) {
    for (int k = 1; k <= 5; ++k) pairs[k] = std::to_string(7 * k) + ' ' + std::to_string(7 * (5 - k) + 1);
  });
  expect(complaint(written(mirrored)), "pairs sides that do not match", "Periodic Curve");
}

TEST(Soundness, PeriodicByRotation) {
  const std::string turned = strip_with([](auto&, auto pairs) {
    *(pairs - 1) = "16 -1 0 0 1 0 -1 0 1 0 0 1 0 0 0 0 1";
    for (int k = 1; k <= 5; ++k) pairs[k] = std::to_string(7 * k) + ' ' + std::to_string(7 * (5 - k) + 1);
  });
  expect(complaint(written(turned)), "pairs curve 2 with curve 4 by a rotation", "shifts of one another");
}

/// Pairs of lines within the body would make one of what are many places.
TEST(Soundness, PeriodicLinesWithinTheBody) {
  const std::string inner = strip_with([](auto&, auto pairs) {
    for (int k = 1; k <= 5; ++k) pairs[k] = std::to_string(7 * k - 2) + ' ' + std::to_string(7 * k - 4);
    *(pairs - 1) = "0";
  });
  EXPECT_NE(complaint(written(inner)), "");
}
