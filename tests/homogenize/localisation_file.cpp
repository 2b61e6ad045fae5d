#include "slipscale/homogenize/localisation_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <regex>
#include <sstream>

#include "analytic_fields.hpp"
#include "read_back.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/mesh/read.hpp"

using namespace slipscale;
using testing_support::scratch;

namespace {

Mesh mesh_of(MPI_Comm comm, const std::string& file) {
  MeshSource source;
  source.file = file;
  return read_mesh(comm, source);
}

/// Blocks and tori of triangles, quadrilaterals and both, and one that is periodic both ways.
std::vector<analytic::Case> cases() {
  auto all = analytic::cases();
  all.push_back({"torus both ways", all.back().block});
  all.back().block.periodic_y = true;
  return all;
}

/// Entry (i, k) of a made-up localisation tensor of the cell of this whole-mesh number.
double entry(PetscInt cell, int i, int k) {
  return (i == k) + 0.01 * static_cast<double>(cell) + 0.1 * i - 0.3 * k;
}

/// A stiffness of its own for each region, by its name and not its place in the list.
std::vector<Material> materials(const Mesh& mesh) {
  std::vector<Material> all;
  for (const Region& region : mesh.regions) {
    Eigen::Matrix3d c;
    c << 90, 20, 5, 20, 40, -3, 5, -3, 15;
    if (region.name == "inclusion") c = 2 * c + Eigen::Matrix3d::Identity();
    all.push_back({c, 1000, region.name});
  }
  return all;
}

CellSolution solution(const Mesh& mesh) {
  CellSolution made;
  made.stiffness << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  for (const PetscInt number : mesh.cells.number) {
    Eigen::Matrix3d a;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) a(i, k) = entry(number, i, k);
    made.localisation.push_back(a);
  }
  return made;
}

void write(MPI_Comm comm, const std::string& folder, const std::string& mesh_file) {
  const Mesh mesh = mesh_of(comm, mesh_file);
  write_localisation(comm, mesh, materials(mesh), solution(mesh), folder);
}

/// A folder with the files of a block, written by all ranks together.
std::string folder_of(const testing_support::Block& block) {
  const OutputFolder folder(PETSC_COMM_WORLD, scratch("localisation"));
  testing_support::write_block(block, folder.path("block.msh"));
  write(PETSC_COMM_WORLD, folder.path(), folder.path("block.msh"));
  return folder.path();
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Names of the regions in the order of /mesh/region.
std::vector<std::string> region_names(const std::string& folder) {
  const Hdf5File file = read_back::open(folder + "/localization.h5");
  const Hdf5Dataset region(H5Dopen2(file, "/mesh/region", H5P_DEFAULT));
  std::istringstream list(read_back::attribute(region, "names"));
  std::vector<std::string> names;
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

}  // namespace

TEST(LocalisationFile, HoldsTheSameDataOnAnyNumberOfRanks) {
  for (const auto& [name, block] : cases()) {
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const OutputFolder alone(PETSC_COMM_SELF, folder + "/alone");
    write(PETSC_COMM_SELF, alone.path(), folder + "/block.msh");
    const auto expected = read_back::everything(alone.path("localization.h5"));
    const auto found = read_back::everything(folder + "/localization.h5");
    // coordinates, cells, region (of two paths); area, localisation, three stresses; two stiffnesses;
    // views of the tensors' components
    ASSERT_EQ(expected.size(), 4u + 5u + 2u + 9u + 9u) << name;
    ASSERT_EQ(found.size(), expected.size()) << name;
    for (const auto& [path, dataset] : expected) {
      EXPECT_EQ(found.at(path).shape, dataset.shape) << name << ' ' << path;
      EXPECT_TRUE(read_back::same_bits(found.at(path).values, dataset.values)) << name << ' ' << path;
    }
    EXPECT_EQ(text_of(folder + "/localization.xdmf"), text_of(alone.path("localization.xdmf"))) << name;
  }
}

TEST(LocalisationFile, EachCellHasItsTensorAndItsStress) {
  for (const auto& [name, block] : cases()) {
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const auto all = read_back::everything(folder + "/localization.h5");
    const Hdf5File file = read_back::open(folder + "/localization.h5");
    const auto region = read_back::dataset(file, "/cell/region").values;
    const auto& a = all.at("cell/localisation");
    const auto& c = all.at("region/stiffness");
    ASSERT_EQ(a.shape, (std::vector<hsize_t>{region.size(), 3, 3})) << name;
    ASSERT_EQ(c.shape, (std::vector<hsize_t>{2, 3, 3})) << name;
    EXPECT_EQ(a.units, "1");
    EXPECT_EQ(c.units, "Pa");
    const char* stresses[] = {"cell/stress_xx", "cell/stress_yy", "cell/stress_xy"};
    for (std::size_t cell = 0; cell < region.size(); ++cell)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& stress = all.at(stresses[k]);
        for (std::size_t i = 0; i < 3; ++i) {
          const int row = static_cast<int>(i), column = static_cast<int>(k);
          EXPECT_EQ(a.values[9 * cell + 3 * i + k], entry(static_cast<PetscInt>(cell), row, column)) << name;
          double expected = 0;
          for (std::size_t j = 0; j < 3; ++j)
            expected += c.values[9 * static_cast<std::size_t>(region[cell]) + 3 * i + j] *
                        a.values[9 * cell + 3 * j + k];
          EXPECT_NEAR(stress.values[3 * cell + i], expected, 1e-13 * (1 + std::abs(expected))) << name;
        }
      }
  }
}

TEST(LocalisationFile, RegionsKeepTheirStiffness) {
  const std::string folder = folder_of(cases()[0].block);
  if (!is_root(PETSC_COMM_WORLD)) return;
  const auto all = read_back::everything(folder + "/localization.h5");
  const auto names = region_names(folder);
  ASSERT_EQ(names.size(), 2u);
  for (std::size_t r = 0; r < 2; ++r)
    EXPECT_EQ(all.at("region/stiffness").values[9 * r], names[r] == "inclusion" ? 181 : 90) << names[r];
  EXPECT_EQ(all.at("effective/stiffness").values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  const Hdf5File file = read_back::open(folder + "/localization.h5");
  const Hdf5Dataset effective(H5Dopen2(file, "/effective/stiffness", H5P_DEFAULT));
  EXPECT_EQ(read_back::attribute(effective, "boundary"), "periodic");
}

/// Cells of the blocks are 1/9 by 0.1 m, or half of that, before their corners are moved.
TEST(LocalisationFile, AreasAreThoseOfTheDrawnCells) {
  for (const auto& [name, block] : cases()) {
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const auto all = read_back::everything(folder + "/localization.h5");
    const auto& area = all.at("cell/area").values;
    EXPECT_NEAR(std::accumulate(area.begin(), area.end(), 0.0), 0.5, 1e-14) << name;
    if (block.shape != testing_support::Shape::triangles) continue;
    const auto& cells = all.at("mesh/cells").values;
    const auto& x = all.at("mesh/coordinates").values;
    for (std::size_t cell = 0; cell < area.size(); ++cell) {
      const auto at = [&](std::size_t k, std::size_t d) {
        return x[2 * static_cast<std::size_t>(cells[3 * cell + k]) + d];
      };
      EXPECT_NEAR(area[cell],
                  0.5 * ((at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) -
                         (at(2, 0) - at(0, 0)) * (at(1, 1) - at(0, 1))),
                  1e-15)
          << name;
    }
  }
}

/// What localization.xdmf says of a dataset is what localization.h5 holds.
TEST(LocalisationFile, XdmfNamesDatasetsInTheirShape) {
  const std::regex item(
      "Dimensions=\"([0-9 ]+)\" NumberType=\"(\\w+)\" Precision=\"(\\d)\" "
      "Format=\"HDF\">localization.h5:([^<]+)<");
  for (const auto& [name, block] : cases()) {
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const Hdf5File file = read_back::open(folder + "/localization.h5");
    const std::string text = text_of(folder + "/localization.xdmf");
    int count = 0;
    for (std::sregex_iterator found(text.begin(), text.end(), item), end; found != end; ++found, ++count) {
      std::istringstream dimensions((*found)[1]);
      const std::vector<hsize_t> shape{std::istream_iterator<hsize_t>(dimensions), {}};
      EXPECT_EQ(read_back::dataset(file, (*found)[4]).shape, shape) << name << ' ' << (*found)[4];
    }
    EXPECT_EQ(count, 2 + 1 + 1 + 9 + 9) << name;
  }
}

TEST(LocalisationFile, AFullDiskStopsAllRanksAndKeepsTheOldFiles) {
  for (const bool everywhere : {true, false}) {
    const std::string folder = folder_of(cases()[0].block);
    const auto before =
        is_root(PETSC_COMM_WORLD) ? read_back::everything(folder + "/localization.h5").size() : 0;
    testing_support::Block large;
    large.nx = large.ny = 60;
    testing_support::write_block(large, folder + "/large.msh");
    const Mesh mesh = mesh_of(PETSC_COMM_WORLD, folder + "/large.msh");
    std::string failure;
    {
      const read_back::SmallDisk disk(everywhere || is_root(PETSC_COMM_WORLD) ? 300000 : 100000000);
      try {
        write_localisation(PETSC_COMM_WORLD, mesh, materials(mesh), solution(mesh), folder);
      } catch (const RunError& error) {
        failure = error.what();
      }
    }
    EXPECT_NE(failure.find("localization.h5 cannot be written: File too large; "), std::string::npos)
        << failure;
    MPI_Barrier(PETSC_COMM_WORLD);
    EXPECT_FALSE(std::filesystem::exists(folder + "/localization.h5.partial"));
    if (!is_root(PETSC_COMM_WORLD)) continue;
    EXPECT_EQ(read_back::everything(folder + "/localization.h5").size(), before);
  }
}

TEST(LocalisationFile, LeavesNothingHalfWritten) {
  const std::string folder = folder_of(cases()[0].block);
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_TRUE(std::filesystem::exists(folder + "/localization.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/localization.h5.partial"));
}

TEST(LocalisationFile, AFolderThatIsGoneStopsTheRun) {
  const std::string folder = folder_of(cases()[0].block);
  const Mesh mesh = mesh_of(PETSC_COMM_WORLD, folder + "/block.msh");
  EXPECT_THROW(write_localisation(PETSC_COMM_WORLD, mesh, materials(mesh), solution(mesh), folder + "/none"),
               RunError);
}
