// The product of what a recipe may choose, read as `morphology` reads it.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/morphology/recipe.hpp"

using namespace slipscale;

namespace {

using Typed = std::map<std::string, std::string>;

/// How a reading ended. A `std::logic_error`, the programmer's mistake, ends the test instead.
struct Reading {
  std::string refusal;  ///< empty: accepted
  Typed effective;
};

/// `places`: the later one has the last word.
Reading read(const std::vector<Typed>& places) {
  std::vector<Written> written;
  for (std::size_t k = 0; k < places.size(); ++k)
    for (const auto& [name, value] : places[k])
      written.push_back({name, value, {static_cast<int>(k + 1), format("{}.yaml", k + 1)}});
  try {
    Options options("morphology", recipe_schema(), written);
    (void)read_recipe(options);
    (void)options.text("output_folder");
    options.refuse_unread();
    return {"", options.effective()};
  } catch (const UserError& error) {
    return {error.what(), {}};
  }
}

std::string told(const Typed& scene) {
  std::string text;
  for (const auto& [name, value] : scene) text += format(" -{} {}", name, value);
  return text;
}

Typed operator+(Typed left, const Typed& right) {
  for (const auto& [name, value] : right) left[name] = value;
  return left;
}

const std::vector<Typed> inclusions{
    {{"shape", "disc"}},
    {{"shape", "ellipse"}, {"aspect", "2"}},
    {{"shape", "ellipse"}, {"aspect", "2"}, {"angle", "30"}},
    {{"shape", "rectangle"}, {"aspect", "2"}, {"rounding", "0.5"}},
};
const std::vector<Typed> placements{
    {{"arrangement", "random"}, {"fraction", "0.25"}, {"diameter", "1e-3"}},
    {{"arrangement", "random"},
     {"fraction", "0.25"},
     {"diameter", "1e-3"},
     {"diameter_deviation", "0.1"},
     {"diameter_distribution", "lognormal"},
     {"seed", "2"},
     {"gap", "1e-4"},
     {"clearance", "1e-4"},
     {"repair", "1e-4"}},
    {{"arrangement", "square"}, {"columns", "3"}, {"rows", "3"}, {"fraction", "0.25"}},
    {{"arrangement", "hexagonal"}, {"columns", "3"}, {"rows", "4"}, {"diameter", "5e-4"}},
};
const Typed families{{"arrangement", "random"},
                     {"families_large_shape", "disc"},
                     {"families_large_fraction", "0.15"},
                     {"families_large_diameter", "1e-3"},
                     {"families_small_shape", "rectangle"},
                     {"families_small_fraction", "0.1"},
                     {"families_small_diameter", "1e-3"},
                     {"families_small_diameter_deviation", "0.1"},
                     {"families_small_diameter_distribution", "uniform"},
                     {"families_small_aspect", "2"},
                     {"families_small_rounding", "0.5"},
                     {"families_small_angle_deviation", "any"}};
const Typed layers{{"shape", "laminate"}, {"fraction", "0.25"}, {"layer_period", "1e-3"}, {"angle", "90"}};
const Typed image{{"shape", "image"},      {"image_file", "grains.png"},
                  {"image_levels", "0.5"}, {"image_regions", "matrix,grain"},
                  {"image_pixel", "1e-4"}, {"image_median", "1"},
                  {"image_despeckle", "5"}};
const Typed output{{"output_folder", "out"}};

std::vector<Typed> meshes(bool has_interface) {
  const Typed block{{"block_width", "4e-3"}, {"block_height", "4e-3"}, {"size", "2e-4"}};
  std::vector<Typed> all{block + Typed{{"cell", "grid"}, {"worst_angle", "10"}}};
  for (const char* cell : {"triangle", "quadrilateral"}) {
    all.push_back(block + Typed{{"cell", cell}});
    Typed graded{{"cell", cell}, {"size_surface", "1e-4"}, {"size_growth", "0.1"}};
    if (!has_interface) graded["structured"] = "false";
    all.push_back(block + graded);
    if (has_interface)
      all.push_back(block + Typed{{"cell", cell}, {"size_interface", "1e-4"}, {"size_growth", "0.1"}});
    else
      all.push_back(block + Typed{{"cell", cell}, {"structured", "true"}});
  }
  return all;
}

/// Scenes that are complete and without an option that has no effect.
std::vector<Typed> scenes(const std::string& periodic) {
  const Typed common = output + Typed{{"periodic", periodic}};
  const Typed fitted{{"cell", "grid"}, {"size", "2e-4"}, {"worst_angle", "10"}};
  std::vector<Typed> all{common + image, common + image + fitted};
  for (const Typed& mesh : meshes(false)) all.push_back(common + mesh + Typed{{"shape", "none"}});
  for (const Typed& mesh : meshes(true)) {
    all.push_back(common + mesh + layers);
    all.push_back(common + mesh + families);
    for (const Typed& placement : placements)
      for (const Typed& inclusion : inclusions) all.push_back(common + mesh + placement + inclusion);
  }
  return all;
}

/// Every option that -help lists, with each word it may take and a number that most of them take.
std::vector<std::pair<std::string, std::string>> choices() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const std::string placeholder : {"large", "small"})
    for (const Option& option : recipe_schema()) {
      const std::string name = names_in({option}, "", placeholder).empty()
                                   ? "run_mesh"
                                   : names_in({option}, "", placeholder).front();
      if (name == option.name && placeholder == "small") continue;
      for (const std::string& word : option.range.words) all.emplace_back(name, word);
      if (option.kind == Kind::flag)
        for (const char* truth : {"true", "false"}) all.emplace_back(name, truth);
      else if (option.kind == Kind::integer || option.name.ends_with("aspect"))
        all.emplace_back(name, "4");
      else if (option.range.words.empty() || option.range.words_or_number)
        all.emplace_back(name, option.unit == "m" ? "1e-4" : "0.2");
    }
  return all;
}

TEST(RecipeChoices, OfEachSceneAreReadAgainFromWhatTheyLeave) {
  for (const char* periodic : {"none", "x", "xy"})
    for (const Typed& scene : scenes(periodic)) {
      const Reading first = read({scene});
      EXPECT_EQ(first.refusal, "") << told(scene);
      const Reading again = read({first.effective});
      EXPECT_EQ(again.refusal, "") << told(scene);
      EXPECT_EQ(again.effective, first.effective) << told(scene);
    }
}

/// Any one option on top is read, and then again from what is left, or is refused in a sentence.
TEST(RecipeChoices, TakeOrRefuseEveryOption) {
  for (const char* periodic : {"none", "xy"})
    for (const Typed& scene : scenes(periodic))
      for (const auto& [name, value] : choices()) {
        const Typed more = scene + Typed{{name, value}};
        Reading first;
        ASSERT_NO_THROW(first = read({more})) << told(more);
        if (!first.refusal.empty()) {
          EXPECT_EQ(first.refusal.front(), '-') << told(more);
          continue;
        }
        const Reading again = read({first.effective});
        EXPECT_EQ(again.refusal, "") << told(more);
        EXPECT_EQ(again.effective, first.effective) << told(more);
      }
}

/// A whole scene at a later place sets aside whatever it makes idle in the earlier one.
TEST(RecipeChoices, OfALaterPlaceHaveTheLastWord) {
  for (const Typed& earlier : scenes("x"))
    for (const Typed& later : scenes("xy")) {
      Reading both;
      ASSERT_NO_THROW(both = read({earlier, later})) << told(earlier) << "\nthen" << told(later);
      EXPECT_EQ(both.refusal, "") << told(earlier) << "\nthen" << told(later);
      for (const auto& [name, value] : later) EXPECT_EQ(both.effective[name], value) << told(earlier);
    }
}

/// And so does the one word of it that says what is drawn, or of which cells and how large.
TEST(RecipeChoices, OfALaterWordSetAsideWhatItMakesIdle) {
  for (const Typed& earlier : scenes("x")) {
    if (earlier.contains("image_file")) continue;  // has no block
    for (const Typed& word :
         {Typed{{"shape", "none"}}, Typed{{"shape", "none"}, {"cell", "grid"}},
          Typed{{"shape", "none"}, {"cell", "triangle"}, {"structured", "true"}}, Typed{{"size", "1e-4"}}}) {
      Reading both;
      ASSERT_NO_THROW(both = read({earlier, word})) << told(earlier) << "\nthen" << told(word);
      EXPECT_EQ(both.refusal, "") << told(earlier) << "\nthen" << told(word);
    }
  }
}

}  // namespace
