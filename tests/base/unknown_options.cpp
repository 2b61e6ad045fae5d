// Options that nobody declared, misspelt ones, and names of regions.
#include "options_fixture.hpp"

using namespace slipscale;

TEST_F(OptionsTest, UnknownOptionsStopAtOnce) {
  EXPECT_EQ(answer("wind_speed", "3"), "-wind_speed is not an option of slide; see slide -help");
  EXPECT_EQ(answer("fricton_coefficient", "3"),
            "-fricton_coefficient is not an option of slide; did you mean -friction_coefficient?");
  EXPECT_EQ(answer("mesh_flie", "3"), "-mesh_flie is not an option of slide; did you mean -mesh_file?");
  EXPECT_EQ(answer("history", "3"), "-history is not an option of slide; did you mean -history_every?");
  EXPECT_EQ(answer("coefficient", "3"),
            "-coefficient is not an option of slide; did you mean -friction_coefficient?");
}

TEST_F(OptionsTest, PlaceholdersAreFilledInSuggestions) {
  EXPECT_EQ(answer("material_matrix_yuong", "3"),
            "-material_matrix_yuong is not an option of slide; did you mean -material_matrix_young?");
  EXPECT_EQ(answer("matreial_my_fibre_young", "3"),
            "-matreial_my_fibre_young is not an option of slide; did you mean -material_my_fibre_young?");
  EXPECT_EQ(answer("boundary_top_presure", "3"),
            "-boundary_top_presure is not an option of slide; did you mean -boundary_top_pressure?");
}

TEST_F(OptionsTest, CapitalsCount) {
  EXPECT_EQ(
      answer("Friction_coefficient", "3"),
      "-Friction_coefficient differs in capitals from the option it means; write -friction_coefficient");
  EXPECT_EQ(answer("Material_matrix_B_Young", "3"),
            "-Material_matrix_B_Young differs in capitals from the option it means; write "
            "-material_Matrix_b_young");
  EXPECT_EQ(answer("material_Matrix_b_young", "3"), "");
}

TEST_F(OptionsTest, RegionsMustBeKnown) {
  give({{"material_matrix_young", "1"}, {"material_matrix_b_young", "2"}, {"boundary_top_pressure", "3"}});
  Options read = options();
  EXPECT_NO_THROW(read.know_names("region", {"matrix", "matrix_b", "all"}));
  EXPECT_EQ(read.real("material_matrix_b_young"), 2);
  EXPECT_EQ(
      sentence([&] {
        read.know_names("region", {"matrix", "inclusion"});
      }),
      "-material_matrix_b_young names the region 'matrix_b', which the mesh does not have; did you mean "
      "-material_matrix_young? (the mesh has matrix, inclusion)");
  EXPECT_EQ(
      sentence([&] {
        read.know_names("region", {"Matrix", "matrix_b"});
      }),
      "-material_matrix_young differs in capitals from the option it means; write -material_Matrix_young");
  EXPECT_EQ(
      sentence([&] {
        read.know_names("region", {"Matrix", "matrix"});
      }),
      "the region names 'Matrix' and 'matrix' of the mesh differ in capitals only, which options cannot tell "
      "apart; rename one of them");
}

TEST_F(OptionsTest, TheLongestKnownNameWins) {
  // As declared, `cell_a_b_c` may be region `a_b` of `_c` or region `a` of `_b_c`.
  const Schema ambiguous = {{"cell_<region>_c", Kind::real, "m", absent, range::any, "One."},
                            {"cell_<region>_b_c", Kind::text, "", absent, range::any, "Other."}};
  give({{"cell_a_b_c", "1"}});
  Options longest("slide", ambiguous);
  longest.know_names("region", {"a", "a_b"});
  EXPECT_EQ(longest.real("cell_a_b_c"), 1);
  longest.know_names("region", {"a"});
  EXPECT_EQ(longest.text("cell_a_b_c"), "1");
}

TEST_F(OptionsTest, EntriesOfRunAreIgnored) {
  give({{"run_version", "0.1"}, {"run_speeds", "1,2"}, {"run_empty", nullptr}, {"run_mesh_nodes", "12"}});
  Options read = options();
  read.know_names("region", {"matrix"});
  EXPECT_NO_THROW(read.refuse_unknown());
}

TEST_F(OptionsTest, OptionsOfPetscMustBeUsedInTheEnd) {
  give({{"ksp_rtol", "1e-3"}, {"log_view", nullptr}, {"citations", nullptr}, {"cell_ksp_type", "cg"}});
  const Options read("slide", schema(), {}, {"cell_"});
  EXPECT_EQ(
      sentence([&] { read.refuse_unknown(); }),
      "-cell_ksp_type was given but neither slide nor PETSc has read it; remove it, or correct its name");
  PetscBool found = PETSC_FALSE;
  petsc(PetscOptionsHasName(nullptr, "cell_", "-ksp_type", &found));
  petsc(PetscOptionsHasName(nullptr, nullptr, "-ksp_rtol", &found));
  EXPECT_NO_THROW(read.refuse_unknown());
}

TEST_F(OptionsTest, PrefixesOfSolversAreTheProgramsOwn) {
  EXPECT_NE(answer("cell_ksp_type", "cg").find("is not an option of slide"), std::string::npos);
}

/// Before the mesh is read nobody knows which names there are, and no option is proposed that may not exist.
TEST_F(OptionsTest, SuggestionsExist) {
  give({{"boundary_top_pressure_file", "3"}});
  Options read = options();
  EXPECT_EQ(sentence([&] {
              read.know_names("boundary", {"top", "bottom"});
            }),
            "-boundary_top_pressure_file is not an option of slide; did you mean -boundary_top_pressure?");
  Options bare = options();
  EXPECT_EQ(sentence([&] { bare.know_names("boundary", {"bottom"}); }),
            "-boundary_top_pressure_file is not an option of slide; see slide -help");
  EXPECT_EQ(answer("material_martix_yuong", "3"),
            "-material_martix_yuong is not an option of slide; did you mean -material_matrix_young?");
  EXPECT_EQ(answer("young", "3"), "-young is not an option of slide; did you mean -material_matrix_young?");
  EXPECT_EQ(answer("pressure", "3"),
            "-pressure is not an option of slide; did you mean -boundary_top_pressure?");
  petsc(PetscOptionsClear(nullptr));
  give({{"material_martix_yuong", "3"}});
  Options other = options();
  EXPECT_EQ(sentence([&] { other.know_names("region", {"polytetrafluoroethylene"}); }),
            "-material_martix_yuong is not an option of slide; see slide -help");
}

TEST_F(OptionsTest, DeclaredOptionsNeedNotBeRead) {
  give({{"friction_law", "coulomb"}, {"material_matrix_young", "1"}});
  EXPECT_NO_THROW(options().refuse_unknown());
}

TEST_F(OptionsTest, OptionsAddedLaterAreSeen) {
  const Options read = options();
  give({{"mesh_fiel", "a"}});
  EXPECT_NE(sentence([&] { read.refuse_unknown(); }).find("did you mean -mesh_file?"), std::string::npos);
}

TEST(Nearest, FindsSlipsOfTheFingerOnly) {
  const std::vector<std::string> known = {"matrix", "inclusion", "all", "top"};
  EXPECT_EQ(nearest("martix", known), "matrix");
  EXPECT_EQ(nearest("MATRIX", known), "matrix");
  EXPECT_EQ(nearest("inclusions", known), "inclusion");
  EXPECT_EQ(nearest("tpo", known), "top");
  EXPECT_EQ(nearest("steel", known), "");
  EXPECT_EQ(nearest("", known), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("x", {}), "");
}
