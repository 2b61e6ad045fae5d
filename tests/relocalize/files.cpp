#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "grids.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/files/hdf5.hpp"
#include "slipscale/relocalize/fields_reader.hpp"
#include "slipscale/relocalize/localisation_reader.hpp"
#include "slipscale/relocalize/relocalisation.hpp"
#include "slipscale/relocalize/statistics_reader.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// A file as others write it, made by rank 0.
class MadeFile {
 public:
  explicit MadeFile(const std::string& path)
      : file_(hdf5(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), path)) {}

  template <class Number>
  Hdf5Dataset write(const std::string& path, const std::vector<hsize_t>& shape,
                    const std::vector<Number>& values) {
    const hid_t type = std::is_same_v<Number, int> ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
    Hdf5Dataset set = create_dataset(file_, path, type, shape);
    hdf5(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path);
    return set;
  }

  void write_mesh(const PlaneGrid& grid) {
    std::vector<double> x;
    for (const Vector2& point : grid.points) x.insert(x.end(), point.begin(), point.end());
    write("/mesh/coordinates", {grid.points.size(), 2}, x);
    write_cells(grid);
    const auto set = write("/mesh/region", {grid.region.size()}, grid.region);
    write_attribute(set, "names", grid.regions);
  }

  void write_number(const std::string& group, const char* name, double value) {
    const Hdf5Space scalar(H5Screate(H5S_SCALAR));
    const Hdf5Attribute attribute(hdf5(H5Acreate_by_name(file_, group.c_str(), name, H5T_NATIVE_DOUBLE,
                                                         scalar, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                                       name));
    hdf5(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), name);
  }

 private:
  void write_cells(const PlaneGrid& grid) {
    const hsize_t cells = grid.region.size();
    const std::size_t corners = grid.corners.size();
    if (corners == 3 * cells || corners == 4 * cells) {
      write("/mesh/cells", {cells, corners / cells}, grid.corners);
      return;
    }
    std::vector<int> stream;
    for (int cell = 0; cell < grid.cells(); ++cell) {
      stream.push_back(grid.corner_count(cell) == 3 ? 4 : 5);
      stream.insert(stream.end(), grid.corners.begin() + grid.first[cell],
                    grid.corners.begin() + grid.first[cell + 1]);
    }
    write("/mesh/cells", {stream.size()}, stream);
  }

  Hdf5File file_;
};

PlaneGrid some_grid(std::size_t shape) {
  Block block = distorted_blocks(5, 4, 0.1)[shape];
  block.region = [](double x, double) { return x < 0.5 ? 1 : 2; };
  return block_grid(block);
}

/// Row (cell, component) of a dataset that is told from all others by its seed.
double entry(int seed, std::size_t cell, std::size_t i) {
  return seed + 0.001 * static_cast<double>(10 * cell + i);
}

std::vector<double> rows(const PlaneGrid& grid, int seed, std::size_t width) {
  std::vector<double> all;
  for (std::size_t cell = 0; cell < grid.region.size(); ++cell)
    for (std::size_t i = 0; i < width; ++i) all.push_back(entry(seed, cell, i));
  return all;
}

void write_fields(const std::string& path, const PlaneGrid& grid, bool with_strain) {
  MadeFile file(path);
  file.write_mesh(grid);
  file.write("/time", {2}, std::vector<double>{0.5, 0.75});
  for (int frame = 0; frame < 2; ++frame) {
    const std::string group = format("/frames/{:05}/", frame);
    file.write(group + "stress", {grid.region.size(), 3}, rows(grid, 10 + frame, 3));
    if (with_strain) file.write(group + "strain", {grid.region.size(), 3}, rows(grid, 20 + frame, 3));
  }
}

/// A folder that every rank sees, with what rank 0 writes into it.
std::string folder_with(const std::function<void(const std::string&)>& write) {
  const std::string folder = scratch("run");
  if (is_root(PETSC_COMM_WORLD)) {
    std::filesystem::create_directories(folder);
    write(folder);
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  return folder;
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

void expect_same(const PlaneGrid& found, const PlaneGrid& expected) {
  EXPECT_EQ(found.points, expected.points);
  EXPECT_EQ(found.first, expected.first);
  EXPECT_EQ(found.corners, expected.corners);
  EXPECT_EQ(found.region, expected.region);
  EXPECT_EQ(found.regions, expected.regions);
}

}  // namespace

/// Each rank reads its share of the cells.
TEST(FieldsReader, ReadsMeshTimesAndAnyCells) {
  for (std::size_t shape = 0; shape < 3; ++shape) {
    const PlaneGrid grid = some_grid(shape);
    const std::string folder =
        folder_with([&](const std::string& path) { write_fields(path + "/fields.h5", grid, true); });
    for (const std::string& path : {folder, folder + "/fields.h5"}) {
      const FieldsReader fields(PETSC_COMM_WORLD, path);
      expect_same(fields.grid(), grid);
      EXPECT_EQ(fields.times(), (std::vector<double>{0.5, 0.75}));
      EXPECT_EQ(fields.path(), folder + "/fields.h5");
      const int ranks = ranks_of(PETSC_COMM_WORLD);
      const RankShare mine = rank_share(grid.region.size(), rank_of(PETSC_COMM_WORLD), ranks);
      std::vector<PlaneTensor> values(mine.count());
      for (int frame = 0; frame < 2; ++frame)
        for (const auto& [quantity, seed] : {std::pair("stress", 10), std::pair("strain", 20)}) {
          fields.read(static_cast<std::size_t>(frame), quantity, values, mine.begin);
          for (std::size_t k = 0; k < values.size(); ++k)
            for (std::size_t i = 0; i < 3; ++i)
              EXPECT_EQ(values[k][i], entry(seed + frame, mine.begin + k, i));
        }
      fields.read(0, "strain", std::span(values).first(0));
    }
  }
}

TEST(FieldsReader, SaysWhatIsMissing) {
  const PlaneGrid grid = some_grid(0);
  const std::string folder =
      folder_with([&](const std::string& path) { write_fields(path + "/fields.h5", grid, false); });
  const std::string file = folder + "/fields.h5";
  const FieldsReader fields(PETSC_COMM_WORLD, folder);
  EXPECT_TRUE(fields.has("stress"));
  EXPECT_FALSE(fields.has("strain"));
  EXPECT_EQ(refusal([&] { fields.require("strain"); }),
            "'" + file + "' (-relocalize_run) has no strain; run slide with strain among -fields_quantities");
  EXPECT_EQ(
      refusal([&] { FieldsReader(PETSC_COMM_WORLD, folder + "/none", "relocalize_reference"); }),
      "there is no file '" + folder +
          "/none' (-relocalize_reference); run slide with -fields_every or -fields_times for that folder");
}

TEST(FieldsReader, RefusesOtherFiles) {
  const PlaneGrid grid = some_grid(0);
  const std::string folder = folder_with([&](const std::string& path) {
    std::ofstream(path + "/text.h5") << "time 0 1 2 3 4 5 6 7 8 9\n";
    MadeFile(path + "/bare.h5").write("/time", {1}, std::vector<double>{0});
    MadeFile(path + "/mesh.h5").write_mesh(grid);
    write_fields(path + "/fields.h5", grid, true);
    MadeFile none(path + "/none.h5");
    none.write_mesh(grid);
    none.write("/time", {0}, std::vector<double>{});
  });
  const auto refused = [&](const std::string& file) {
    return refusal([&] { FieldsReader(PETSC_COMM_WORLD, folder + "/" + file); });
  };
  EXPECT_NE(refused("text.h5").find("is not an HDF5 file"), std::string::npos);
  EXPECT_NE(refused("bare.h5").find("has no /mesh/coordinates, so it is not a fields.h5"), std::string::npos);
  EXPECT_NE(refused("mesh.h5").find("has no /time, so it is not a fields.h5"), std::string::npos);
  EXPECT_NE(refused("none.h5").find("has no frames yet"), std::string::npos);
}

/// What does not fit together is found before an index leads astray.
TEST(FieldsReader, RefusesDamagedFiles) {
  const PlaneGrid grid = some_grid(0);
  PlaneGrid far = grid, nameless = grid;
  far.corners[7] = static_cast<int>(grid.points.size());
  nameless.region[3] = 2;
  const std::string folder = folder_with([&](const std::string& path) {
    write_fields(path + "/cut.h5", grid, true);
    std::filesystem::resize_file(path + "/cut.h5", std::filesystem::file_size(path + "/cut.h5") / 2);
    write_fields(path + "/far.h5", far, true);
    write_fields(path + "/nameless.h5", nameless, true);
    MadeFile rows_of_others(path + "/rows.h5");
    rows_of_others.write_mesh(grid);
    rows_of_others.write("/time", {1}, std::vector<double>{0});
    rows_of_others.write("/frames/00000/strain", {7, 3}, std::vector<double>(21));
  });
  const auto refused = [&](const std::string& file) {
    return refusal([&] { FieldsReader(PETSC_COMM_WORLD, folder + "/" + file); });
  };
  EXPECT_NE(refused("cut.h5").find("is damaged or incomplete: opening: "), std::string::npos);
  EXPECT_NE(refused("far.h5").find("/mesh/cells names a point that is not there"), std::string::npos);
  EXPECT_NE(refused("nameless.h5").find("/mesh/region has a region without name"), std::string::npos);
  std::vector<PlaneTensor> values(7);
  EXPECT_NE(refusal([&] {
              FieldsReader(PETSC_COMM_WORLD, folder + "/rows.h5").read(0, "strain", values);
            }).find("does not have one row for each cell"),
            std::string::npos);
}

TEST(StatisticsReader, ReadsEveryStatistic) {
  const PlaneGrid grid = some_grid(2);
  const char* names[] = {"mean", "deviation", "lowest", "highest", "quantile_low", "quantile_high"};
  const std::string folder = folder_with([&](const std::string& path) {
    MadeFile file(path + "/statistics.h5");
    file.write_mesh(grid);
    for (int k = 0; k < 6; ++k)
      file.write(std::string("/statistics/strain/") + names[k], {grid.region.size(), 3}, rows(grid, k, 3));
    file.write("/statistics/strain/covariance", {grid.region.size(), 6}, rows(grid, 9, 6));
    file.write_number("/statistics", "from", 1e-4);
    file.write_number("/statistics", "to", 2e-4);
    file.write_number("/statistics", "samples", 1001);
    file.write_number("/statistics", "quantile", 0.99);
  });
  EXPECT_TRUE(has_statistics(PETSC_COMM_WORLD, folder));
  EXPECT_FALSE(has_statistics(PETSC_COMM_WORLD, folder + "/none"));
  const StatisticsReader statistics(PETSC_COMM_WORLD, folder);
  expect_same(statistics.grid(), grid);
  EXPECT_EQ(statistics.from(), 1e-4);
  EXPECT_EQ(statistics.to(), 2e-4);
  EXPECT_EQ(statistics.samples(), 1001);
  EXPECT_EQ(statistics.quantile(), 0.99);
  std::vector<PlaneTensor> values(grid.region.size() - 3);
  for (int k = 0; k < 6; ++k) {
    statistics.read("strain", names[k], values, 3);
    EXPECT_EQ(values[0][2], entry(k, 3, 2));
    EXPECT_EQ(values.back()[0], entry(k, grid.region.size() - 1, 0));
  }
  std::vector<PlaneCovariance> covariance(2);
  statistics.read_covariance("strain", covariance, 5);
  EXPECT_EQ(covariance[1][5], entry(9, 6, 5));
  EXPECT_NE(
      refusal([&] { statistics.read("stress", "mean", values); }).find("has no /statistics/stress/mean"),
      std::string::npos);
}

TEST(LocalisationReader, SaysWhatIsMissing) {
  const PlaneGrid grid = some_grid(0);
  const std::string folder = folder_with([&](const std::string& path) {
    MadeFile file(path + "/localization.h5");
    file.write_mesh(grid);
    file.write("/cell/localisation", {grid.region.size(), 3, 3}, rows(grid, 0, 9));
  });
  EXPECT_EQ(refusal([&] { read_localisation(PETSC_COMM_WORLD, folder); }),
            "'" + folder +
                "/localization.h5' (-relocalize_tensors) has no /region/stiffness, so it is not a "
                "localization.h5; run homogenize for that folder");
  EXPECT_NE(
      refusal([&] { read_localisation(PETSC_COMM_WORLD, folder + "/none.h5"); }).find("there is no file"),
      std::string::npos);
}
