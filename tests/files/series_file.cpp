#include "slipscale/files/series_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "block_mesh.hpp"
#include "read_back.hpp"
#include "slipscale/base/error.hpp"

using namespace slipscale;
using testing_support::scratch;

namespace {

using Storage = SeriesFile::Storage;

/// The rows that all growing datasets of the writer's file have.
hsize_t complete_rows(const std::map<std::string, read_back::Dataset>& all) {
  hsize_t rows = std::numeric_limits<hsize_t>::max();
  for (const auto& [path, dataset] : all) rows = std::min(rows, dataset.shape[0]);
  return all.size() == 4 ? rows : 0;
}

void expect_rows_of_the_writer(const std::map<std::string, read_back::Dataset>& all, hsize_t rows) {
  for (hsize_t n = 0; n < rows; ++n) {
    const double value = static_cast<double>(n);
    ASSERT_EQ(all.at("time").values[n], value);
    ASSERT_EQ(all.at("energy/kinetic").values[n], 2 * value);
    for (hsize_t k : {0, 999}) ASSERT_EQ(all.at("u").values[1000 * n + k], value);
    for (hsize_t k : {0, 499}) ASSERT_EQ(all.at("status").values[500 * n + k], static_cast<double>(n % 251));
  }
}

/// Rows on disk of a file that is open in this process: read from a copy, as HDF5 shares what it has open.
hsize_t rows_on_disk(const std::string& path, const std::string& dataset) {
  const std::string copy = scratch("copy.h5");
  std::filesystem::copy_file(path, copy);
  return read_back::everything(copy).at(dataset).shape[0];
}

/// The file of a writer that may be at work on it; empty when it cannot be read yet.
std::map<std::string, read_back::Dataset> try_everything(const std::string& path) {
  try {
    return read_back::everything(path);
  } catch (const LibraryError&) {
    return {};
  }
}

}  // namespace

TEST(SeriesFile, RowsComeBackWithShapesUnitsAndTypes) {
  const std::string path = scratch("history.h5");
  {
    SeriesFile file(path);
    const double x[] = {1, 2, 3, 4};
    file.constant("/points/x", x, {2, 2}, "m", "positions");
    const int time = file.add("/time", {}, "s", "time of the row");
    const int u = file.add("/points/u", {2, 2}, "m", "displacement");
    const int status = file.add("/status", {3}, "1", "open, stick, slip", Storage::byte);
    EXPECT_EQ(file.row_bytes(), 8u + 32u + 3u);
    for (int n = 0; n < 5000; ++n) {
      const double row[] = {n + 0.1, n + 0.2, n + 0.3, n + 0.4};
      const std::uint8_t states[] = {0, 1, static_cast<std::uint8_t>(n % 256)};
      file.append(time, 1e-6 * n);
      file.append(u, row);
      file.append(status, states);
      file.end_row();
    }
    EXPECT_EQ(file.rows(), 5000u);
    EXPECT_EQ(file.fault(), "");
  }
  const auto all = read_back::everything(path);
  EXPECT_EQ(all.at("points/x").values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(all.at("points/x").shape, (std::vector<hsize_t>{2, 2}));
  EXPECT_EQ(all.at("time").shape, (std::vector<hsize_t>{5000}));
  EXPECT_EQ(all.at("time").units, "s");
  EXPECT_EQ(all.at("time").description, "time of the row");
  EXPECT_EQ(all.at("time").values[4999], 1e-6 * 4999);
  EXPECT_EQ(all.at("points/u").shape, (std::vector<hsize_t>{5000, 2, 2}));
  EXPECT_EQ(all.at("points/u").values[4 * 4321 + 2], 4321 + 0.3);
  EXPECT_EQ(all.at("status").shape, (std::vector<hsize_t>{5000, 3}));
  EXPECT_EQ(all.at("status").values[3 * 700 + 2], 700 % 256);
}

TEST(SeriesFile, HasItsDatasetsBeforeTheFirstRow) {
  const std::string path = scratch("empty.h5");
  SeriesFile file(path);
  file.add("/time", {}, "s", "time");
  file.close();
  EXPECT_EQ(read_back::everything(path).at("time").shape, (std::vector<hsize_t>{0}));
}

TEST(SeriesFile, BatchesAreWrittenByTime) {
  const std::string path = scratch("batches.h5");
  SeriesFile file(path, 0.05);
  const int time = file.add("/time", {}, "s", "time");
  const auto row = [&] {
    file.append(time, 1.0);
    file.end_row();
  };
  row();
  EXPECT_EQ(rows_on_disk(path, "time"), 1u) << "the first row does not wait";
  row();
  EXPECT_EQ(rows_on_disk(path, "time"), 1u);
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  row();
  EXPECT_EQ(rows_on_disk(path, "time"), 3u);
}

TEST(SeriesFile, LargeBatchesDoNotWait) {
  const std::string path = scratch("large.h5");
  SeriesFile file(path, 1000);
  const int u = file.add("/u", {1 << 14}, "m", "an eighth of a megabyte a row");
  const std::vector<double> row(1 << 14, 3.0);
  for (int n = 0; n < 10; ++n) {
    file.append(u, row.data());
    file.end_row();
  }
  EXPECT_EQ(rows_on_disk(path, "u"), 9u);
}

TEST(SeriesFile, AForgottenQuantityIsAFault) {
  SeriesFile file(scratch("forgotten.h5"));
  file.add("/time", {}, "s", "time");
  const int u = file.add("/u", {}, "m", "displacement");
  file.append(u, 1.0);
  file.end_row();
  EXPECT_NE(file.fault().find("'/time' was not given exactly once in row 0"), std::string::npos)
      << file.fault();
}

TEST(SeriesFile, AFileThatCannotBeCreatedIsAFaultAndNoException) {
  SeriesFile file("/nowhere/at/all/history.h5");
  EXPECT_NE(file.fault().find("/nowhere/at/all/history.h5 cannot be written"), std::string::npos)
      << file.fault();
  EXPECT_NE(file.fault().find("No such file or directory"), std::string::npos) << file.fault();
  const int time = file.add("/time", {}, "s", "time");
  file.append(time, 1.0);
  file.end_row();
  file.close();
}

TEST(SeriesFile, AFullDiskIsAFaultAndLeavesAReadableFile) {
  const std::string path = scratch("full.h5");
  SeriesFile file(path);
  const int u = file.add("/u", {1000}, "m", "displacement");
  const std::vector<double> row(1000, 1.0);
  {
    const read_back::SmallDisk disk(200000);
    for (int n = 0; n < 1000 && file.fault().empty(); ++n) {
      file.append(u, row.data());
      file.end_row();
      file.flush();
    }
    EXPECT_NE(file.fault().find(path), std::string::npos) << file.fault();
    EXPECT_NE(file.fault().find("File too large"), std::string::npos) << file.fault();
    file.close();
  }
  EXPECT_GE(read_back::everything(path).at("u").shape[0], 10u);
}

// A short run is one batch: what it computed must not be lost whole for the rows that do not fit.
TEST(SeriesFile, AFullDiskTakesTheFirstRowsOfABatch) {
  const std::string path = scratch("first_rows.h5");
  {
    SeriesFile file(path, 1000);
    const int time = file.add("/time", {}, "s", "time"), u = file.add("/u", {1000}, "m", "displacement");
    for (int n = 0; n < 100; ++n) {
      file.append(time, static_cast<double>(n));
      file.append(u, std::vector<double>(1000, n).data());
      file.end_row();
    }
    const read_back::SmallDisk disk(400000);
    file.close();
    EXPECT_NE(file.fault().find("File too large"), std::string::npos) << file.fault();
  }
  const auto all = read_back::everything(path);
  const hsize_t rows = all.at("u").shape[0];
  EXPECT_GE(rows, 20u);  // of 8 kB each
  EXPECT_LT(rows, 50u);
  ASSERT_EQ(all.at("time").shape[0], rows);
  for (hsize_t n = 0; n < rows; ++n) {
    ASSERT_EQ(all.at("time").values[n], static_cast<double>(n));
    ASSERT_EQ(all.at("u").values[1000 * n + 999], static_cast<double>(n));
  }
}

TEST(SeriesFile, CanBeReadWhileItIsWrittenAndAfterAKill) {
  const std::string path = scratch("killed.h5");
  std::string program = SERIES_WRITER, argument = path;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t writer = 0;
  ASSERT_EQ(posix_spawn(&writer, program.c_str(), nullptr, nullptr, arguments, environ), 0);
  std::map<std::string, read_back::Dataset> seen;
  for (int tries = 0; tries < 200 && complete_rows(seen) < 100; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (std::filesystem::exists(path)) seen = try_everything(path);
  }
  EXPECT_EQ(waitpid(writer, nullptr, WNOHANG), 0) << "the writer ended by itself";
  const hsize_t rows = complete_rows(seen);
  EXPECT_GE(rows, 100u);
  expect_rows_of_the_writer(seen, rows);

  ASSERT_EQ(kill(writer, SIGKILL), 0);
  waitpid(writer, nullptr, 0);
  const auto left = read_back::everything(path);
  EXPECT_GE(complete_rows(left), rows);
  expect_rows_of_the_writer(left, complete_rows(left));
}
