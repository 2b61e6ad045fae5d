#include "slipscale/base/options.hpp"

#include <stdexcept>

#include "options_fixture.hpp"

using namespace slipscale;

TEST_F(OptionsTest, ReadsEveryKind) {
  give({{"friction_coefficient", "3e-1"},
        {"friction_law", "coulomb"},
        {"history_every", "7"},
        {"history_points", "0, 1,-2.5"},
        {"relocalize_correction", nullptr},
        {"material_matrix_young", "+2e9"}});
  const Options read = options();
  EXPECT_EQ(read.real("friction_coefficient"), 0.3);
  EXPECT_EQ(read.text("friction_law"), "coulomb");
  EXPECT_EQ(read.integer("history_every"), 7);
  EXPECT_EQ(read.reals("history_points"), (std::vector<double>{0, 1, -2.5}));
  EXPECT_TRUE(read.flag("relocalize_correction"));
  EXPECT_EQ(read.find_real("material_matrix_young"), 2e9);
}

TEST_F(OptionsTest, FallsBackOnTheDefaults) {
  const Options read = options();
  EXPECT_EQ(read.text("friction_law"), "none");
  EXPECT_EQ(read.find_integer("history_every"), 10);
  EXPECT_EQ(read.reals("history_points"), std::vector<double>{});
  EXPECT_EQ(read.reals("body_acceleration"), (std::vector<double>{0, 0}));
  EXPECT_FALSE(read.flag("relocalize_correction"));
  EXPECT_EQ(read.find_real("initial_gap"), std::nullopt);
  EXPECT_EQ(read.find_text("boundary_top_x"), "free");
  EXPECT_FALSE(read.given("friction_law"));
}

TEST_F(OptionsTest, FlagsAreWrittenInManyWays) {
  for (const char* word : {"true", "1", "yes", "on", "True"}) {
    give({{"relocalize_correction", word}});
    EXPECT_TRUE(options().flag("relocalize_correction")) << word;
  }
  for (const char* word : {"false", "0", "no", "off"}) {
    give({{"relocalize_correction", word}});
    EXPECT_FALSE(options().flag("relocalize_correction")) << word;
  }
  EXPECT_EQ(answer("relocalize_correction", "perhaps"),
            "-relocalize_correction is 'perhaps', but it must be true or false");
}

TEST_F(OptionsTest, LongValuesAreWhole) {
  std::string list = "0";
  for (int k = 1; k < 20000; ++k) list.append(",").append(std::to_string(k));
  give({{"history_points", list.c_str()}});
  const auto numbers = options().reals("history_points");
  ASSERT_EQ(numbers.size(), 20000u);
  EXPECT_EQ(numbers.back(), 19999);
}

TEST_F(OptionsTest, NumbersAreReadStrictly) {
  for (const char* text :
       {"0.3x", "nan", "inf", "-inf", "1e999", "0x10", "1d-3", ".", "--3", "+-3", "0.3 0.4"}) {
    EXPECT_NE(answer("friction_coefficient", text).find("must be a number >= 0 (ratio)"), std::string::npos)
        << text << ": " << answer("friction_coefficient", text);
  }
  EXPECT_EQ(answer("history_every", "4294967296"),
            "-history_every is 4294967296, but it must be at most 2147483647");
  EXPECT_EQ(answer("history_every", "-99999999999999999999"),
            "-history_every is -99999999999999999999, but it must be >= 1");
  for (const char* text : {"1.5", "1e3", "three"})
    EXPECT_EQ(answer("history_every", text),
              "-history_every is '" + std::string(text) + "', but it must be a whole number >= 1");
  EXPECT_EQ(
      answer("friction_coefficient", "0,3"),
      "-friction_coefficient is '0,3', but it must be a number >= 0 (ratio); write one number with a decimal "
      "point");
}

TEST_F(OptionsTest, RangesAreKept) {
  EXPECT_EQ(answer("friction_coefficient", "-0.3"),
            "-friction_coefficient is -0.3, but it must be >= 0 (ratio)");
  EXPECT_EQ(answer("material_steel_young", "0"), "-material_steel_young is 0, but it must be > 0 (Pa)");
  EXPECT_EQ(answer("material_steel_poisson", "0.5"),
            "-material_steel_poisson is 0.5, but it must be > -1 and < 0.5 (ratio)");
  EXPECT_EQ(answer("history_every", "0"), "-history_every is 0, but it must be >= 1");
  EXPECT_EQ(answer("history_points", "1,b"),
            "-history_points is '1,b', but it must be numbers separated by commas (m), and 'b' is no number");
  EXPECT_EQ(answer("history_points", "1,,2"),
            "-history_points is '1,,2', but it must be numbers separated by commas (m), and '' is no number");
}

TEST_F(OptionsTest, WordsAndNumbers) {
  EXPECT_EQ(answer("time_step", "auto"), "");
  EXPECT_EQ(answer("time_step", "1e-9"), "");
  EXPECT_EQ(answer("time_step", "-1e-9"), "-time_step is '-1e-9', but it must be auto or a number > 0 (s)");
  EXPECT_EQ(answer("time_step", "atuo"),
            "-time_step is 'atuo', but it must be auto or a number > 0 (s); did you mean auto?");
  EXPECT_EQ(answer("boundary_top_x", "-1e-3"), "");
  give({{"time_step", "1e-9"}});
  EXPECT_EQ(options().real("time_step"), 1e-9);
}

TEST_F(OptionsTest, MissingValuesAndMissingOptions) {
  EXPECT_EQ(answer("friction_coefficient", nullptr),
            "-friction_coefficient has no value; write after it a number >= 0 (ratio)");
  EXPECT_EQ(answer("mesh_file", ""), "-mesh_file has no value; write after it a text");
  petsc(PetscOptionsClear(nullptr));
  const Options read = options();
  EXPECT_EQ(
      sentence([&] { (void)read.find_real("friction_coefficient"); }),
      "-friction_coefficient is needed here but not given (Coulomb's coefficient); it must be a number >= 0 "
      "(ratio)");
  EXPECT_NE(sentence([&] { (void)read.real("initial_gap"); }), "");
  EXPECT_NE(sentence([&] { (void)read.text("mesh_file"); }), "");
}

TEST_F(OptionsTest, NumbersInNamesAreNotDropped) {
  // PETSc would answer for `fibre_2` with what it has for `fibre`.
  give({{"material_fibre_young", "1e9"}, {"material_fibre_3_young", "3e9"}});
  const Options read = options();
  EXPECT_EQ(read.find_real("material_fibre_2_young"), std::nullopt);
  EXPECT_FALSE(read.given("material_fibre_2_young"));
  EXPECT_EQ(read.real("material_fibre_3_young"), 3e9);
  EXPECT_EQ(read.real("material_fibre_young"), 1e9);
}

TEST_F(OptionsTest, EffectiveValuesAreThoseAskedFor) {
  give({{"friction_coefficient", "3e-1"}, {"history_every", "5"}, {"relocalize_correction", nullptr}});
  const Options read = options();
  EXPECT_TRUE(read.effective().empty());
  (void)read.real("friction_coefficient");
  (void)read.text("friction_law");
  (void)read.find_real("initial_gap");
  (void)read.reals("history_points");
  (void)read.flag("relocalize_correction");
  EXPECT_EQ(read.effective(), (std::map<std::string, std::string>{{"friction_coefficient", "3e-1"},
                                                                  {"friction_law", "none"},
                                                                  {"relocalize_correction", "true"}}));
}

TEST_F(OptionsTest, MistakesOfTheProgrammerAreNotTheUsers) {
  const Options read = options();
  EXPECT_THROW((void)read.real("never_declared"), std::logic_error);
  EXPECT_THROW((void)read.real("time_step"), std::logic_error);
  EXPECT_THROW(Options("slide", {{"a", Kind::real, "m", "-1", range::positive, "Wrong default."}}),
               std::logic_error);
}

TEST(Manual, SaysEverythingInTheWidthOfATerminal) {
  const std::string text =
      manual("slide", "Slides.",
             {{"friction_law", Kind::text, "", "none", range::one_of({"none", "coulomb"}), "Which law."},
              {"mesh_file", Kind::text, "", required, range::any,
               "The mesh, which is a file that somebody has "
               "made with gmsh or another program that writes the same format, and which may be long."},
              {"friction_length", Kind::real, "m", absent, range::positive, "Memory length."}});
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = text.find('\n', begin);
    EXPECT_LE(std::min(end, text.size()) - begin, 110u) << text.substr(begin, end - begin);
  }
  for (const char* words : {"none or coulomb; default none", "required", "a number > 0 (m); no default",
                            "Which law.", "-options_file_yaml scene.yaml", "-log_view"})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  // Grouped by first word: both options of friction stand before the mesh.
  EXPECT_LT(text.find("-friction_length"), text.find("-mesh_file"));
}
