#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "recipes.hpp"
#include "scenes.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/morphology/compose.hpp"
#include "slipscale/morphology/picture.hpp"
#include "slipscale/morphology/result_files.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// Files of this process end at so many bytes, as on a disk that is full then.
class FullAt {
 public:
  explicit FullAt(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullAt() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullAt(const FullAt&) = delete;
  FullAt& operator=(const FullAt&) = delete;

 private:
  rlimit before_{};
};

std::string refusal(const Recipe& recipe, const Composed& composed, const GmshModel& gmsh,
                    const std::string& folder, rlim_t bytes) {
  const FullAt full(bytes);
  try {
    ResultFiles files(folder);
    files.add("mesh.msh", [&](const std::string& path) { write_mesh(recipe, composed, gmsh, path); });
    files.add("morphology.png", [&](const std::string& path) { write_picture(composed.mesh, path); });
    files.publish();
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

/// Whichever byte is the last one that fits: one sentence, the older file as it was, and nothing else left.
TEST(FullDisk, KeepsTheOlderFiles) {
  const std::string folder = scratch("full");
  GmshModel gmsh;
  for (const CellShape cell : {CellShape::triangle, CellShape::grid}) {
    Recipe recipe = recipe_of(5);  // periodic: with the section of pairs
    recipe.mesh.cell = cell;
    const Composed composed = compose(recipe, gmsh);
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/mesh.msh") << "older";
    for (const rlim_t bytes : {0, 100, 5000, 100000}) {
      const std::string said = refusal(recipe, composed, gmsh, folder, bytes);
      EXPECT_NE(said.find("-output_folder '" + folder + "' cannot take the files: "), std::string::npos)
          << said;
      EXPECT_EQ(text_of(folder + "/mesh.msh"), "older");
      EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
    }
    EXPECT_EQ(refusal(recipe, composed, gmsh, folder, 100000000), "");
    EXPECT_GT(std::filesystem::file_size(folder + "/mesh.msh"), 100000u);
  }
}
