#include "slipscale/files/output_folder.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "block_mesh.hpp"
#include "failure.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"

using namespace slipscale;
using testing_support::failure_of;
using testing_support::scratch;
namespace fs = std::filesystem;

namespace {

void on_first_rank(const auto& action) {
  if (is_root(PETSC_COMM_WORLD)) action();
  MPI_Barrier(PETSC_COMM_WORLD);
}

/// Files below the folder but for the one that keeps others out.
int files_below(const std::string& folder) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    count += entry.is_regular_file() && !entry.path().filename().string().starts_with(".slipscale");
  return count;
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

TEST(OutputFolder, IsCreatedWithTheFoldersAboveIt) {
  const OutputFolder folder(PETSC_COMM_WORLD, scratch("a") + "/b/c");
  EXPECT_TRUE(fs::is_directory(folder.path()));
  EXPECT_EQ(folder.path("run.yaml"), folder.path() + "/run.yaml");
  if (is_root(PETSC_COMM_WORLD)) {
    EXPECT_EQ(files_below(folder.path()), 0);
  }
}

TEST(OutputFolder, LosesTheFilesOfAnOlderRunAndNothingElse) {
  const std::string path = scratch("old");
  on_first_rank([&] {
    fs::create_directories(path + "/sub");
    for (const char* file : {"run.yaml", "summary.yaml", "history.h5", "contact.h5", "fields.h5",
                             "fields.xdmf", "notes.txt", "checkpoint-100.h5", "sub/run.yaml"})
      std::ofstream(path + "/" + file) << "old";
  });
  const OutputFolder folder(
      PETSC_COMM_WORLD, path,
      {"run.yaml", "summary.yaml", "history.h5", "contact.h5", "fields.h5", "fields.xdmf"});
  on_first_rank([&] {
    EXPECT_EQ(files_below(path), 3);
    for (const char* file : {"notes.txt", "checkpoint-100.h5", "sub/run.yaml"})
      EXPECT_EQ(text_of(path + "/" + file), "old");
  });
}

/// One older run is kept, whole, and what is not of a run stays where it is.
TEST(OutputFolder, KeepsAnOlderRunThatIsWorthIt) {
  const std::string path = scratch("kept");
  const std::vector<std::string> files{"run.yaml", "history.h5", "checkpoint.h5"};
  const auto write = [&](const std::vector<std::string>& names, const std::string& text) {
    on_first_rank([&] {
      fs::create_directories(path);
      for (const std::string& name : names) std::ofstream(path + "/" + name) << text;
    });
  };
  const auto worth = [](const std::string& folder) { return fs::exists(folder + "/checkpoint.h5"); };
  write({"run.yaml", "history.h5", "history.h5.journal", "checkpoint.h5", "notes.txt"}, "first");
  { EXPECT_EQ(OutputFolder(PETSC_COMM_WORLD, path, files, worth).path(), path); }
  on_first_rank([&] {
    for (const char* name : {"run.yaml", "history.h5", "history.h5.journal", "checkpoint.h5"}) {
      EXPECT_FALSE(fs::exists(path + "/" + name));
      EXPECT_EQ(text_of(path + "/replaced/" + name), "first");
    }
    EXPECT_EQ(text_of(path + "/notes.txt"), "first");
  });
  write({"run.yaml", "history.h5"}, "second");  // not worth it
  { EXPECT_EQ(OutputFolder(PETSC_COMM_WORLD, path, files, worth).kept(), ""); }
  on_first_rank([&] {
    EXPECT_FALSE(fs::exists(path + "/run.yaml"));
    EXPECT_EQ(text_of(path + "/replaced/run.yaml"), "first");
  });
  write({"run.yaml", "checkpoint.h5"}, "third");
  const OutputFolder folder(PETSC_COMM_WORLD, path, files, worth);
  on_first_rank([&] {
    EXPECT_EQ(folder.kept(), path + "/replaced");
    EXPECT_EQ(text_of(path + "/replaced/run.yaml"), "third");
    EXPECT_FALSE(fs::exists(path + "/replaced/history.h5"));
    EXPECT_FALSE(fs::exists(path + "/replaced/history.h5.journal"));
  });
}

TEST(OutputFolder, ThatHoldsAFolderInPlaceOfAFileIsRefused) {
  const std::string path = scratch("folders");
  on_first_rank([&] { fs::create_directories(path + "/checkpoint.h5"); });
  const std::string failure =
      failure_of<UserError>([&] { const OutputFolder folder(PETSC_COMM_WORLD, path, {"checkpoint.h5"}); });
  EXPECT_EQ(failure.find("-output_folder '" + path + "' holds a folder named checkpoint.h5"), 0u) << failure;
}

TEST(OutputFolder, ThatCannotBeIsAUsersErrorOnAllRanks) {
  const std::string path = scratch("file");
  on_first_rank([&] { std::ofstream(path) << "a file"; });
  for (const std::string& impossible : {path, path + "/below", std::string("/proc/slipscale")}) {
    const std::string failure = failure_of<UserError>([&] { OutputFolder(PETSC_COMM_WORLD, impossible); });
    EXPECT_EQ(failure.find("-output_folder '" + impossible + "' "), 0u) << failure;
    EXPECT_NE(failure.find("; give a folder"), std::string::npos) << failure;
  }
  EXPECT_EQ(text_of(path), "a file");
}

TEST(OutputFolder, ReplacesTextsAsAWhole) {
  const OutputFolder folder(PETSC_COMM_WORLD, scratch("texts"));
  folder.write_text("summary.yaml", "first: 1\n");
  folder.write_text("summary.yaml", "second: 2\n");
  on_first_rank([&] {
    EXPECT_EQ(text_of(folder.path("summary.yaml")), "second: 2\n");
    EXPECT_EQ(files_below(folder.path()), 1);
    fs::remove_all(folder.path());
  });
  const std::string failure = failure_of<RunError>([&] { folder.write_text("summary.yaml", "third: 3\n"); });
  EXPECT_NE(failure.find("summary.yaml cannot be written: No such file or directory; see that"),
            std::string::npos)
      << failure;
}

TEST(OutputFolder, BelongsToOneRunAtATime) {
  const std::string path = scratch("busy");
  {
    const OutputFolder folder(PETSC_COMM_WORLD, path);
    on_first_rank([&] { std::ofstream(folder.path("run.yaml")) << "mine"; });
    const std::string failure =
        failure_of<UserError>([&] { const OutputFolder second(PETSC_COMM_WORLD, path, {"run.yaml"}); });
    EXPECT_EQ(failure.find("-output_folder '" + path + "' belongs to a run that still goes on"), 0u)
        << failure;
    on_first_rank([&] { EXPECT_EQ(text_of(path + "/run.yaml"), "mine"); });
  }
  EXPECT_EQ(failure_of<UserError>([&] { const OutputFolder third(PETSC_COMM_WORLD, path); }), "");
}

TEST(Unwritable, FoldersAreSeenBeforeTheWorkAndLeftAsTheyAre) {
  const std::string path = scratch("plain");
  on_first_rank([&] { std::ofstream(path) << "a file"; });
  EXPECT_EQ(failure_of<UserError>([&] { refuse_unwritable(PETSC_COMM_WORLD, scratch("new") + "/a/b"); }), "");
  EXPECT_FALSE(fs::exists(scratch("new")));
  for (const std::string& impossible : {path, path + "/below"}) {
    const std::string failure =
        failure_of<UserError>([&] { refuse_unwritable(PETSC_COMM_WORLD, impossible); });
    EXPECT_EQ(failure.find("-output_folder '" + impossible + "' cannot be "), 0u) << failure;
  }
}
