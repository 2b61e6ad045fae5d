#include "slipscale/files/statistics_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
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

constexpr std::array<const char*, 6> tensors{"mean",    "deviation",    "lowest",
                                             "highest", "quantile_low", "quantile_high"};

/// Made of the cell's whole-mesh number, so that a row in a wrong place shows; standard deviations 2, 3 and 4
/// times `scale`.
FieldStatistics made_up(const Mesh& mesh, double scale) {
  FieldStatistics s;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    if (!mesh.cells.owned[cell]) continue;
    const double n = scale * static_cast<double>(mesh.cells.number[cell]);
    const auto add = [&](std::vector<double>& to, double offset) {
      to.insert(to.end(), {n + offset * scale, n + (offset + 1) * scale, n + (offset + 2) * scale});
    };
    add(s.mean, 0.1);
    add(s.lowest, -9.3);
    add(s.highest, 9.7);
    add(s.quantile_low, -5.1);
    add(s.quantile_high, 5.3);
    for (const double c : {4.0, 9.0, 16.0, -1.0, n, 0.5}) s.covariance.push_back(c * scale * scale);
  }
  return s;
}

Mesh mesh_of(MPI_Comm comm, const std::string& file) {
  MeshSource source;
  source.file = file;
  return read_mesh(comm, source);
}

void write(MPI_Comm comm, const std::string& folder, const std::string& mesh_file, bool tails = true) {
  const Mesh mesh = mesh_of(comm, mesh_file);
  write_statistics(comm, MeshImage(comm, mesh), {1e-4, 2e-4, 101, 0.95, tails}, made_up(mesh, 1),
                   made_up(mesh, 0.25), folder);
}

std::string folder_of(const testing_support::Block& block, bool tails = true) {
  const OutputFolder folder(PETSC_COMM_WORLD, scratch("statistics"));
  testing_support::write_block(block, folder.path("block.msh"));
  write(PETSC_COMM_WORLD, folder.path(), folder.path("block.msh"), tails);
  return folder.path();
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

template <class Number>
Number attribute(hid_t file, const char* name, hid_t type) {
  Number value{};
  const Hdf5Attribute found(hdf5(H5Aopen_by_name(file, "/statistics", name, H5P_DEFAULT, H5P_DEFAULT), name));
  hdf5(H5Aread(found, type, &value), name);
  return value;
}

}  // namespace

TEST(StatisticsFile, HoldsTheSameDataOnAnyNumberOfRanks) {
  for (const auto& [name, block] : analytic::cases()) {
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const OutputFolder alone(PETSC_COMM_SELF, folder + "/alone");
    write(PETSC_COMM_SELF, alone.path(), folder + "/block.msh");
    const auto expected = read_back::everything(alone.path("statistics.h5"));
    const auto found = read_back::everything(folder + "/statistics.h5");
    ASSERT_EQ(expected.size(), 4u + 2u * (7u + 6u * 3u)) << name;
    ASSERT_EQ(found.size(), expected.size()) << name;
    for (const auto& [path, dataset] : expected) {
      EXPECT_EQ(found.at(path).shape, dataset.shape) << name << ' ' << path;
      EXPECT_TRUE(read_back::same_bits(found.at(path).values, dataset.values)) << name << ' ' << path;
    }
    EXPECT_EQ(text_of(folder + "/statistics.xdmf"), text_of(alone.path("statistics.xdmf"))) << name;
  }
}

TEST(StatisticsFile, EachCellHasItsOwn) {
  for (const auto& [name, block] : analytic::cases()) {
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const auto all = read_back::everything(folder + "/statistics.h5");
    const std::size_t cells = all.at("mesh/region").shape[0];
    const double offsets[] = {0.1, 0, -9.3, 9.7, -5.1, 5.3};
    for (const auto& [quantity, scale, units] : {std::tuple("stress", 1.0, "Pa"), {"strain", 0.25, "1"}}) {
      const std::string group = std::string("statistics/") + quantity + "/";
      for (std::size_t t = 0; t < tensors.size(); ++t) {
        const auto& found = all.at(group + tensors[t]);
        ASSERT_EQ(found.shape, (std::vector<hsize_t>{cells, 3})) << group << tensors[t];
        EXPECT_EQ(found.units, units);
        for (std::size_t cell = 0; cell < cells; ++cell)
          for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(found.values[3 * cell + i], t == 1 ? scale * static_cast<double>(2 + i)
                                                         : scale * static_cast<double>(cell) +
                                                               (offsets[t] + static_cast<double>(i)) * scale)
                << group << tensors[t];
      }
      const auto& covariance = all.at(group + "covariance");
      ASSERT_EQ(covariance.shape, (std::vector<hsize_t>{cells, 6}));
      EXPECT_EQ(covariance.units, units == std::string("Pa") ? "Pa2" : "1");
      EXPECT_EQ(covariance.values[6 * 4 + 3], -scale * scale);
    }
  }
}

TEST(StatisticsFile, TellsItsSample) {
  const std::string folder = folder_of(analytic::cases()[0].block);
  if (!is_root(PETSC_COMM_WORLD)) return;
  const Hdf5File file = read_back::open(folder + "/statistics.h5");
  EXPECT_EQ(attribute<double>(file, "from", H5T_NATIVE_DOUBLE), 1e-4);
  EXPECT_EQ(attribute<double>(file, "to", H5T_NATIVE_DOUBLE), 2e-4);
  EXPECT_EQ(attribute<double>(file, "quantile", H5T_NATIVE_DOUBLE), 0.95);
  EXPECT_EQ(attribute<std::int64_t>(file, "samples", H5T_NATIVE_INT64), 101);
}

TEST(StatisticsFile, LeavesOutTailsThatAreNotKnown) {
  const std::string folder = folder_of(analytic::cases()[0].block, false);
  if (!is_root(PETSC_COMM_WORLD)) return;
  const auto all = read_back::everything(folder + "/statistics.h5");
  EXPECT_EQ(all.size(), 4u + 2u * (3u + 2u * 3u));
  EXPECT_EQ(all.count("statistics/stress/highest"), 0u);
  EXPECT_EQ(text_of(folder + "/statistics.xdmf").find("quantile"), std::string::npos);
}

/// What statistics.xdmf says of a dataset is what statistics.h5 holds.
TEST(StatisticsFile, XdmfNamesDatasetsInTheirShape) {
  const std::regex item("Dimensions=\"([0-9 ]+)\"[^>]*>statistics.h5:([^<]+)<");
  for (const auto& [name, block] : analytic::cases()) {
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const Hdf5File file = read_back::open(folder + "/statistics.h5");
    const std::string text = text_of(folder + "/statistics.xdmf");
    int count = 0;
    for (std::sregex_iterator found(text.begin(), text.end(), item), end; found != end; ++found, ++count) {
      std::istringstream dimensions((*found)[1]);
      const std::vector<hsize_t> shape{std::istream_iterator<hsize_t>(dimensions), {}};
      EXPECT_EQ(read_back::dataset(file, (*found)[2]).shape, shape) << name << ' ' << (*found)[2];
    }
    EXPECT_EQ(count, 2 + 1 + 2 * 6 * 3) << name;
  }
}

TEST(StatisticsFile, AFullDiskStopsAllRanksAndKeepsTheOldFile) {
  for (const bool everywhere : {true, false}) {
    const std::string folder = folder_of(analytic::cases()[0].block);
    testing_support::Block large;
    large.nx = large.ny = 40;
    testing_support::write_block(large, folder + "/large.msh");
    std::string failure;
    {
      const read_back::SmallDisk disk(everywhere || is_root(PETSC_COMM_WORLD) ? 300000 : 100000000);
      try {
        write(PETSC_COMM_WORLD, folder, folder + "/large.msh");
      } catch (const RunError& error) {
        failure = error.what();
      }
    }
    EXPECT_NE(failure.find("statistics.h5 cannot be written: File too large; "), std::string::npos)
        << failure;
    MPI_Barrier(PETSC_COMM_WORLD);
    EXPECT_FALSE(std::filesystem::exists(folder + "/statistics.h5.partial"));
    if (!is_root(PETSC_COMM_WORLD)) continue;
    EXPECT_EQ(read_back::everything(folder + "/statistics.h5").at("mesh/region").shape[0], 90u);
  }
}

TEST(StatisticsFile, IsNearItsPredictedSize) {
  testing_support::Block block;
  block.nx = block.ny = 30;
  const std::string folder = folder_of(block);
  if (!is_root(PETSC_COMM_WORLD)) return;
  const auto size = static_cast<double>(std::filesystem::file_size(folder + "/statistics.h5"));
  EXPECT_NEAR(statistics_bytes(31 * 31, 2 * 30 * 30) / size, 1.0, 0.1);
}
