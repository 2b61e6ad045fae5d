#include "slipscale/record/fields_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "analytic_fields.hpp"
#include "failure.hpp"
#include "read_back.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/mesh/read.hpp"

using namespace slipscale;
using testing_support::failure_of;
using testing_support::scratch;

namespace {

Mesh mesh_of(MPI_Comm comm, const std::string& file, int refine = 0) {
  MeshSource source;
  source.file = file;
  source.refine = refine;
  return read_mesh(comm, source);
}

void write_frames(MPI_Comm comm, const Mesh& mesh, const std::string& folder,
                  FieldQuantities quantities = {}) {
  FieldsFile file(comm, mesh, folder, quantities);
  for (double t : {0.0, 1e-3}) {
    const auto f = analytic::fields(mesh, t);
    file.write(t, f.u.data(), f.v.data(), f.stress.data());
  }
  file.close();
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// A folder with the fields on a mesh, written by all ranks together.
std::string folder_of(const testing_support::Block& block, FieldQuantities quantities = {}, int refine = 0) {
  const OutputFolder folder(PETSC_COMM_WORLD, scratch("fields"));
  testing_support::write_block(block, folder.path("block.msh"));
  write_frames(PETSC_COMM_WORLD, mesh_of(PETSC_COMM_WORLD, folder.path("block.msh"), refine), folder.path(),
               quantities);
  return folder.path();
}

}  // namespace

TEST(FieldsFile, HoldsTheSameDataOnAnyNumberOfRanks) {
  for (const auto& [name, block] : analytic::cases()) {
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const OutputFolder alone(PETSC_COMM_SELF, folder + "/alone");
    write_frames(PETSC_COMM_SELF, mesh_of(PETSC_COMM_SELF, folder + "/block.msh"), alone.path());
    const auto expected = read_back::everything(alone.path("fields.h5"));
    const auto found = read_back::everything(folder + "/fields.h5");
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_EQ(found.size(), 4u + 1u + 2u * 4u);
    for (const auto& [path, dataset] : expected) {
      EXPECT_EQ(found.at(path).shape, dataset.shape) << name << ' ' << path;
      EXPECT_TRUE(read_back::same_bits(found.at(path).values, dataset.values)) << name << ' ' << path;
    }
    EXPECT_EQ(text_of(folder + "/fields.xdmf"), text_of(alone.path("fields.xdmf")));
  }
}

TEST(FieldsFile, PointsCarryTheFieldOfTheirPlace) {
  for (const auto& [name, block] : analytic::cases()) {
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const auto all = read_back::everything(folder + "/fields.h5");
    const auto& x = all.at("mesh/coordinates");
    const auto& u = all.at("frames/00001/u");
    ASSERT_EQ(x.shape, (std::vector<hsize_t>{60, 2})) << name;  // 10 x 6, on a torus the seam's 6 nodes twice
    ASSERT_EQ(u.shape, (std::vector<hsize_t>{60, 3})) << name;
    EXPECT_EQ(u.units, "m");
    for (std::size_t k = 0; k < 60; ++k) {
      EXPECT_NEAR(u.values[3 * k], analytic::u_x(x.values[2 * k], x.values[2 * k + 1], 1e-3), 1e-14) << name;
      EXPECT_NEAR(u.values[3 * k + 1], analytic::u_y(x.values[2 * k], x.values[2 * k + 1], 1e-3), 1e-14)
          << name;
      EXPECT_EQ(u.values[3 * k + 2], 0.0);
    }
    EXPECT_EQ(all.at("time").values, (std::vector<double>{0.0, 1e-3}));
  }
}

TEST(FieldsFile, CellsAreDrawnWhereTheyAre) {
  for (const auto& [name, block] : analytic::cases()) {
    if (block.shape == testing_support::Shape::mixed) continue;  // meshio's test reads those
    const std::string folder = folder_of(block);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    const auto all = read_back::everything(folder + "/fields.h5");
    const auto& cells = all.at("mesh/cells");
    const auto& x = all.at("mesh/coordinates").values;
    const std::size_t corners = cells.shape[1];
    EXPECT_EQ(corners, block.shape == testing_support::Shape::triangles ? 3u : 4u);
    for (std::size_t cell = 0; cell < cells.shape[0]; ++cell)
      for (std::size_t d = 0; d < 2; ++d) {
        double centre = 0;
        for (std::size_t k = 0; k < corners; ++k)
          centre += x[2 * static_cast<std::size_t>(cells.values[corners * cell + k]) + d] /
                    static_cast<double>(corners);
        EXPECT_NEAR(all.at("frames/00000/stress").values[3 * cell + d], centre, 1e-14) << name;
      }
  }
}

TEST(FieldsFile, SeamNodesAreDrawnTwiceOnARefinedTorusToo) {
  auto block = analytic::cases()[3].block;
  ASSERT_TRUE(block.periodic_x);
  const std::string folder = folder_of(block, {}, 1);
  if (!is_root(PETSC_COMM_WORLD)) return;
  const auto all = read_back::everything(folder + "/fields.h5");
  const auto& x = all.at("mesh/coordinates");
  ASSERT_GE(x.shape[0], 19u * 11u);
  const auto& cells = all.at("mesh/cells").values;
  for (std::size_t corner = 0; corner < cells.size(); corner += 3) {
    const auto at = [&](std::size_t k) { return x.values[2 * static_cast<std::size_t>(cells[corner + k])]; };
    EXPECT_LT(std::max({at(0), at(1), at(2)}) - std::min({at(0), at(1), at(2)}), 0.1);
  }
}

TEST(FieldsFile, HoldsOnlyWhatIsAskedFor) {
  const std::string folder = folder_of(analytic::cases()[0].block, {.u = false, .v = true, .stress = false});
  if (!is_root(PETSC_COMM_WORLD)) return;
  const auto all = read_back::everything(folder + "/fields.h5");
  EXPECT_EQ(all.count("frames/00000/u"), 0u);
  EXPECT_EQ(all.count("frames/00000/v"), 1u);
  EXPECT_EQ(all.count("frames/00000/stress"), 0u);
  EXPECT_EQ(text_of(folder + "/fields.xdmf").find("Name=\"u\""), std::string::npos);
}

TEST(FieldsFile, NamesItsRegions) {
  const std::string folder = folder_of(analytic::cases()[0].block);
  if (!is_root(PETSC_COMM_WORLD)) return;
  const Hdf5File file = read_back::open(folder + "/fields.h5");
  const Hdf5Dataset region(H5Dopen2(file, "/mesh/region", H5P_DEFAULT));
  const std::string names = read_back::attribute(region, "names");
  EXPECT_TRUE(names == "matrix,inclusion" || names == "inclusion,matrix") << names;
}

TEST(FieldsFile, CanBeReadAfterEveryFrame) {
  const OutputFolder folder(PETSC_COMM_WORLD, scratch("open"));
  testing_support::write_block({}, folder.path("block.msh"));
  const Mesh mesh = mesh_of(PETSC_COMM_WORLD, folder.path("block.msh"));
  FieldsFile file(PETSC_COMM_WORLD, mesh, folder.path(), {});
  for (int frame = 0; frame < 3; ++frame) {
    const auto f = analytic::fields(mesh, frame);
    file.write(frame, f.u.data(), f.v.data(), f.stress.data());
    if (is_root(PETSC_COMM_WORLD)) {
      // A copy is what another process would see; HDF5 shares what it has open in this one.
      std::filesystem::copy_file(folder.path("fields.h5"), folder.path("copy.h5"),
                                 std::filesystem::copy_options::overwrite_existing);
      const auto all = read_back::everything(folder.path("copy.h5"));
      EXPECT_EQ(all.at("time").values.size(), frame + 1u);
      EXPECT_EQ(all.at("frames/0000" + std::to_string(frame) + "/stress").values[2], frame);
    }
    MPI_Barrier(PETSC_COMM_WORLD);
  }
}

TEST(FieldsFile, AFullDiskStopsAllRanks) {
  for (bool everywhere : {true, false}) {
    const OutputFolder folder(PETSC_COMM_WORLD, scratch("full"));
    testing_support::Block block;
    block.nx = block.ny = 40;
    testing_support::write_block(block, folder.path("block.msh"));
    const Mesh mesh = mesh_of(PETSC_COMM_WORLD, folder.path("block.msh"));
    const auto f = analytic::fields(mesh, 0);
    FieldsFile file(PETSC_COMM_WORLD, mesh, folder.path(), {});
    const read_back::SmallDisk disk(everywhere || is_root(PETSC_COMM_WORLD) ? 900000 : 100000000);
    const std::string failure = failure_of<RunError>([&] {
      for (int frame = 0; frame < 20; ++frame) file.write(frame, f.u.data(), f.v.data(), f.stress.data());
    });
    EXPECT_NE(failure.find("fields.h5 cannot be written: File too large; "), std::string::npos) << failure;
    file.close();
    if (is_root(PETSC_COMM_WORLD)) {
      const auto left = read_back::everything(folder.path("fields.h5"));
      EXPECT_GE(left.at("time").values.size(), 3u);
    }
  }
}

TEST(FieldsFile, AFolderThatIsNotThereStopsAllRanks) {
  const std::string path = scratch("block.msh");
  testing_support::write_block({}, path);
  const Mesh mesh = mesh_of(PETSC_COMM_WORLD, path);
  const std::string failure =
      failure_of<RunError>([&] { FieldsFile(PETSC_COMM_WORLD, mesh, "/nowhere/at/all", {}); });
  EXPECT_NE(failure.find("/nowhere/at/all/fields.h5 cannot be written"), std::string::npos) << failure;
}

TEST(FieldQuantities, AreReadFromAList) {
  EXPECT_TRUE(field_quantities("von_mises").von_mises && field_quantities("principal").of_stress());
  const auto some = field_quantities("stress,u");
  EXPECT_TRUE(some.u && some.stress && !some.v && !some.strain);
  EXPECT_TRUE(field_quantities("strain").strain && !field_quantities("strain").stress);
  try {
    field_quantities("u,power");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(std::string(error.what()).find("-fields_quantities has 'power'"), 0u) << error.what();
  }
}
