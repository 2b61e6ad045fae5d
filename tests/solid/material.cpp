#include "slipscale/solid/material.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "scenes.hpp"
#include "slipscale/base/parallel.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

using Given = std::map<std::string, std::string>;

const Given good{
    {"material_all_young", "30e9"}, {"material_all_poisson", "0.25"}, {"material_all_density", "1800"}};

/// The materials of regions `matrix` and `inclusion` under these options.
std::vector<Material> materials(const Given& given) {
  petsc(PetscOptionsClear(nullptr));
  for (const auto& [name, value] : given)
    petsc(PetscOptionsSetValue(nullptr, ("-" + name).c_str(), value.c_str()));
  const std::vector<std::string> regions{"matrix", "inclusion"};
  Options options("test", material_schema());
  options.know_names("region", {"matrix", "inclusion", "all"});
  return read_materials(options, regions);
}

void expect_refused(const Given& given, const std::string& part) {
  try {
    materials(given);
    ADD_FAILURE() << "accepted, though it should complain of " << part;
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

Given with(Given given, const Given& more) {
  for (const auto& [name, value] : more) given[name] = value;
  return given;
}

std::string written(const std::string& text) {
  const std::string path = scratch("effective.yaml");
  if (is_root(PETSC_COMM_WORLD)) std::ofstream(path) << text;
  MPI_Barrier(PETSC_COMM_WORLD);
  return path;
}

class Materials : public testing::Test {
 protected:
  void SetUp() override { keep_petsc_messages(); }
  void TearDown() override {
    petsc(PetscPopErrorHandler());
    petsc(PetscOptionsClear(nullptr));
  }
};

}  // namespace

TEST(WaveSpeeds, IsotropicInEveryDirection) {
  const double young = 45e9, poisson = 0.3, density = 1900;
  const double shear = young / (2 * (1 + poisson)),
               lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const Material material = isotropic(young, poisson, density);
  for (double angle = 0; angle < 6.3; angle += 0.37) {
    const WaveSpeeds speeds = wave_speeds(material, std::cos(angle), std::sin(angle));
    EXPECT_NEAR(speeds.fast / std::sqrt((lame + 2 * shear) / density), 1, 1e-14);
    EXPECT_NEAR(speeds.slow / std::sqrt(shear / density), 1, 1e-14);
  }
}

/// Along x the acoustic tensor of a general solid is [C11 C16; C16 C66], along y [C66 C26; C26 C22].
TEST(WaveSpeeds, AnisotropicAlongTheAxes) {
  Material material{{}, 1000, ""};
  material.stiffness << 5e9, 1e9, 0, 1e9, 4e9, 1e9, 0, 1e9, 2e9;
  EXPECT_NEAR(wave_speeds(material, 1, 0).fast, std::sqrt(5e6), 1e-9);
  EXPECT_NEAR(wave_speeds(material, 1, 0).slow, std::sqrt(2e6), 1e-9);
  EXPECT_NEAR(wave_speeds(material, 0, 1).fast, std::sqrt((3 + std::sqrt(2.0)) * 1e6), 1e-9);
  EXPECT_NEAR(wave_speeds(material, 0, 1).slow, std::sqrt((3 - std::sqrt(2.0)) * 1e6), 1e-9);
}

TEST_F(Materials, AllServesWhoHasNoneOfItsOwn) {
  const auto read = materials(with(good, {{"material_inclusion_young", "80e9"},
                                          {"material_inclusion_poisson", "0.2"},
                                          {"material_inclusion_density", "2500"}}));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].stiffness, isotropic_stiffness(30e9, 0.25));
  EXPECT_EQ(read[1].stiffness, isotropic_stiffness(80e9, 0.2));
  EXPECT_EQ(read[1].density, 2500);
}

TEST_F(Materials, SixNumbersInTheirOrder) {
  const auto read =
      materials({{"material_all_stiffness", "60e9,45e9,15e9,20e9,8e9,-5e9"}, {"material_all_density", "1"}});
  Eigen::Matrix3d expected;
  expected << 60e9, 15e9, 8e9, 15e9, 45e9, -5e9, 8e9, -5e9, 20e9;
  EXPECT_EQ(read[0].stiffness, expected);
}

TEST_F(Materials, AFileOfAHomogenisedMaterial) {
  const std::string path =
      written("stiffness: [6.0e10, 4.5e10, 1.5e10, 2.0e10, 0.0, 0.0]\ndensity: 2000.0\n");
  const auto read = materials({{"material_file", path}});
  EXPECT_EQ(read[1].c22(), 45e9);
  EXPECT_EQ(read[1].density, 2000);
}

TEST_F(Materials, MissingOnes) {
  expect_refused({}, "region 'matrix' has no material");
  Given one_only;
  for (const auto& [name, value] : good) one_only["material_matrix_" + name.substr(13)] = value;
  expect_refused(one_only, "region 'inclusion' has no material");
  for (const char* key : {"young", "poisson", "density"}) {
    Given given = good;
    given.erase(std::string("material_all_") + key);
    expect_refused(given, std::string("material_all_") + key);
  }
}

TEST_F(Materials, OutOfRange) {
  for (const char* nu : {"0.5", "0.7", "-1"})
    expect_refused(with(good, {{"material_all_poisson", nu}}), "poisson");
  for (const char* value : {"-1800", "0"})
    expect_refused(with(good, {{"material_all_density", value}}), "density");
  expect_refused(with(good, {{"material_all_young", "-1"}}), "young");
}

TEST_F(Materials, BadStiffness) {
  const Given density{{"material_all_density", "1800"}};
  expect_refused(with(density, {{"material_all_stiffness", "6,4,1,2,0"}}), "needs six numbers");
  expect_refused(with(density, {{"material_all_stiffness", "1,1,2,1,0,0"}}), "not positive definite");
  expect_refused(with(density, {{"material_all_stiffness", "6,4,1,-2,0,0"}}), "not positive definite");
}

TEST_F(Materials, Contradictions) {
  const Given six{{"material_all_stiffness", "6,4,1,2,0,0"}};
  expect_refused(with(good, six), "contradicts -material_all_stiffness");
  const std::string path = written("stiffness: [6.0, 4.0, 1.0, 2.0, 0.0, 0.0]\ndensity: 1.0\n");
  expect_refused(with(good, {{"material_all_file", path}}), "contradicts -material_all_file");
  expect_refused(with(good, {{"material_file", path}}), "-material_file contradicts");
}

TEST_F(Materials, BadFiles) {
  expect_refused({{"material_file", "/nowhere/effective.yaml"}}, "cannot read '/nowhere/effective.yaml'");
  for (const char* text :
       {"density: 1.0\n", "stiffness: [6.0, 4.0, 1.0, 2.0, 0.0, 0.0]\n",
        "stiffness: [6.0, 4.0, 1.0, 2.0, 0.0, 0.0]\ndensity: -1.0\n", "stiffness: soft\ndensity: 1.0\n"})
    expect_refused({{"material_file", written(text)}}, "must hold 'stiffness:");
  expect_refused({{"material_file", written("stiffness: [6.0, 4.0\n")}}, "effective.yaml");
  expect_refused({{"material_file", written("stiffness: [6.0, 4.0, 1.0]\ndensity: 1.0\n")}},
                 "needs six numbers");
}
