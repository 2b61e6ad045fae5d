#include "slipscale/files/disk_space.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "block_mesh.hpp"
#include "failure.hpp"
#include "read_back.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/files/hdf5.hpp"

using namespace slipscale;
using testing_support::failure_of;
using testing_support::scratch;

namespace {

std::string file_with(const std::string& name, const std::string& text) {
  const std::string path = scratch(name);
  std::ofstream(path) << text;
  return path;
}

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST(ReserveSpace, ChangesNothingThatCanBeSeen) {
  const std::string path = file_with("reserved", "data");
  reserve_space(path, 4, 1000000);
  give_back_space(path, 4);
  EXPECT_EQ(text_of(path), "data");
}

TEST(ReserveSpace, SaysWhatIsInTheWay) {
  const std::string path = file_with("small", "data");
  const read_back::SmallDisk disk(100000);
  EXPECT_EQ(failure_of<LibraryError>([&] { reserve_space(path, 4, 1000000); }), "File too large");
  EXPECT_EQ(failure_of<LibraryError>([&] { fill_with_zeros(path, 1000000); }), "File too large");
  EXPECT_EQ(text_of(path), "data");
  std::filesystem::remove(path);
  EXPECT_EQ(failure_of<LibraryError>([&] { reserve_space(path, 4, 10); }), "No such file or directory");
}

/// What stands in for reserving where the file system cannot (ext2, NFS).
TEST(FillWithZeros, KeepsWhatIsThereAndGrowsTheFile) {
  const std::string path = file_with("filled", "data");
  fill_with_zeros(path, 3000000);
  const std::string text = text_of(path);
  EXPECT_EQ(text.size(), 3000000u);
  EXPECT_EQ(text.substr(0, 4), "data");
  EXPECT_EQ(text.find_first_not_of('\0', 4), std::string::npos);
  fill_with_zeros(path, 10);  // it has that already
  EXPECT_EQ(std::filesystem::file_size(path), 3000000u);
  give_back_space(path, 4);
  EXPECT_EQ(text_of(path), "data");
}

TEST(FillWithZeros, LeavesTheFileAsItWasOnAFullDisk) {
  std::ofstream probe("/dev/full");
  if (!probe) GTEST_SKIP() << "no /dev/full here";
  EXPECT_FALSE(failure_of<LibraryError>([&] { fill_with_zeros("/dev/full", 10); }).empty());
}

/// HDF5, which crashes at the end after it has failed to write the first bytes, must not see that.
TEST(NewFile, OnAFullDiskTellsWhoAsks) {
  const std::string path = scratch("no-room.h5");
  {
    const read_back::SmallDisk disk(100);
    Hdf5File file = create_file(path);
    EXPECT_GE(H5Fflush(file, H5F_SCOPE_LOCAL), 0);
    EXPECT_EQ(failure_of<LibraryError>([&] { check_written(file, "flushing"); }), "flushing: File too large");
    EXPECT_EQ(failure_of<LibraryError>([&] { close_file(file); }), "File too large");
    EXPECT_FALSE(file.open());
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(SyncFile, SaysWhatIsInTheWay) {
  const std::string path = file_with("synced", "data");
  sync_file(path);
  EXPECT_EQ(text_of(path), "data");
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(std::filesystem::path(path).parent_path());
  sync_file(std::filesystem::path(path).filename());
  std::filesystem::current_path(here);
  EXPECT_EQ(failure_of<LibraryError>([&] { sync_file(path + ".none"); }), "No such file or directory");
}

TEST(Reservation, GoesAheadWhereTheDiskHasRoomAndNoticesARemovedFile) {
  const std::string path = file_with("ahead", "data");
  {
    const read_back::SmallDisk disk(100000);
    Reservation room;
    room.reach(path, 4, 60000);  // twice that is more than there is
    EXPECT_EQ(failure_of<LibraryError>([&] { room.reach(path, 50000, 60000); }), "File too large");
  }
  Reservation room;
  room.reach(path, 4, 60000);
  std::filesystem::remove(path);
  EXPECT_EQ(failure_of<LibraryError>([&] { room.reach(path, 10000, 60000); }), "No such file or directory");
}
