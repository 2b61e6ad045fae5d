#include "slipscale/files/shared_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "block_mesh.hpp"
#include "failure.hpp"
#include "read_back.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"

using namespace slipscale;
using testing_support::failure_of;
using testing_support::scratch;

namespace {

const MPI_Comm& world = PETSC_COMM_WORLD;

/// Rows 0, 1, 2, … of a dataset, each rank its share of them.
void write_numbers(SharedFile& file, const std::string& path, std::size_t rows) {
  const RankShare mine = rank_share(rows, rank_of(world), ranks_of(world));
  std::vector<double> values(mine.count());
  std::iota(values.begin(), values.end(), static_cast<double>(mine.begin));
  file.write({path, "1", "numbers"}, {{rows}, mine.begin, mine.count()}, H5T_NATIVE_DOUBLE, values.data());
}

std::vector<double> numbers(std::size_t rows) {
  std::vector<double> values(rows);
  std::iota(values.begin(), values.end(), 0.0);
  return values;
}

}  // namespace

TEST(SharedFile, HoldsTheRowsOfAllRanksInTheirOrder) {
  const std::string path = scratch("shared.h5");
  SharedFile file(world, path, 1e6);
  write_numbers(file, "/few", 5);
  write_numbers(file, "/many", 3000001);  // several pieces of each rank
  file.finish();
  if (!is_root(world)) return;
  const auto all = read_back::everything(path);
  EXPECT_EQ(all.at("few").values, numbers(5));
  EXPECT_EQ(all.at("many").values, numbers(3000001));
}

TEST(SharedFile, SaysWhereItComesFrom) {
  const std::string path = scratch("provenance.h5");
  SharedFile(world, path, 1e4).finish();
  if (!is_root(world)) return;
  const Hdf5File file = read_back::open(path);
  EXPECT_FALSE(read_back::attribute(file, "program").empty());
  const std::string version = read_back::attribute(file, "version");
  EXPECT_EQ(std::count(version.begin(), version.end(), '.'), 2) << version;
  EXPECT_EQ(read_back::attribute(file, "date").size(), std::string("2026-01-31T12:00:00Z").size());
  std::int64_t ranks = 0;
  const Hdf5Attribute attribute(H5Aopen(file, "ranks", H5P_DEFAULT));
  ASSERT_GE(H5Aread(attribute, H5T_NATIVE_INT64, &ranks), 0);
  EXPECT_EQ(ranks, ranks_of(world));
}

/// What neither a reservation nor anybody else foresaw: HDF5's own write fails, on the rank that writes.
TEST(SharedFile, AWriteThatFailsStopsAllRanksAndKeepsWhatWasFlushed) {
  const std::string path = scratch("failing.h5");
  std::string first, second;
  {
    SharedFile file(world, path, 0, SharedFile::Appearance::growing);
    write_numbers(file, "/before", 1000);
    file.flush();
    const read_back::SmallDisk disk(100000);
    first = failure_of<RunError>([&] {
      write_numbers(file, "/after", 1000000);
      file.flush();
    });
    second = failure_of<RunError>([&] { write_numbers(file, "/later", 10); });
  }
  EXPECT_NE(first.find("failing.h5 cannot be written: /after: File too large; see that"), std::string::npos)
      << first;
  EXPECT_NE(second.find("failing.h5 cannot be written: an earlier write failed"), std::string::npos)
      << second;
  if (!is_root(world)) return;
  EXPECT_EQ(read_back::everything(path).at("before").values, numbers(1000));
}

/// Only the rank that writes touches the disk: a limit on another one, which once left both waiting in a
/// collective call, changes nothing.
TEST(SharedFile, AnotherRanksDiskDoesNotMatter) {
  const std::string path = scratch("limited.h5");
  const read_back::SmallDisk disk(is_root(world) ? 100000000 : 100);
  SharedFile file(world, path, 1e5);
  write_numbers(file, "/numbers", 10000);
  file.finish();
  if (!is_root(world)) return;
  EXPECT_EQ(read_back::everything(path).at("numbers").values.size(), 10000u);
}

TEST(SharedFile, WhatIsNotFinishedLeavesNothing) {
  const std::string path = scratch("unfinished.h5");
  {
    SharedFile file(world, path, 1e4);
    write_numbers(file, "/numbers", 10);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  MPI_Barrier(world);
  EXPECT_FALSE(std::filesystem::exists(path + ".partial"));
}

TEST(SharedFile, TakesLongPaths) {
  const std::string folder = scratch("long") + "/" + std::string(200, 'a') + "/" + std::string(200, 'b');
  if (is_root(world)) std::filesystem::create_directories(folder);
  SharedFile file(world, folder + "/fields.h5", 1e4);
  write_numbers(file, "/numbers", 10);
  file.finish();
  if (!is_root(world)) return;
  EXPECT_EQ(read_back::everything(folder + "/fields.h5").at("numbers").values, numbers(10));
}

/// xx, yy, xy and a zz apart, seen as a tensor.
TEST(SharedFile, AViewShowsOthersColumns) {
  const std::string path = scratch("view.h5");
  SharedFile file(world, path, 1e4, SharedFile::Appearance::growing);
  const std::vector<double> rows = {1, 2, 3, 4, 5, 6}, zz = {7, 8};
  file.write({"/frame/stress", "Pa", "stress"}, slice_of_root(world, {2, 3}), H5T_NATIVE_DOUBLE, rows.data());
  file.write({"/frame/zz", "Pa", "zz"}, slice_of_root(world, {2}), H5T_NATIVE_DOUBLE, zz.data());
  file.write_view({"/frame/tensor", "Pa", "tensor"}, {{2, 3, 3},
                                                      {{0, "/frame/stress", {3}, 0},
                                                       {1, "/frame/stress", {3}, 2},
                                                       {3, "/frame/stress", {3}, 2},
                                                       {4, "/frame/stress", {3}, 1},
                                                       {8, "/frame/zz", {}, 0}}});
  file.write_view({"/frame/yy", "Pa", "yy"}, {{2}, {{0, "/frame/stress", {3}, 1}}});
  file.finish();
  if (!is_root(world)) return;
  const auto all = read_back::everything(path);
  EXPECT_EQ(all.at("frame/tensor").shape, (std::vector<hsize_t>{2, 3, 3}));
  EXPECT_EQ(all.at("frame/tensor").values,
            (std::vector<double>{1, 3, 0, 3, 2, 0, 0, 0, 7, 4, 6, 0, 6, 5, 0, 0, 0, 8}));
  EXPECT_EQ(all.at("frame/yy").values, (std::vector<double>{2, 5}));
  EXPECT_EQ(all.at("frame/tensor").units, "Pa");
}
