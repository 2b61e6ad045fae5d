#include "slipscale/files/state_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "block_mesh.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"

using namespace slipscale;
using testing_support::scratch;

namespace {

const MPI_Comm& comm = PETSC_COMM_WORLD;

/// Many rows of all keys, dealt out in turn; few rows of odd keys; and one that all ranks hold.
struct Groups {
  std::vector<double> many, few;
  double one = 0;
  std::vector<StateGroup> list;

  explicit Groups(bool filled, PetscInt rows = 1000) {
    const int rank = rank_of(comm), ranks = ranks_of(comm);
    StateGroup all{"all", {}, rows, true, {}}, some{"some", {}, 0, true, {}};
    for (PetscInt key = rank; key < rows; key += ranks) all.keys.push_back(key);
    for (PetscInt key = 7 + 2 * (ranks - 1 - rank); key < 60; key += 2 * ranks) some.keys.push_back(key);
    const auto value = [&](PetscInt key, int entry) { return filled ? 1.0 / (1 + key) + entry : 0.0; };
    for (const PetscInt key : all.keys)
      for (int entry = 0; entry < 3; ++entry) many.push_back(value(key, entry));
    for (const PetscInt key : some.keys) few.push_back(value(key, 0));
    one = value(5, 5);
    all.arrays = {{"rows", "m", "three of each", 3, many.data()}};
    some.arrays = {{"rows", "Pa", "one of each", 1, few.data()}};
    list = {all, some, {"one", {0}, 0, is_root(comm), {{"number", "1", "the same for all", 1, &one}}}};
  }
};

Hdf5File opened(const std::string& path) { return is_root(comm) ? open_file(path) : Hdf5File(); }

}  // namespace

TEST(StateFile, BringsBackWhatWasWritten) {
  const std::string path = scratch("state.h5");
  const Groups before(true);
  SharedFile file(comm, path, state_bytes(comm, before.list));
  write_state(comm, file, before.list);
  file.finish();
  Groups after(false);
  read_state(comm, opened(path), path, after.list);
  EXPECT_EQ(after.many, before.many);
  EXPECT_EQ(after.few, before.few);
  EXPECT_EQ(after.one, before.one);

  Groups larger(false, 1001);
  EXPECT_THROW(read_state(comm, opened(path), path, larger.list), UserError);
  Groups other(false);
  for (PetscInt& key : other.list[1].keys) ++key;
  EXPECT_THROW(read_state(comm, opened(path), path, other.list), UserError);
  other.list[0].name = "nothing";
  EXPECT_THROW(read_state(comm, opened(path), path, other.list), UserError);
}

TEST(StateFile, ASealTellsEveryChange) {
  const std::string path = scratch("sealed");
  if (!is_root(comm)) return;
  std::ofstream(path) << "some bytes";
  EXPECT_FALSE(is_sealed(path));
  EXPECT_FALSE(is_sealed(path + ".absent"));
  seal(path);
  ASSERT_TRUE(is_sealed(path));
  std::string text;
  std::ifstream stream(path);
  std::getline(stream, text);
  text += "\n";
  for (std::size_t k = 0; k < text.size(); ++k) {
    std::string changed = text;
    changed[k] = static_cast<char>(changed[k] ^ 4);
    std::ofstream(path) << changed;
    EXPECT_FALSE(is_sealed(path)) << k;
    std::ofstream(path) << text.substr(0, k);
    EXPECT_FALSE(is_sealed(path)) << k;
  }
}
