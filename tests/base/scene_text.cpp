// What a scene's YAML means: the same to us and to Python's yaml, or it is refused.
#include "scene_file.hpp"

#include "options_fixture.hpp"
#include "slipscale/base/plain_yaml.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;

namespace {

class SceneText : public OptionsTest {
 protected:
  static std::vector<Written> read(const std::string& text) { return read_scene_text("a.yaml", text, 1); }
  /// name -> value, "<none>" where there is none.
  static std::map<std::string, std::string> values(const std::string& text) {
    std::map<std::string, std::string> found;
    for (const Written& option : read(text)) found[option.name] = option.value.value_or("<none>");
    return found;
  }
  /// The sentence about a text as a file, or about its options; of a program whose mesh has one region.
  static std::string said(const std::string& text) {
    return sentence([&] {
      Options options("slide", schema(), read(text));
      options.know_names("region", {"no", "1", "matrix"});
      options.know_names("boundary", {"top"});
      options.refuse_unknown();
    });
  }
  static bool has(const std::string& text, const std::string& words) {
    const bool found = text.find(words) != std::string::npos;
    if (!found) ADD_FAILURE() << "'" << text << "' lacks '" << words << "'";
    return found;
  }
};

using Values = std::map<std::string, std::string>;

}  // namespace

TEST_F(SceneText, KeysJoinAndListsToo) {
  EXPECT_EQ(
      values("a: {b: {c: 1}}\nd:\n  - 1.5\n  - -2\ne: [x, y]\nf: 'a b'\ng:\nh: {}\nk: []\n"),
      (Values{{"a_b_c", "1"}, {"d", "1.5,-2"}, {"e", "x,y"}, {"f", "a b"}, {"g", "<none>"}, {"k", ""}}));
  EXPECT_EQ(values(""), Values{});
  EXPECT_EQ(values("# nothing\n"), Values{});
  EXPECT_EQ(values("--- {a: 1}\n...\n"), (Values{{"a", "1"}}));
}

TEST_F(SceneText, MergesAddWhatIsNotGiven) {
  EXPECT_EQ(values("$$base: &b {x: 1, y: 2}\na: {<<: *b, x: 3}\nc: *b\n"),
            (Values{{"a_x", "3"}, {"a_y", "2"}, {"c_x", "1"}, {"c_y", "2"}}));
  EXPECT_EQ(values("$$p: &p {x: 1}\n$$q: &q {x: 2, y: 2}\na: {<<: [*p, *q]}\n"),
            (Values{{"a_x", "1"}, {"a_y", "2"}}));
}

TEST_F(SceneText, NothingIsGivenTwice) {
  has(said("friction: {law: none}\nmesh_file: a\nfriction: {coefficient: 0.5}\n"),
      "a.yaml gives 'friction' twice near line 3 (friction: {coefficient: 0.5}); put what belongs to it "
      "under one key");
  has(said("friction:\n  law: none\n  law: coulomb\n"), "gives 'law' twice near line 3");
  has(said("friction: {law: none}\nfriction_law: none\n"),
      "friction_law is given twice, the second time in line 2");
  has(said("friction: {law: none}\nFriction_Law: none\n"), "Friction_Law is given twice");
}

TEST_F(SceneText, NumbersAreWhatTheyLookLike) {
  for (const char* good : {"5", "0.5", "1e-3", "1.0e-3", "+2", ".5", "5.", "'010'", "08"})
    EXPECT_EQ(said("friction_coefficient: " + std::string(good) + "\n"), "") << good;
  for (const auto& [bad, words] : std::map<std::string, std::string>{{"010", "a number in base 8"},
                                                                     {"0x1F", "a number in base 16"},
                                                                     {"0b11", "a number in base 2"},
                                                                     {"1:30", "a number in base 60"},
                                                                     {"1:30.5", "a number in base 60"},
                                                                     {"1_000", "a number without its _"},
                                                                     {"1_0.5", "a number without its _"},
                                                                     {".inf", "infinity"},
                                                                     {"2026-01-31", "a date"}}) {
    has(said("friction_coefficient: " + bad + "\n"), "-friction_coefficient is " + bad +
                                                         ", which YAML takes for " + words +
                                                         "; write a number >= 0 (ratio)");
    has(said("history_points: [0, " + bad + "]\n"), "is " + bad + ", which YAML takes for " + words);
    has(said("mesh_file: " + bad + "\n"), "which YAML takes for " + words + "; put it in quotes");
    EXPECT_EQ(said("mesh_file: '" + bad + "'\n"), "") << bad;
    EXPECT_EQ(said("run: {entry: " + bad + "}\n"), "") << bad;  // nobody reads it
  }
}

TEST_F(SceneText, FlagsAreNoNumbers) {
  has(said("friction_coefficient: yes\n"), "-friction_coefficient is 'yes', but it must be a number");
  has(said("history_points: [0, yes]\n"), "'yes' is no number");
}

TEST_F(SceneText, TextsArePrintedAsTheyAreWritten) {
  for (const char* good : {"a.msh", "12", "1.5", "-3.25", "0.001", "1e5", "2e", "none", "y", "a: b"}) {
    const std::string text = std::string(good) == "a: b" ? "'a: b'" : good;
    EXPECT_EQ(said("mesh_file: " + text + "\n"), "") << good;
  }
  for (const char* bad : {"1.50", "+3", "1.0e+5", "0.00001", "1.", "True", "off"})
    has(said("mesh_file: " + std::string(bad) + "\n"), "put it in quotes");
}

TEST_F(SceneText, FlagsAndWords) {
  for (const char* good : {"true", "no", "On", "FALSE", "1", "'yes'"})
    EXPECT_EQ(said("relocalize_correction: " + std::string(good) + "\n"), "") << good;
  has(said("relocalize_correction:\n"), "-relocalize_correction has no value");
  has(said("relocalize_correction: ~\n"), "-relocalize_correction has no value");
  has(said("friction_coefficient: null\n"), "-friction_coefficient has no value");
  has(said("friction_law: off\n"), "must be none or coulomb");
  EXPECT_EQ(said("time_step: auto\n"), "");
  has(said("time_step: 0100\n"), "a number in base 8");
}

TEST_F(SceneText, KeysAreTexts) {
  has(said("material: {no: {young: 1}}\n"),
      "has a key near line 1 (material: {no: {young: 1}}), 'no', that YAML takes "
      "for true or false; put it in quotes");
  EXPECT_EQ(said("material: {'no': {young: 1}}\n"), "");
  EXPECT_EQ(said("material: {1: {young: 1}}\n"), "");  // Python prints it as it stands
  has(said("material: {01: {young: 1}}\n"), "a number in base 8");
  has(said("material: {1.0: {young: 1}}\n"), "takes for a number");
  has(said("material: {~: {young: 1}}\n"), "takes for nothing at all");
  has(said("[a]: 1\n"), "has a key near line 1");
  has(said("1: {young: 3}\n"), "no option can begin with; names begin with a letter");
}

TEST_F(SceneText, WhatOptionsCannotExpressIsRefused) {
  has(said("a: [[1, 2], [3, 4]]\n"), "has a list inside a list near line 1");
  has(said("a:\n  - {b: 1}\n"), "has options inside a list near line 2");
  has(said("a: ['1,2', 3]\n"), "a comma inside an entry");
  has(said("a: 1\n---\nb: 2\n"), "more than one YAML document near line 2");
  has(said("a: !!str 5\n"), "has a tag near line 1");
  has(said("a: *b\n"), "refers to *b near line 1");
  has(said("prose\n"), "does not consist of options near line 1");
  has(said("- a\n"), "does not consist of options");
  has(said("log_view:\n"), "log_view is read when PETSc starts");
  has(said(std::string("a: 1\n\0b: 2\n", 12)), "a.yaml has a NUL byte near line 2");
  has(said("a: \"\\0\"\n"), "NUL byte");
  has(said("a: \xFF\n"), "is not text in UTF-8");
}

TEST_F(SceneText, BrokenTextsHaveAPlace) {
  has(said("a:\n  b: 0.5\n  c none\nd: {e: 4}\n"), "is not valid YAML near line 3 (c none)");
  has(said("a: {b: 0.5\nd: {e: 4}\n"), "is not valid YAML near line 1");
  has(said("a:\n\tb: 0.5\n"), "is not valid YAML near line 2");
  has(said("a: 1\nb: 'x\n"), "is not valid YAML near line 2");
}

/// Time and stack are bounded, whatever a text piles up.
TEST_F(SceneText, PilesAreRefused) {
  has(said("a: " + std::string(20000, '[') + std::string(20000, ']') + "\n"), "nested more than 50 levels");
  has(said(std::string(20000, '{') + "\n"), "nested more than 50 levels");
  std::string nested, chain = "$$a0: &a0 {x: 1}\n", merges = chain, words;
  for (int k = 0; k < 20000; ++k) nested += std::string(static_cast<std::size_t>(k % 100), ' ') + "a:\n";
  EXPECT_NE(said(nested), "");
  for (int k = 1; k < 20000; ++k) {
    const std::string name = "a" + std::to_string(k), last = "a" + std::to_string(k - 1);
    chain.append("$$" + name + ": &" + name + " {y: *" + last + "}\n");
    if (k < 24) merges.append("$$" + name + ": &" + name + " {<<: [*" + last + ", *" + last + "]}\n");
  }
  has(said(chain), "nested more than 50 levels");
  has(said(merges + "c: *a23\n"), "merges (<<) more than a million times");
  for (int k = 0; k < 300000; ++k) words += "name_" + std::to_string(k) + ": 12345.678\n";
  has(said(words + "a b\n"), "is not valid YAML near line 300001");
}

TEST(PlainYaml, WordsInCapitals) {
  for (const char* word : {"yes", "Yes", "YES", "off", "False"})
    EXPECT_EQ(plain_yaml(word), PlainYaml::flag) << word;
  for (const char* word : {"yEs", "y", "N", "tRUE", "null!", "", "nULL"})
    EXPECT_NE(plain_yaml(word), PlainYaml::flag) << word;
  EXPECT_EQ(plain_yaml("nULL"), PlainYaml::text);
  EXPECT_EQ(plain_yaml("Null"), PlainYaml::nothing);
}

TEST(OneLine, NothingBreaksIt) {
  EXPECT_EQ(one_line("a\nb\r\tc"), "a b  c");
  EXPECT_EQ(one_line("a\xE2\x80\xA8"
                     "b\xE2\x80\xA9"
                     "c\xC2\x85"
                     "d"),
            "a b c d");
  EXPECT_EQ(one_line("\x1B[2J\x7F"), "\\x1b[2J\\x7f");
  EXPECT_EQ(one_line("µ → …"), "µ → …");
}
