#include <gtest/gtest.h>

#include <set>

#include "analytic_fields.hpp"
#include "read_back.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/record/fields_file.hpp"

using namespace slipscale;
using testing_support::scratch;

namespace {

using Everything = std::map<std::string, read_back::Dataset>;

// Some of the 9 x 5 cells of the cases' blocks of 1 x 0.5 m, and on a torus both sides of its seam.
const Box part{{0.45, 0.08}, {1.2, 0.42}}, all_of_it{{-1, -1}, {2, 2}};
const FieldQuantities quantities{.u = true, .v = true, .stress = true, .strain = true};

Everything written(MPI_Comm comm, const std::string& mesh_file, const std::optional<Box>& box) {
  MeshSource source;
  source.file = mesh_file;
  const Mesh mesh = read_mesh(comm, source);
  const OutputFolder folder(comm, mesh_file + (comm == PETSC_COMM_SELF ? ".alone" : ".out"));
  FieldsFile file(comm, MeshImage(comm, mesh, box), folder.path(), quantities);
  const auto f = analytic::fields(mesh, 1e-3);
  auto strain = f.stress;
  for (double& e : strain) e *= 1e-9;
  file.write(1e-3, f.u.data(), f.v.data(), f.stress.data(), strain.data());
  file.close();
  return is_root(comm) ? read_back::everything(folder.path("fields.h5")) : Everything{};
}

/// Points of each cell, whatever the cells are.
std::vector<std::vector<std::size_t>> cells_of(const Everything& all) {
  const auto& set = all.at("mesh/cells");
  std::vector<std::vector<std::size_t>> cells;
  for (std::size_t k = 0; k < set.values.size();) {
    const std::size_t corners =
        set.shape.size() == 2 ? set.shape[1] : static_cast<std::size_t>(set.values[k++]) - 1;
    cells.emplace_back();
    for (std::size_t c = 0; c < corners; ++c)
      cells.back().push_back(static_cast<std::size_t>(set.values[k++]));
  }
  return cells;
}

std::vector<double> row(const Everything& all, const std::string& path, std::size_t k) {
  const auto& set = all.at(path);
  const std::size_t width = set.values.size() / set.shape[0];
  return {set.values.begin() + static_cast<std::ptrdiff_t>(width * k),
          set.values.begin() + static_cast<std::ptrdiff_t>(width * (k + 1))};
}

void expect_same(const Everything& found, const Everything& expected, const std::string& name) {
  ASSERT_EQ(found.size(), expected.size()) << name;
  for (const auto& [path, dataset] : expected) {
    EXPECT_EQ(found.at(path).shape, dataset.shape) << name << ' ' << path;
    EXPECT_TRUE(read_back::same_bits(found.at(path).values, dataset.values)) << name << ' ' << path;
  }
}

std::string mesh_file(const analytic::Case& each) {
  const std::string path = scratch("block.msh");
  testing_support::write_block(each.block, path);
  return path;
}

}  // namespace

/// The cells in the box are those of the whole file in the same order, with the same corners and fields.
TEST(FieldsBox, HoldsItsPartOfTheWhole) {
  for (const auto& each : analytic::cases()) {
    const std::string path = mesh_file(each);
    const Everything whole = written(PETSC_COMM_WORLD, path, std::nullopt);
    const Everything found = written(PETSC_COMM_WORLD, path, part);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const auto cells = cells_of(found), all = cells_of(whole);
    std::set<std::size_t> used;
    std::size_t next = 0;
    for (std::size_t cell = 0; cell < all.size(); ++cell) {
      const auto centre = row(whole, "frames/00000/stress", cell);  // analytic: x, y
      if (!(centre[0] >= 0.45 && centre[1] >= 0.08 && centre[1] <= 0.42)) continue;
      ASSERT_LT(next, cells.size()) << each.name;
      for (const char* field : {"frames/00000/stress", "frames/00000/strain", "mesh/region"})
        EXPECT_EQ(row(found, field, next), row(whole, field, cell)) << each.name << ' ' << field;
      ASSERT_EQ(cells[next].size(), all[cell].size()) << each.name;
      for (std::size_t c = 0; c < all[cell].size(); ++c)
        for (const char* field : {"mesh/coordinates", "frames/00000/u", "frames/00000/v"})
          EXPECT_EQ(row(found, field, cells[next][c]), row(whole, field, all[cell][c]))
              << each.name << ' ' << field;
      used.insert(cells[next].begin(), cells[next].end());
      ++next;
    }
    EXPECT_EQ(next, cells.size()) << each.name;
    EXPECT_GT(next, 10u);
    EXPECT_LT(next, all.size());
    EXPECT_EQ(used.size(), found.at("mesh/coordinates").shape[0]) << each.name << ": points without a cell";
  }
}

TEST(FieldsBox, HoldsTheSameDataOnAnyNumberOfRanks) {
  for (const auto& each : analytic::cases()) {
    const std::string path = mesh_file(each);
    const Everything found = written(PETSC_COMM_WORLD, path, part);
    if (is_root(PETSC_COMM_WORLD)) expect_same(found, written(PETSC_COMM_SELF, path, part), each.name);
  }
}

TEST(FieldsBox, AroundTheBodyChangesNothing) {
  for (const auto& each : analytic::cases()) {
    const std::string path = mesh_file(each);
    const Everything whole = written(PETSC_COMM_WORLD, path, std::nullopt);
    const Everything found = written(PETSC_COMM_WORLD, path, all_of_it);
    if (is_root(PETSC_COMM_WORLD)) expect_same(found, whole, each.name);
  }
}

/// A mixed mesh whose part is of one kind is written as such.
TEST(FieldsBox, KnowsTheCellsThatItHolds) {
  const std::string path = mesh_file(analytic::cases()[2]);
  const Everything whole = written(PETSC_COMM_WORLD, path, std::nullopt);
  std::set<std::size_t> kinds;
  for (int k = 0; k < 9; ++k) {
    const double x = (k + 0.5) / 9;
    const Everything column = written(PETSC_COMM_WORLD, path, Box{{x - 0.5 / 9, 0.1}, {x + 0.5 / 9, 0.2}});
    if (is_root(PETSC_COMM_WORLD)) kinds.insert(column.at("mesh/cells").shape.size());
  }
  if (is_root(PETSC_COMM_WORLD)) {
    EXPECT_EQ(whole.at("mesh/cells").shape.size(), 1u);  // a stream
    EXPECT_TRUE(kinds.contains(2));
  }
}

/// What a file tells of a mesh is enough to write it again, cells shared out in any way.
TEST(MeshImage, OfAGridIsTheMeshItCameFrom) {
  const int rank = rank_of(PETSC_COMM_WORLD), ranks = ranks_of(PETSC_COMM_WORLD);
  for (const auto& each : analytic::cases()) {
    // Each rank by itself, as a grid is held whole by all.
    const Everything whole = [&] {
      const std::string path = mesh_file(each);
      MeshSource source;
      source.file = path;
      const Mesh mesh = read_mesh(PETSC_COMM_SELF, source);
      const std::string folder = scratch("grid") + std::to_string(rank);
      const OutputFolder output(PETSC_COMM_SELF, folder);
      FieldsFile(PETSC_COMM_SELF, mesh, folder, quantities).close();
      return read_back::everything(output.path("fields.h5"));
    }();
    PlaneGrid grid;
    for (std::size_t k = 0; k < whole.at("mesh/coordinates").shape[0]; ++k) {
      const auto x = row(whole, "mesh/coordinates", k);
      grid.points.push_back({x[0], x[1]});
    }
    for (const auto& cell : cells_of(whole)) {
      grid.corners.insert(grid.corners.end(), cell.begin(), cell.end());
      grid.first.push_back(static_cast<int>(grid.corners.size()));
    }
    for (const double region : whole.at("mesh/region").values)
      grid.region.push_back(static_cast<int>(region));
    grid.regions = {"matrix", "inclusion"};
    const auto cells = static_cast<std::size_t>(grid.cells());
    // Shares that fit neither each other nor the file's slices; the last takes what is left.
    const std::size_t begin = cells * rank / (2 * ranks),
                      end = rank + 1 == ranks ? cells : cells * (rank + 1) / (2 * ranks);
    const OutputFolder output(PETSC_COMM_WORLD, scratch("again"));
    FieldsFile file(PETSC_COMM_WORLD, MeshImage(PETSC_COMM_WORLD, grid, begin, end), output.path(),
                    {.u = false, .v = false, .stress = true, .strain = false}, "relocalized");
    std::vector<double> number;
    for (std::size_t cell = begin; cell < end; ++cell)
      number.insert(number.end(), {1.0 * static_cast<double>(cell), 2, 3});
    file.write(0.25, nullptr, nullptr, number.data());
    file.close();
    if (rank != 0) continue;
    const Everything found = read_back::everything(output.path("relocalized.h5"));
    for (const char* path : {"mesh/coordinates", "mesh/cells", "mesh/region"})
      EXPECT_EQ(found.at(path).values, whole.at(path).values) << each.name << ' ' << path;
    for (std::size_t cell = 0; cell < cells; ++cell)
      EXPECT_EQ(row(found, "frames/00000/stress", cell),
                (std::vector<double>{1.0 * static_cast<double>(cell), 2, 3}));
  }
}
