// How a square block of squares is cut into parts: a line of CSV for each number of nodes, way and number of
// parts.
//   tests/bench/bench_parts -nodes 1000000 -parts 2,16,128 -ways metis,strips,rectangles > parts.csv
// metis and order are those of `slide` (-mesh_partitioner metis and simple); strips is what order comes to on
// such a grid, which is checked wherever order is asked for; rectangles is not built, but what could be.
// -each true: a line for each part. Under mpirun: such lines of what the ranks hold, by the first way, for
// comparison.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "cut_grid.hpp"
#include "scenes.hpp"
#include "slipscale/base/parallel.hpp"
#include "stages.hpp"

using namespace slipscale;
using namespace slipscale::bench;
using namespace slipscale::testing_support;

namespace {

/// The block as the reader of meshes leaves it, without its file: ten million cells are quicker so.
mesh_stages::Whole whole_grid(PetscInt across) {
  mesh_stages::Whole whole;
  const PetscInt row = across + 1;
  for (PetscInt j = 0; j < row; ++j)
    for (PetscInt i = 0; i < row; ++i)
      whole.plain.position.push_back({static_cast<double>(i) / across, static_cast<double>(j) / across});
  for (PetscInt j = 0; j < across; ++j)
    for (PetscInt i = 0; i < across; ++i) {
      const PetscInt a = j * row + i;
      whole.plain.cells.push_back({a, a + 1, a + row + 1, a + row});
    }
  whole.node_count = row * row;
  whole.cell_count = across * across;
  whole.around = mesh_stages::cells_around(whole.plain.cells, whole.node_count);
  return whole;
}

struct Ways {
  PetscInt across;
  mesh_stages::Whole whole = {};  ///< empty until it is needed
  std::vector<PetscInt> cut(const std::string& way, PetscInt parts) {
    if (way == "strips") return strips(across, parts);
    if (way == "rectangles") return rectangles(across, parts);
    if (way != "metis" && way != "order")
      throw UserError("-ways knows metis, order, strips and rectangles, not '" + way + "'");
    if (whole.plain.cells.empty()) whole = whole_grid(across);
    if (way == "metis")
      return mesh_stages::cell_parts(PETSC_COMM_SELF, Partitioner::metis, static_cast<int>(parts), whole);
    if (whole.cell_number.empty()) number_whole(whole);
    return mesh_stages::cell_parts(PETSC_COMM_SELF, Partitioner::simple, static_cast<int>(parts), whole);
  }
};

PetscInt64 most(const std::vector<Share>& all, PetscInt64 Share::*quantity) {
  return std::ranges::max(all, {}, quantity).*quantity;
}

void print_all(PetscInt nodes, const std::string& way, PetscInt parts, const std::vector<Share>& all,
               double seconds) {
  std::size_t senders = 0;
  PetscInt64 stretches = 0, ghosts = 0;
  for (const Share& share : all) {
    senders = std::max(senders, share.senders.size());
    stretches += share.stretches;
    ghosts += share.ghosts;
  }
  std::printf(
      "%d,%s,%d,%lld,%lld,%lld,%lld,%lld,%zu,%.1f,%.1f,%.1f\n", static_cast<int>(nodes), way.c_str(),
      static_cast<int>(parts), static_cast<long long>(most(all, &Share::owned)),
      static_cast<long long>(most(all, &Share::border)), static_cast<long long>(most(all, &Share::ghosts)),
      static_cast<long long>(most(all, &Share::needed)), static_cast<long long>(most(all, &Share::sent)),
      senders, static_cast<double>(ghosts) / static_cast<double>(parts),
      static_cast<double>(nodes) / static_cast<double>(stretches), seconds);
  std::fflush(stdout);
}

void measure(PetscInt wanted, const std::vector<std::string>& ways, const std::vector<PetscInt>& parts,
             bool each) {
  Ways cutter{static_cast<PetscInt>(std::lround(std::sqrt(static_cast<double>(wanted)))) - 1};
  const PetscInt nodes = (cutter.across + 1) * (cutter.across + 1);
  for (const std::string& way : ways)
    for (const PetscInt count : parts) {
      const auto begin = std::chrono::steady_clock::now();
      const std::vector<PetscInt> part = cutter.cut(way, count);
      const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;
      const std::vector<Share> all = shares(part, cutter.across, count);
      if (!each) print_all(nodes, way, count, all, duration.count());
      for (std::size_t k = 0; each && k < all.size(); ++k)
        std::printf("%zu,%lld,%lld\n", k, static_cast<long long>(all[k].owned),
                    static_cast<long long>(all[k].ghosts));
    }
}

/// What the ranks hold of the block that `slide` would read.
void print_ranks(PetscInt wanted, const std::string& way) {
  Block block;
  block.nx = block.ny = static_cast<int>(std::lround(std::sqrt(static_cast<double>(wanted)))) - 1;
  block.width = block.height = 5e-3;
  block.shape = Shape::quadrilaterals;
  const Mesh mesh = block_mesh(block, way == "metis" ? Partitioner::metis : Partitioner::simple);
  const PartitionReport& held = mesh.partition;
  if (rank_of(PETSC_COMM_WORLD) != 0) return;
  for (std::size_t k = 0; k < held.owned_nodes.size(); ++k)
    std::printf("%zu,%d,%d\n", k, static_cast<int>(held.owned_nodes[k]),
                static_cast<int>(held.ghost_nodes[k]));
}

void run() {
  PetscInt nodes = 1000000, parts[32] = {2}, count = 32;
  PetscBool given = PETSC_FALSE, each = PETSC_FALSE;
  char names[128] = "metis,strips,rectangles";
  petsc(PetscOptionsGetInt(nullptr, nullptr, "-nodes", &nodes, nullptr));
  petsc(PetscOptionsGetIntArray(nullptr, nullptr, "-parts", parts, &count, &given));
  petsc(PetscOptionsGetString(nullptr, nullptr, "-ways", names, sizeof(names), nullptr));
  petsc(PetscOptionsGetBool(nullptr, nullptr, "-each", &each, nullptr));
  std::vector<std::string> ways;
  std::istringstream words(names);
  for (std::string way; std::getline(words, way, ',');) ways.push_back(way);
  if (ranks_of(PETSC_COMM_WORLD) > 1) return print_ranks(nodes, ways.front());
  if (!each)
    std::printf("nodes,way,parts,owned,border,ghosts,needed,sent,senders,mean_ghosts,stretch,seconds\n");
  measure(nodes, ways, {parts, parts + (given ? count : 1)}, each);
}

}  // namespace

int main(int argc, char** argv) {
  petsc(PetscInitialize(&argc, &argv, nullptr, nullptr));
  run();
  petsc(PetscFinalize());
  return 0;
}
