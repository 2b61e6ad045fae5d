#include "slipscale/files/folder_lock.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "block_mesh.hpp"
#include "failure.hpp"
#include "slipscale/base/error.hpp"

using namespace slipscale;
using testing_support::failure_of;
using testing_support::scratch;

namespace {

std::string folder_named(const std::string& name) {
  const std::string folder = scratch(name);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

TEST(FolderLock, KeepsOthersOutAsLongAsItLives) {
  const std::string folder = folder_named("locked");
  {
    const FolderLock lock(folder);
    const std::string failure = failure_of<UserError>([&] { const FolderLock second(folder); });
    EXPECT_EQ(failure.find("-output_folder '" + folder + "' belongs to a run that still goes on (process " +
                           std::to_string(getpid()) + " on "),
              0u)
        << failure;
    EXPECT_NE(failure.find("; wait for it or give another folder"), std::string::npos) << failure;
    EXPECT_NE(failure_of<UserError>([&] { const FolderLock third(folder); }), "")
        << "the refused one has not opened it";
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  EXPECT_EQ(failure_of<UserError>([&] { const FolderLock again(folder); }), "");
}

/// A child holds the folder until it is killed, and leaves its file behind.
TEST(FolderLock, OfAKilledProcessIsInNobodysWay) {
  const std::string folder = folder_named("killed");
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder);
    (void)!write(ready[1], "x", 1);
    for (;;) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_NE(failure_of<UserError>([&] { const FolderLock lock(folder); }), "");
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(std::filesystem::is_empty(folder));
  EXPECT_EQ(failure_of<UserError>([&] { const FolderLock lock(folder); }), "");
}

TEST(FolderLock, WithoutAFolderIsTheSystemsFault) {
  try {
    const FolderLock lock("/nowhere/at/all");
    FAIL();
  } catch (const LibraryError& error) {
    EXPECT_STREQ(error.what(), "No such file or directory");
  }
}
