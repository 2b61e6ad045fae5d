// Options that are given and have no effect: refused, or set aside where a later place overrules them.
#include <cstdlib>
#include <stdexcept>

#include "options_fixture.hpp"

using namespace slipscale;

namespace {

const Idle no_law{"with -friction_law none", "give -friction_law coulomb", {"friction_law"}};

class IdleOptions : public OptionsTest {
 protected:
  /// The coefficient from one place, the law from another.
  static Options from(int coefficient, int law) {
    return Options("slide", schema(),
                   {{"friction_coefficient", "0.3", {coefficient, "a.yaml"}},
                    {"friction_law", "none", {law, "b.yaml"}}});
  }
};

}  // namespace

TEST_F(IdleOptions, AreRefused) {
  for (const auto& [coefficient, law] : {std::pair{1, 1}, {2, 1}, {0, 0}}) {
    const Options read = from(coefficient, law);
    EXPECT_EQ(sentence([&] { read.refuse_idle({"friction_coefficient"}, no_law); }),
              "-friction_coefficient has no effect with -friction_law none; remove it, or give -friction_law "
              "coulomb");
    EXPECT_NO_THROW(read.refuse_idle({"initial_gap", "mesh_file"}, no_law));  // not given
    EXPECT_TRUE(read.notes().empty());
  }
}

/// What is off is not idle, wherever it stands; what is on is.
TEST_F(IdleOptions, AreNoFlagsThatAreOff) {
  for (const auto& [value, refused] : {std::pair{"false", false}, {"no", false}, {"true", true}}) {
    const Options read("slide", schema(),
                       {{"relocalize_correction", "true", {1, "a.yaml"}},
                        {"relocalize_correction", value, {2, "b.yaml"}},
                        {"friction_law", "none", {1, "a.yaml"}}});
    EXPECT_EQ(!sentence([&] { read.refuse_idle({"relocalize_correction"}, no_law); }).empty(), refused)
        << value;
    if (refused) continue;
    (void)read.text("friction_law");
    ask_for_all(read);
    EXPECT_NO_THROW(read.refuse_unread());
  }
}

TEST_F(IdleOptions, AreSetAsideWhereALaterPlaceMakesThemIdle) {
  const Options read = from(1, 2);
  (void)read.real("friction_coefficient");
  EXPECT_NO_THROW(read.refuse_idle({"friction_coefficient"}, no_law));
  EXPECT_EQ(read.notes(),
            (std::vector<std::string>{"-friction_coefficient of a.yaml has no effect with -friction_law none "
                                      "(b.yaml); it is set aside"}));
  EXPECT_FALSE(read.given("friction_coefficient"));
  EXPECT_FALSE(read.effective().contains("friction_coefficient"));
  EXPECT_NE(sentence([&] { (void)read.real("friction_coefficient"); }).find("not given"), std::string::npos);
  (void)read.text("friction_law");
  ask_for_all(read);
  EXPECT_NO_THROW(read.refuse_unread());
}

TEST_F(IdleOptions, ThatNobodyReadAreRefused) {
  const Options read = from(1, 1);
  (void)read.text("friction_law");
  (void)read.given("friction_coefficient");  // looking is not reading
  EXPECT_EQ(
      sentence([&] { read.refuse_unread(); }),
      "-friction_coefficient has no effect in this scene; remove it (slide -help says what it belongs to)");
  (void)read.real("friction_coefficient");
  ask_for_all(read);
  EXPECT_NO_THROW(read.refuse_unread());
}

/// An option is declared in one place and read in others: forgetting the second is no mistake of the user.
TEST_F(IdleOptions, ThatNoReaderKnowsAreAMistakeOfTheProgrammer) {
  for (const char* forgotten : {"initial_gap", "boundary_top_pressure", "material_top_young"}) {
    const Options read = options();
    ask_for_all(read, {forgotten});
    EXPECT_THROW(read.refuse_unread(), std::logic_error) << forgotten;
    read.refuse_idle({forgotten}, no_law);  // saying that it is idle is knowing it
    EXPECT_NO_THROW(read.refuse_unread()) << forgotten;
  }
  Options bare = options();  // no boundary of the mesh could have the option
  ask_for_all(bare, {"boundary_top_pressure", "boundary_top_x"});
  bare.know_names("boundary", {});
  EXPECT_NO_THROW(bare.refuse_unread());
}

TEST_F(IdleOptions, NamesOfAGroupComeFromItsSchema) {
  EXPECT_EQ(names_in(schema(), "material_<region>_", "matrix"),
            (std::vector<std::string>{"material_matrix_young", "material_matrix_poisson"}));
  EXPECT_EQ(names_in(schema(), "run_"), std::vector<std::string>{});
}

TEST_F(IdleOptions, EntriesAndOptionsOfPetscNeedNoReader) {
  give({{"run_version", "0.1"}, {"log_view", nullptr}, {"ksp_rtol", "1e-3"}});
  const Options read = options();
  ask_for_all(read);
  EXPECT_NO_THROW(read.refuse_unread());
}

TEST_F(IdleOptions, OfTwoThatSayTheSameTheLaterCounts) {
  const auto refused = [](const Options& read) {
    return sentence([&] { read.refuse_both("friction_coefficient", "friction_law"); });
  };
  EXPECT_EQ(refused(from(1, 1)), "-friction_coefficient contradicts -friction_law; give one of them");
  const Options first = from(2, 1), second = from(1, 2);
  EXPECT_EQ(refused(first), "");
  EXPECT_EQ(refused(second), "");
  EXPECT_TRUE(first.given("friction_coefficient") && !first.given("friction_law"));
  EXPECT_TRUE(!second.given("friction_coefficient") && second.given("friction_law"));
  EXPECT_EQ(first.notes().front(),
            "-friction_law of b.yaml gives way to -friction_coefficient (a.yaml); it is set aside");
}

/// Options know no difference between capitals and small letters, and users should not rely on one.
TEST_F(IdleOptions, ASecondSpellingIsSeen) {
  EXPECT_EQ(
      sentence([&] {
        (void)Options(
            "slide", schema(),
            {{"friction_coefficient", "0.3", {1, "a.yaml"}}, {"Friction_Coefficient", "0.3", {2, "b.yaml"}}});
      }),
      "-Friction_Coefficient differs in capitals from the option it means; write -friction_coefficient");
  Options read("slide", schema(),
               {{"material_Fibre_young", "1", {1, "a.yaml"}}, {"material_fibre_young", "1", {2, "b.yaml"}}});
  EXPECT_EQ(
      sentence([&] { read.know_names("region", {"Fibre"}); }),
      "-material_fibre_young differs in capitals from the option it means; write -material_Fibre_young");
}

TEST_F(IdleOptions, TheLastPlaceHasTheLastWord) {
  const Options read(
      "slide", schema(),
      {{"friction_coefficient", "0.3", {1, "a.yaml"}}, {"friction_coefficient", "0.4", {2, "b.yaml"}}});
  EXPECT_EQ(read.real("friction_coefficient"), 0.4);
  EXPECT_EQ(read.typed(), (std::vector<std::string>{"friction_coefficient"}));
}

/// PETSc's database holds 512.
TEST_F(IdleOptions, ThousandsOfOptionsHaveRoom) {
  std::vector<Written> written;
  std::vector<std::string> regions;
  for (int k = 0; k < 1000; ++k) {
    regions.push_back("grain_" + std::to_string(k));
    for (const char* key : {"_young", "_poisson"})
      written.push_back({"material_" + regions.back() + key, "0.1"});
  }
  Options read("slide", schema(), written);
  read.know_names("region", regions);
  for (const std::string& region : regions) EXPECT_EQ(read.real("material_" + region + "_young"), 0.1);
  EXPECT_EQ(read.effective().size(), 1000u);
}

TEST_F(IdleOptions, WhatAFileOfPetscSaysIsTracedToIt) {
  const auto said = [](const char* options) {
    setenv("PETSC_OPTIONS", options, 1);
    petsc(PetscOptionsClear(nullptr));
    petsc(PetscOptionsInsertString(nullptr, options));
    const std::string text = sentence([] { (void)Options("slide", schema()); });
    unsetenv("PETSC_OPTIONS");
    return text;
  };
  EXPECT_EQ(
      said("-wind_speed 3"),
      "-wind_speed is not an option of slide; see slide -help (it stands in the variable PETSC_OPTIONS)");
  EXPECT_EQ(
      said("-friction_coefficient -3"),
      "-friction_coefficient is -3, but it must be >= 0 (ratio) (it stands in the variable PETSC_OPTIONS)");
}
