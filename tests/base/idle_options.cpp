// Options that are given and have no effect: refused, or set aside where a later place overrules them.
#include "options_fixture.hpp"

using namespace slipscale;

namespace {

const Idle no_law{"with -friction_law none", "give -friction_law coulomb", {"friction_law"}};

class IdleOptions : public OptionsTest {
 protected:
  /// The coefficient from one place, the law from another.
  static Options from(int coefficient, int law) {
    give({{"friction_coefficient", "0.3"}, {"friction_law", "none"}});
    return Options("slide", schema(),
                   {{"friction_coefficient", {coefficient, "a.yaml"}}, {"friction_law", {law, "b.yaml"}}});
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

TEST_F(IdleOptions, AreSetAsideWhereALaterPlaceMakesThemIdle) {
  const Options read = from(1, 2);
  (void)read.real("friction_coefficient");
  EXPECT_NO_THROW(read.refuse_idle({"friction_coefficient"}, no_law));
  EXPECT_EQ(read.notes(), (std::vector<std::string>{
                              "note: -friction_coefficient of a.yaml has no effect with -friction_law none "
                              "(b.yaml); it is set aside"}));
  EXPECT_FALSE(read.given("friction_coefficient"));
  EXPECT_FALSE(read.effective().contains("friction_coefficient"));
  EXPECT_NE(sentence([&] { (void)read.real("friction_coefficient"); }).find("not given"), std::string::npos);
  (void)read.text("friction_law");
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
  EXPECT_NO_THROW(read.refuse_unread());
}

TEST_F(IdleOptions, EntriesAndOptionsOfPetscNeedNoReader) {
  give({{"run_version", "0.1"}, {"log_view", nullptr}, {"ksp_rtol", "1e-3"}});
  EXPECT_NO_THROW(options().refuse_unread());
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
            "note: -friction_law of b.yaml gives way to -friction_coefficient (a.yaml); it is set aside");
}

/// PETSc keeps the first spelling in its database; who wrote the second one is known from elsewhere.
TEST_F(IdleOptions, ASecondSpellingIsSeen) {
  give({{"friction_coefficient", "0.3"}});
  const Origins origins = {{"friction_coefficient", {1, "a.yaml"}}, {"Friction_Coefficient", {2, "b.yaml"}}};
  EXPECT_EQ(
      sentence([&] { (void)Options("slide", schema(), origins); }),
      "-Friction_Coefficient differs in capitals from the option it means; write -friction_coefficient");
  give({{"material_Fibre_young", "1"}});
  Options read("slide", schema(), {{"material_fibre_young", {2, "b.yaml"}}});
  EXPECT_EQ(
      sentence([&] { read.know_names("region", {"Fibre"}); }),
      "-material_fibre_young differs in capitals from the option it means; write -material_Fibre_young");
}
