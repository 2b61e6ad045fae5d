#include "slipscale/files/output_folder.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "block_mesh.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"

using namespace slipscale;
using testing_support::scratch;
namespace fs = std::filesystem;

namespace {

void on_first_rank(const auto& action) {
  if (is_root(PETSC_COMM_WORLD)) action();
  MPI_Barrier(PETSC_COMM_WORLD);
}

std::string failure_of(const auto& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
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
    EXPECT_TRUE(fs::is_empty(folder.path()));
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
    int left = 0;
    for (const auto& entry : fs::recursive_directory_iterator(path)) left += entry.is_regular_file();
    EXPECT_EQ(left, 3);
    for (const char* file : {"notes.txt", "checkpoint-100.h5", "sub/run.yaml"})
      EXPECT_EQ(text_of(path + "/" + file), "old");
  });
}

TEST(OutputFolder, ThatCannotBeIsAUsersErrorOnAllRanks) {
  const std::string path = scratch("file");
  on_first_rank([&] { std::ofstream(path) << "a file"; });
  for (const std::string& impossible : {path, path + "/below", std::string("/proc/slipscale")}) {
    const std::string failure = failure_of([&] { OutputFolder(PETSC_COMM_WORLD, impossible); });
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
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
    fs::remove_all(folder.path());
  });
  const std::string failure = failure_of([&] { folder.write_text("summary.yaml", "third: 3\n"); });
  EXPECT_NE(failure.find("summary.yaml: No such file or directory"), std::string::npos) << failure;
}
