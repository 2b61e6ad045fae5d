#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "analytic_fields.hpp"
#include "failure.hpp"
#include "read_back.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/record/fields_file.hpp"

using namespace slipscale;
using testing_support::failure_of;
using testing_support::scratch;

namespace {

const MPI_Comm& world = PETSC_COMM_WORLD;
constexpr FieldQuantities all_of_them{true, true, true, true, true, true};

Mesh mesh_of(const std::string& file, int refine = 0) {
  MeshSource source;
  source.file = file;
  source.refine = refine;
  return read_mesh(world, source);
}

FieldsFile fields(const Mesh& mesh, const std::string& folder, std::optional<std::size_t> frames = {},
                  FieldQuantities quantities = all_of_them) {
  const std::vector<double> transverse(static_cast<std::size_t>(mesh.cells.size()), 0.25);
  return {world, MeshImage(world, mesh), folder, quantities, "fields", transverse, frames};
}

void write(FieldsFile& file, const Mesh& mesh, int from, int to) {
  for (int frame = from; frame < to; ++frame) {
    const auto f = analytic::fields(mesh, 0.1 * frame);
    file.write(0.1 * frame, f.u.data(), f.v.data(), f.stress.data(), f.stress.data());
  }
}

/// A folder with so many frames.
std::string written(const Mesh& mesh, int frames) {
  const OutputFolder folder(world, scratch("fields"));
  FieldsFile file = fields(mesh, folder.path());
  write(file, mesh, 0, frames);
  file.close();
  return folder.path();
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_same(const std::string& folder, const std::string& whole) {
  MPI_Barrier(world);
  if (is_root(world)) {
    const auto found = read_back::everything(folder + "/fields.h5"),
               expected = read_back::everything(whole + "/fields.h5");
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [path, dataset] : expected) {
      EXPECT_EQ(found.at(path).shape, dataset.shape) << path;
      EXPECT_TRUE(read_back::same_bits(found.at(path).values, dataset.values)) << path;
    }
    EXPECT_EQ(content(folder + "/fields.xdmf"), content(whole + "/fields.xdmf"));
  }
  MPI_Barrier(world);
}

}  // namespace

TEST(ContinuedFields, AreTheSameAsThoseThatWereNotInterrupted) {
  for (const auto& [name, block] : analytic::cases()) {
    const std::string mesh_file = scratch("block.msh");
    testing_support::write_block(block, mesh_file);
    const Mesh mesh = mesh_of(mesh_file);
    const std::string whole = written(mesh, 7);
    for (const std::size_t kept : {0u, 1u, 3u, 5u}) {
      const std::string folder = written(mesh, 5);
      {
        FieldsFile file = fields(mesh, folder, kept);
        EXPECT_EQ(file.frames(), kept);
        write(file, mesh, static_cast<int>(kept), 7);
        file.close();
      }
      expect_same(folder, whole);
    }
  }
}

TEST(ContinuedFields, KeepTheirFramesUntilTheNextOrTheEnd) {
  const std::string mesh_file = scratch("block.msh");
  testing_support::write_block({}, mesh_file);
  const Mesh mesh = mesh_of(mesh_file);
  const std::string folder = written(mesh, 5), whole = written(mesh, 2);
  const std::string shown = content(folder + "/fields.xdmf");
  MPI_Barrier(world);
  FieldsFile file = fields(mesh, folder, 2);
  if (is_root(world)) {
    std::filesystem::copy_file(folder + "/fields.h5", folder + "/copy.h5");
    EXPECT_EQ(read_back::everything(folder + "/copy.h5").at("time").shape[0], 5u);
    EXPECT_EQ(content(folder + "/fields.xdmf"), shown);
  }
  MPI_Barrier(world);
  file.close();
  expect_same(folder, whole);
}

TEST(ContinuedFields, OfAnotherRunAreRefusedOnAllRanks) {
  const std::string mesh_file = scratch("block.msh"), other_file = scratch("other.msh");
  testing_support::write_block({}, mesh_file);
  testing_support::write_block({.width = 1.5}, other_file);
  const Mesh mesh = mesh_of(mesh_file);
  const std::string folder = written(mesh, 3), before = content(folder + "/fields.h5");
  const auto said = [&](const std::string& words, const auto& action) {
    const std::string text = failure_of<UserError>(action);
    EXPECT_NE(text.find("fields.h5' cannot be continued: " + words), std::string::npos) << text;
  };
  said("'/time' has 3 of the 4 rows that were written; put back", [&] { fields(mesh, folder, 4); });
  said("its mesh_checksum is 'fnv1a:", [&] { fields(mesh_of(other_file), folder, 2); });
  said("'/mesh/coordinates' has the shape 25 x 2 and not 81 x 2",
       [&] { fields(mesh_of(mesh_file, 1), folder, 2); });
  FieldQuantities fewer = all_of_them;
  fewer.strain = false;
  said("'/frames/00000' holds other quantities", [&] { fields(mesh, folder, 2, fewer); });
  said("it is not there", [&] { fields(mesh, folder + "/nowhere", 2); });
  MPI_Barrier(world);
  EXPECT_TRUE(content(folder + "/fields.h5") == before);
}

TEST(ContinuedFields, LackingAQuantityAreRefused) {
  const std::string mesh_file = scratch("block.msh");
  testing_support::write_block({}, mesh_file);
  const Mesh mesh = mesh_of(mesh_file);
  const OutputFolder folder(world, scratch("fewer"));
  FieldQuantities fewer = all_of_them;
  fewer.principal = false;
  {
    FieldsFile file = fields(mesh, folder.path(), {}, fewer);
    write(file, mesh, 0, 2);
    file.close();
  }
  const std::string said = failure_of<UserError>([&] { fields(mesh, folder.path(), 2); });
  EXPECT_NE(said.find("it has no '/frames/00000/principal_high'"), std::string::npos) << said;
}

/// The checksums of the frames as they are written are those of the frames as they are read.
TEST(ContinuedFields, KnowWhatWasWritten) {
  for (const auto& [name, block] : analytic::cases()) {
    SCOPED_TRACE(name);
    const std::string mesh_file = scratch("block.msh");
    testing_support::write_block(block, mesh_file);
    const Mesh mesh = mesh_of(mesh_file);
    const OutputFolder folder(world, scratch("contents"));
    std::vector<std::uint64_t> contents;
    {
      FieldsFile file = fields(mesh, folder.path());
      write(file, mesh, 0, 4);
      contents = file.contents();
      file.close();
    }
    if (is_root(world)) {
      ASSERT_EQ(contents.size(), 5u);
      std::ranges::sort(contents);
      EXPECT_EQ(std::ranges::adjacent_find(contents), contents.end());
    }
    FieldsFile file = fields(mesh, folder.path(), 4);
    std::vector<std::uint64_t> known = file.contents();
    file.expect(known);
    std::vector<std::uint64_t> sorted = known;
    std::ranges::sort(sorted);
    if (is_root(world)) {
      EXPECT_EQ(sorted, contents);
      ++known[2];
    }
    const std::string text = failure_of<UserError>([&] { file.expect(known); });
    EXPECT_NE(text.find("'/frames/00001' or its time has other values than the run wrote"), std::string::npos)
        << text;
  }
}
