#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "slipscale/base/parallel.hpp"
#include "whole.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

/// The whole mesh read by one rank alone has the same nodes under the same numbers, and so have the ghosts.
TEST(Numbering, DoesNotDependOnRanksOrPartitioner) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c), whole = whole_mesh_of(c);
    ASSERT_EQ(mesh.nodes.total, whole.nodes.total);
    ASSERT_EQ(mesh.cells.total, whole.cells.total);
    for (int i = 0; i < mesh.nodes.size(); ++i)
      EXPECT_EQ(mesh.nodes.position[i], whole.nodes.position[mesh.nodes.number[i]]);
    for (int cell = 0; cell < mesh.cells.size(); ++cell) {
      const int same = static_cast<int>(mesh.cells.number[cell]);
      ASSERT_EQ(mesh.cells.corner_count(cell), whole.cells.corner_count(same));
      EXPECT_EQ(mesh.cells.region[cell], whole.cells.region[same]);
      for (int k = 0; k < mesh.cells.corner_count(cell); ++k) {
        const int here = mesh.cells.first[cell] + k, there = whole.cells.first[same] + k;
        EXPECT_EQ(mesh.nodes.number[mesh.cells.corner_nodes[here]], whole.cells.corner_nodes[there]);
        EXPECT_EQ(mesh.cells.corners[here], whole.cells.corners[there]);
      }
    }
  }
}

/// Edges between two cells too: which of the two they belong to is a matter of the whole mesh.
TEST(Numbering, BoundaryEdgesDoNotDependOnRanksOrPartitioner) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c), whole = whole_mesh_of(c);
    for (std::size_t b = 0; b < whole.boundaries.size(); ++b) {
      std::map<std::pair<PetscInt, PetscInt>, const BoundaryEdge*> there;
      for (const BoundaryEdge& edge : whole.boundaries[b].edges)
        there[{edge.nodes[0], edge.nodes[1]}] = &edge;
      std::set<std::pair<PetscInt, PetscInt>> here;
      for (const BoundaryEdge& edge : mesh.boundaries[b].edges) {
        const std::pair ends(mesh.nodes.number[edge.nodes[0]], mesh.nodes.number[edge.nodes[1]]);
        here.insert(ends);
        ASSERT_TRUE(there.contains(ends));
        EXPECT_EQ(edge.ends, there[ends]->ends);
        EXPECT_EQ(edge.outward, there[ends]->outward);
      }
      const auto is_owned = [&](PetscInt number) {
        return std::binary_search(mesh.nodes.number.begin(), mesh.nodes.number.begin() + mesh.nodes.owned,
                                  number);
      };
      for (const auto& [ends, edge] : there)
        EXPECT_EQ(here.contains(ends), is_owned(ends.first) || is_owned(ends.second));
    }
  }
}

TEST(Numbering, EveryNodeAndCellHasOneOwner) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c);
    std::vector<PetscInt> owners(static_cast<std::size_t>(mesh.nodes.total + mesh.cells.total), 0);
    for (int i = 0; i < mesh.nodes.owned; ++i) ++owners[mesh.nodes.number[i]];
    for (int cell = 0; cell < mesh.cells.size(); ++cell)
      owners[mesh.nodes.total + mesh.cells.number[cell]] += mesh.cells.owned[cell];
    MPI_Allreduce(MPI_IN_PLACE, owners.data(), static_cast<int>(owners.size()), MPIU_INT, MPI_SUM,
                  PETSC_COMM_WORLD);
    EXPECT_EQ(std::set<PetscInt>(owners.begin(), owners.end()), std::set<PetscInt>{1});
  }
}

TEST(Numbering, LocalNodesAndCellsAscend) {
  const Mesh mesh = mesh_of({Shape::mixed, true, Partitioner::metis, 1});
  const auto& number = mesh.nodes.number;
  EXPECT_TRUE(std::is_sorted(number.begin(), number.begin() + mesh.nodes.owned));
  EXPECT_TRUE(std::is_sorted(number.begin() + mesh.nodes.owned, number.end()));
  EXPECT_TRUE(std::is_sorted(mesh.cells.number.begin(), mesh.cells.number.end()));
  EXPECT_EQ(std::set<PetscInt>(number.begin(), number.end()).size(), number.size());
}

/// Ghosts are filled from their owners: numbers sent through the halo arrive where they are known already.
TEST(Numbering, TheHaloBringsEachGhostItsOwner) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c);
    NodalVector x(PETSC_COMM_WORLD, mesh.nodes, true);
    for (int i = 0; i < mesh.nodes.owned; ++i)
      x.data()[i] = {1.0 * mesh.nodes.number[i], mesh.nodes.position[i][1]};
    x.begin_update();
    x.end_update();
    for (int i = mesh.nodes.owned; i < mesh.nodes.size(); ++i) {
      EXPECT_EQ(x.data()[i][0], mesh.nodes.number[i]);
      EXPECT_EQ(x.data()[i][1], mesh.nodes.position[i][1]);
    }
  }
}

/// One layer of overlap: an owned node has as many local cells around it as in the whole mesh.
TEST(Numbering, EveryCellAroundAnOwnedNodeIsLocal) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c), whole = whole_mesh_of(c);
    std::vector<int> here(mesh.nodes.number.size(), 0), there(whole.nodes.number.size(), 0);
    for (int node : mesh.cells.corner_nodes) ++here[node];
    for (int node : whole.cells.corner_nodes) ++there[node];
    for (int i = 0; i < mesh.nodes.owned; ++i) EXPECT_EQ(here[i], there[mesh.nodes.number[i]]);
  }
}

TEST(Partition, IsRepeatable) {
  const Case c{Shape::triangles, false, Partitioner::metis, 2};
  const Mesh once = mesh_of(c), again = mesh_of(c);
  EXPECT_EQ(once.nodes.number, again.nodes.number);
  EXPECT_EQ(once.cells.number, again.cells.number);
  EXPECT_EQ(once.partition.edge_cut, again.partition.edge_cut);
}

TEST(Partition, CountsTheEdgesItCuts) {
  const int rank = rank_of(PETSC_COMM_WORLD);
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c), whole = whole_mesh_of(c);
    std::vector<int> owner(static_cast<std::size_t>(mesh.cells.total), 0);
    for (int cell = 0; cell < mesh.cells.size(); ++cell)
      if (mesh.cells.owned[cell]) owner[mesh.cells.number[cell]] = rank;
    MPI_Allreduce(MPI_IN_PLACE, owner.data(), static_cast<int>(owner.size()), MPI_INT, MPI_SUM,
                  PETSC_COMM_WORLD);
    std::map<std::pair<int, int>, std::set<int>> owners;  // of the cells beside each edge
    for (int cell = 0; cell < whole.cells.size(); ++cell)
      for (int k = 0, n = whole.cells.corner_count(cell); k < n; ++k) {
        const int first = whole.cells.first[cell];
        owners[std::minmax(whole.cells.corner_nodes[first + k],
                           whole.cells.corner_nodes[first + (k + 1) % n])]
            .insert(owner[cell]);
      }
    EXPECT_EQ(mesh.partition.edge_cut,
              std::ranges::count_if(owners, [](const auto& edge) { return edge.second.size() == 2; }));
  }
}

TEST(Partition, ReportsWhatEachRankHolds) {
  const int rank = rank_of(PETSC_COMM_WORLD), ranks = ranks_of(PETSC_COMM_WORLD);
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c);
    const auto& report = mesh.partition;
    ASSERT_EQ(report.owned_nodes.size(), static_cast<std::size_t>(ranks));
    EXPECT_EQ(report.owned_nodes[rank], mesh.nodes.owned);
    EXPECT_EQ(report.ghost_nodes[rank], mesh.nodes.size() - mesh.nodes.owned);
    EXPECT_EQ(report.owned_cells[rank] + report.overlap_cells[rank], mesh.cells.size());
    if (ranks == 1) {
      EXPECT_EQ(report.edge_cut, 0);
    } else {
      EXPECT_GT(report.edge_cut, 0);
    }
    // No rank holds more than twice its share: 24 cells at least on at most three ranks.
    for (PetscInt cells : report.owned_cells) EXPECT_LE(cells * ranks, 2 * mesh.cells.total);
  }
}

/// Of a grid the nodes of a line come one after the other, and the lines too: along x, where there are fewer
/// of these, whatever the order of the file; after a refinement as well, and on a mesh that is periodic along
/// the lines.
TEST(Numbering, GoesAlongTheLinesOfAGrid) {
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed})
    for (const int refine : {0, 1})
      for (const bool periodic : {false, true}) {
        SCOPED_TRACE(testing::Message() << "shape " << static_cast<int>(shape) << ", refined " << refine
                                        << (periodic ? ", periodic" : ""));
        Block block;
        block.nx = 24;
        block.ny = 17;
        block.width = 1.1;
        block.height = 0.7;
        block.shape = shape;
        block.periodic_x = periodic;
        const std::string path = scratch("lines.msh");
        write_block(block, path);
        const Mesh mesh = read_mesh(PETSC_COMM_SELF, {path, Partitioner::metis, refine});
        const int across = block.nx * (1 + refine) + (periodic ? 0 : 1), lines = block.ny * (1 + refine) + 1;
        ASSERT_EQ(mesh.nodes.total, across * lines);
        const double spacing = block.width / (block.nx * (1 + refine));
        for (int i = 0; i < mesh.nodes.total; ++i) {
          const Vector2 &x = mesh.nodes.position[i], &first = mesh.nodes.position[i - i % across];
          EXPECT_NEAR(x[0], i % across * spacing, 1e-12);
          EXPECT_NEAR(x[1], first[1], 1e-12);
          if (i >= across) {
            EXPECT_NEAR(std::abs(x[1] - mesh.nodes.position[i - across][1]), block.height / (lines - 1),
                        1e-12);
          }
        }
      }
}

/// Where a block is higher than wide, the lines go up.
TEST(Numbering, TakesTheFewerLines) {
  Block block;
  block.nx = 17;
  block.ny = 60;
  block.shape = Shape::quadrilaterals;
  const std::string path = scratch("lines.msh");
  write_block(block, path);
  const Mesh mesh = read_mesh(PETSC_COMM_SELF, {path});
  for (int i = 0; i < mesh.nodes.total; ++i) EXPECT_NEAR(mesh.nodes.position[i][1], i % 61 / 60.0, 1e-12);
}
