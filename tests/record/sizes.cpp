#include "slipscale/base/readable.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "block_mesh.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/files/series_file.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/record/fields_file.hpp"

using namespace slipscale;

TEST(Estimate, OfASeriesIsNearItsSize) {
  const std::string path = testing_support::scratch("series.h5");
  SeriesFile file(path);
  const int time = file.add("/time", {}, "s", "time");
  const int u = file.add("/u", {100, 2}, "m", "displacement");
  const std::vector<double> row(200, 1.0);
  for (int n = 0; n < 3000; ++n) {
    file.append(time, n);
    file.append(u, row.data());
    file.end_row();
  }
  const double predicted = file.bytes(3000);
  file.close();
  EXPECT_NEAR(predicted / static_cast<double>(std::filesystem::file_size(path)), 1.0, 0.05);
}

/// Ten thousand points for a few rows: headers and the smallest chunks count.
TEST(Estimate, OfManyDatasetsIsNearTheirSize) {
  const std::string path = testing_support::scratch("many.h5");
  SeriesFile file(path, 0.5, 20);
  const double place[] = {1, 2};
  std::vector<int> ids;
  for (int k = 0; k < 1000; ++k) {
    const std::string point = "/points/" + std::to_string(k) + "/";
    file.constant(point + "x", place, {2}, "m", "where the point is in the undeformed body");
    ids.push_back(file.add(point + "u", {2}, "m", "displacement"));
  }
  const double predicted = file.bytes(20);
  for (int n = 0; n < 20; ++n) {
    for (const int id : ids) file.append(id, place);
    file.end_row();
  }
  file.close();
  EXPECT_EQ(file.fault(), "");
  EXPECT_NEAR(predicted / static_cast<double>(std::filesystem::file_size(path)), 1.0, 0.2);
}

TEST(Estimate, OfFieldsIsNearTheirSize) {
  const OutputFolder folder(PETSC_COMM_WORLD, testing_support::scratch("fields"));
  testing_support::Block block;
  block.nx = block.ny = 30;
  testing_support::write_block(block, folder.path("block.msh"));
  MeshSource source;
  source.file = folder.path("block.msh");
  const Mesh mesh = read_mesh(PETSC_COMM_WORLD, source);
  const std::vector<double> u(2 * 31 * 31), stress(3 * 1800);
  FieldsFile file(PETSC_COMM_WORLD, MeshImage(PETSC_COMM_WORLD, mesh), folder.path(), {}, "fields",
                  std::vector<double>(1800, 0.25));
  for (int frame = 0; frame < 10; ++frame) file.write(frame, u.data(), u.data(), stress.data());
  file.close();
  const auto size = static_cast<double>(std::filesystem::file_size(folder.path("fields.h5")));
  EXPECT_NEAR(fields_bytes(10, mesh.nodes.total, mesh.cells.total, {}) / size, 1.0, 0.1);
}

TEST(Readable, Bytes) {
  EXPECT_EQ(readable_bytes(0), "0 B");
  EXPECT_EQ(readable_bytes(999), "999 B");
  EXPECT_EQ(readable_bytes(1000), "1.00 kB");
  EXPECT_EQ(readable_bytes(1.25e9), "1.25 GB");
  EXPECT_EQ(readable_bytes(31.4e6), "31.4 MB");
  EXPECT_EQ(readable_bytes(999.9e6), "1.00 GB");
  EXPECT_EQ(readable_bytes(123456), "123 kB");
}

TEST(Readable, Durations) {
  EXPECT_EQ(readable_duration(0.42), "0.4 s");
  EXPECT_EQ(readable_duration(12.3), "12 s");
  EXPECT_EQ(readable_duration(59.7), "1 min 00 s");
  EXPECT_EQ(readable_duration(200), "3 min 20 s");
  EXPECT_EQ(readable_duration(7500), "2 h 05 min");
  EXPECT_EQ(readable_duration(99 * 3600), "4 d 3 h");
  EXPECT_EQ(readable_duration(1.0 / 0.0), "?");
}
