#include "slipscale/files/yaml.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <cmath>
#include <cstdlib>

using namespace slipscale;

namespace {

/// What PETSc makes of a YAML text.
class Scene {
 public:
  explicit Scene(const std::string& text) {
    EXPECT_EQ(PetscOptionsCreate(&options_), 0);
    EXPECT_EQ(PetscOptionsInsertStringYAML(options_, text.c_str()), 0) << text;
  }
  ~Scene() { (void)PetscOptionsDestroy(&options_); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  std::string value(const std::string& name) const {
    char text[1000] = "";
    PetscBool found = PETSC_FALSE;
    EXPECT_EQ(PetscOptionsGetString(options_, nullptr, ("-" + name).c_str(), text, sizeof text, &found), 0);
    return found ? text : "(not there)";
  }

 private:
  PetscOptions options_ = nullptr;
};

}  // namespace

/// YAML 1.1, Python's, takes 30e9 and 1e-5 for texts.
TEST(RunYaml, SpellsNumbersSoThatYamlSeesNumbers) {
  const std::string text =
      run_yaml({{"a", "30e9"}, {"b", "1e-5"}, {"c", "2.5E3"}, {"d", "7"}, {"e", "1e5x"}}, [](Yaml&) {});
  for (const char* line : {"a: 30.0e+9", "b: 1.0e-5", "c: 2.5e+3", "d: 7", "e: 1e5x"})
    EXPECT_NE(text.find(line), std::string::npos) << line << " is not in\n" << text;
}

TEST(RunYaml, IsASceneAgain) {
  const std::map<std::string, std::string> options = {
      {"boundary_top_pressure", "1.0e+6"},
      {"friction_coefficient", "0.3"},
      {"friction_law", "none"},
      {"history_points", "0.1,0.2,0.3,0.4"},
      {"material_fibre_file", "results: second/a #1/effective.yaml"},
      {"material_glass fibre_young", "70e9"},
      {"mesh_file", "/a/path with blanks/block.msh"},
      {"output_folder", "'quoted' \"twice\" \\ back"},
      {"progress", ""},
      {"surface_speed", "-2"},
      {"verbose", "true"},
  };
  const Scene scene(
      run_yaml(options, [](Yaml& yaml) { yaml.text("version", "0.1.0").exact("stable_step", 1.5e-9, "s"); }));
  for (const auto& [name, value] : options) {
    if (name.find(' ') == std::string::npos && !value.empty()) {
      EXPECT_EQ(scene.value(name), value);
    }
  }
  EXPECT_EQ(scene.value("run_version"), "0.1.0");
  EXPECT_EQ(scene.value("run_stable_step"), "1.5e-09");
}

TEST(Yaml, NumbersAreReadBackAsTheyWere) {
  for (double x : {0.1, 1.0 / 3, 1e-5, -2.5e-300, 6.02214076e23, 1e22, 0.0, 5e-324}) {
    const std::string text = Yaml().exact("x", x).str();
    EXPECT_EQ(std::strtod(Scene(text).value("x").c_str(), nullptr), x) << text;
  }
}

TEST(Yaml, NumbersAreNumbersForEveryReader) {
  EXPECT_EQ(Yaml().exact("x", 1e-5).str(), "x: 1.0e-05\n");  // YAML 1.1 takes 1e-05 for a text
  EXPECT_EQ(Yaml().number("x", 1.0 / 3, "Pa").str(), "x: 0.333333  # Pa\n");
  EXPECT_EQ(Yaml().number("x", 1e-7).str(), "x: 1.0e-07\n");
  EXPECT_EQ(Yaml().exact("x", std::nan("")).str(), "x: .nan\n");
  EXPECT_EQ(Yaml().exact("x", -INFINITY).str(), "x: -.inf\n");
  EXPECT_EQ(Yaml().integer("x", 12345678901).str(), "x: 12345678901\n");
}

TEST(Yaml, NestsAndLists) {
  Yaml yaml;
  yaml.remark("a run").begin("spectrum", "of the friction").numbers("peaks", {1500, 2.5e9}, "Hz").end();
  yaml.text("verdict", "sound: yes").text("cracks", "#none");
  EXPECT_EQ(yaml.str(),
            "# a run\nspectrum:  # of the friction\n  peaks: [1500, 2.5e+09]  # Hz\n"
            "verdict: \"sound: yes\"\ncracks: \"#none\"\n");
}
