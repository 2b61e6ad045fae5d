#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "block_mesh.hpp"
#include "read_back.hpp"
#include "slipscale/files/series_file.hpp"

using namespace slipscale;
using testing_support::scratch;

namespace {

using Storage = SeriesFile::Storage;
using Continue = SeriesFile::Continue;

constexpr double place[] = {1, 2}, elsewhere[] = {2, 3};

/// A series file with its quantities declared: of row n, time is n + ⅓, u two numbers, status a byte.
struct Series {
  SeriesFile file;
  int time = 0, u = 0, status = 0;

  explicit Series(const std::string& path, std::optional<Continue> continued = {}, double patience = 0.5)
      : file(path, patience, 1e15, continued) {
    file.about("mesh_checksum", "fnv1a:0123");
    file.constant("/x", place, {2}, "m", "position");
    time = file.add("/time", {}, "s", "time");
    u = file.add("/points/u", {500, 2}, "m", "displacement");
    status = file.add("/status", {3}, "1", "state", Storage::byte);
  }

  void write(int from, int to) {
    for (int n = from; n < to; ++n) {
      const std::uint8_t states[] = {1, 2, static_cast<std::uint8_t>(n % 256)};
      file.append(time, n + 1.0 / 3);
      file.append(u, std::vector<double>(1000, 0.1 * n).data());
      file.append(status, states);
      file.end_row();
    }
  }
};

/// The path of a file with so many rows.
std::string written(const std::string& name, int rows) {
  std::string path = scratch(name);
  Series series(path);
  series.write(0, rows);
  series.file.close();
  EXPECT_EQ(series.file.fault(), "");
  return path;
}

/// Where the first free piece of the first heap of names begins: HDF5 File Format Specification 3.0, III.D.
std::streamoff free_piece(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const std::size_t heap = bytes.find("HEAP");
  std::uint64_t head = 0, data = 0;
  std::memcpy(&head, &bytes.at(heap + 16), sizeof head);
  std::memcpy(&data, &bytes.at(heap + 24), sizeof data);
  return static_cast<std::streamoff>(head + data);
}

void expect_same(const std::string& path, const std::string& whole) {
  const auto found = read_back::everything(path), expected = read_back::everything(whole);
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [name, dataset] : expected) {
    EXPECT_EQ(found.at(name).shape, dataset.shape) << name;
    EXPECT_EQ(found.at(name).units, dataset.units) << name;
    EXPECT_EQ(found.at(name).description, dataset.description) << name;
    EXPECT_TRUE(read_back::same_bits(found.at(name).values, dataset.values)) << name;
  }
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Of a file that is open in this process.
hsize_t rows_on_disk(const std::string& path) {
  const std::string copy = scratch("copy.h5");
  std::filesystem::copy_file(path, copy);
  return read_back::everything(copy).at("time").shape[0];
}

/// What a file says when it is to be continued by `declare`; it must stay as it is.
std::string refusal_of(
    const std::string& path, hsize_t rows,
    const std::function<void(SeriesFile&)>& declare = [](SeriesFile&) {}) {
  const std::string before = bytes_of(path);
  std::string said;
  {
    SeriesFile file(path, 0, 1e15, Continue{rows});
    declare(file);
    const int time = file.add("/time", {}, "s", "time");
    said = file.refusal();
    EXPECT_EQ(file.fault(), "");
    if (!said.empty()) {
      file.append(time, 1.0);
      file.end_row();
      EXPECT_TRUE(file.read(time).empty());
    }
  }
  EXPECT_TRUE(bytes_of(path) == before);
  return said;
}

}  // namespace

TEST(ContinuedSeries, IsTheSameAsOneThatWasNotInterrupted) {
  const std::string whole = written("whole.h5", 700);
  for (const int kept : {0, 1, 2, 299, 300, 301, 400}) {
    const std::string path = written("continued.h5", 400);
    Series series(path, Continue{static_cast<hsize_t>(kept)});
    ASSERT_EQ(series.file.refusal(), "");
    EXPECT_EQ(series.file.rows(), static_cast<hsize_t>(kept));
    series.write(kept, 700);
    series.file.close();
    EXPECT_EQ(series.file.fault(), "");
    expect_same(path, whole);
  }
}

TEST(ContinuedSeries, MayBeContinuedAgainAndAgain) {
  const std::string whole = written("whole.h5", 500), path = written("again.h5", 100);
  for (int kept = 90; kept < 500; kept += 37) {
    Series series(path, Continue{static_cast<hsize_t>(kept)}, 0);
    ASSERT_EQ(series.file.refusal(), "");
    series.write(kept, std::min(kept + 60, 500));
  }
  expect_same(path, whole);
}

TEST(ContinuedSeries, KeepsItsRowsUntilTheFirstBatch) {
  const std::string path = written("kept.h5", 50);
  {
    Series series(path, Continue{20}, 1000);
    EXPECT_EQ(series.file.read(series.time).size(), 20u);
    EXPECT_EQ(rows_on_disk(path), 50u);
    series.file.close();  // without another row
  }
  expect_same(path, written("twenty.h5", 20));
}

TEST(ContinuedSeries, GivesTheRowsSoFar) {
  const std::string path = written("read.h5", 50);
  Series series(path, Continue{20}, 1000);
  series.write(20, 30);  // some of them not on the disk yet
  const auto times = series.file.read(series.time), u = series.file.read(series.u);
  ASSERT_EQ(times.size(), 30u);
  ASSERT_EQ(u.size(), 30u * 1000u);
  for (int n = 0; n < 30; ++n) {
    EXPECT_EQ(times[static_cast<std::size_t>(n)], n + 1.0 / 3);
    EXPECT_EQ(u[static_cast<std::size_t>(1000 * n + 999)], 0.1 * n);
  }
}

TEST(ContinuedSeries, AForeignFileIsRefusedAndStaysAsItIs) {
  const std::string path = written("foreign.h5", 50);
  const std::string end = "; put back the file that the interrupted run left, or start the run anew";
  EXPECT_EQ(refusal_of(path, 50), "");
  EXPECT_EQ(refusal_of(path, 51),
            "'" + path + "' cannot be continued: '/time' has 50 of the 51 rows that were written" + end);
  const auto said = [&](const std::string& words, const auto& declare) {
    const std::string text = refusal_of(path, 40, declare);
    EXPECT_NE(text.find("' cannot be continued: " + words + end), std::string::npos) << text;
  };
  said("it has no '/energy/strain'", [](auto& file) { file.add("/energy/strain", {}, "J/m", "energy"); });
  said("'/points/u' has the shape 50 x 500 x 2 and not 50 x 400 x 2", [](auto& file) {
    file.add("/points/u", {400, 2}, "m", "displacement");
  });
  said("'/points/u' is in m and not in m/s", [](auto& file) {
    file.add("/points/u", {500, 2}, "m/s", "velocity");
  });
  said("'/status' has another type of number", [](auto& file) { file.add("/status", {3}, "1", "state"); });
  said("'/x' has the shape 2 and not 1", [](auto& file) { file.constant("/x", place, {1}, "m", ""); });
  said("'/x' has other values", [](auto& file) { file.constant("/x", elsewhere, {2}, "m", ""); });
  said("its mesh_checksum is 'fnv1a:0123' and not 'fnv1a:4567'",
       [](auto& file) { file.about("mesh_checksum", "fnv1a:4567"); });
}

TEST(ContinuedSeries, WhatIsNoSuchFileIsRefused) {
  const auto refused = [](const std::string& path) {
    SeriesFile file(path, 0, 1e15, Continue{3});
    EXPECT_EQ(file.fault(), "");
    return file.refusal();
  };
  EXPECT_NE(refused(scratch("none.h5")).find("cannot be continued: it is not there; "), std::string::npos);
  const std::string text = scratch("text.h5");
  std::ofstream(text) << "no data";
  EXPECT_NE(refused(text).find("cannot be continued: it is no HDF5 file or damaged; "), std::string::npos);
  const std::string cut = written("cut.h5", 500);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  EXPECT_NE(refused(cut).find("cannot be continued: "), std::string::npos);
  const std::string heap = written("heap.h5", 500);  // how long the last free piece of the names' heap is
  const auto at = free_piece(heap);
  std::fstream(heap, std::ios::in | std::ios::out | std::ios::binary).seekp(at + 13).put(2);
  EXPECT_NE(refused(heap).find("cannot be continued: it is cut short or damaged; "), std::string::npos);
  const std::string other = scratch("other.h5");
  { const Hdf5File file(H5Fcreate(other.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)); }
  EXPECT_NE(refused(other).find("cannot be continued: the attribute 'program': "), std::string::npos);
}

/// Read back in other pieces than it was written in, and told apart from anything else by its values alone.
TEST(ContinuedSeries, KnowsWhatWasWritten) {
  const std::string path = scratch("contents.h5");
  std::vector<std::uint64_t> all, but_last;
  {
    Series series(path);
    series.write(0, 40);
    series.file.flush();
    series.write(40, 60);
    all = series.file.contents(60);
    but_last = series.file.contents(59);
    series.file.close();
    EXPECT_EQ(series.file.contents(60), all);
  }
  ASSERT_EQ(all.size(), 3u);
  // What goes on with it ends with the checksums of one that was not interrupted.
  const std::string whole = written("whole.h5", 0);
  Series longer(whole);
  longer.write(0, 70);
  {
    Series series(path, Continue{60});
    series.file.expect(all);
    series.write(60, 70);
    EXPECT_EQ(series.file.contents(70), longer.file.contents(70));
    EXPECT_EQ(series.file.contents(69), longer.file.contents(69));
  }
  // What is left out is cut off at the end, so the shorter come later.
  for (const auto& [rows, contents] : {std::pair{60, all}, {59, but_last}}) {
    Series series(path, Continue{static_cast<hsize_t>(rows)});
    series.file.expect(contents);
    EXPECT_EQ(series.file.refusal(), "");
    EXPECT_EQ(series.file.contents(rows), contents);
  }
  {
    Series fewer(path, Continue{58});
    fewer.file.expect(but_last);
    EXPECT_NE(fewer.file.refusal().find("contents.h5' cannot be continued: '/time' has other values"),
              std::string::npos)
        << fewer.file.refusal();
  }
}
