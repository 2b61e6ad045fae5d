#pragma once

#include <petscsys.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "slipscale/base/formula.hpp"

namespace slipscale {

enum class Kind { real, integer, text, flag, reals };

/// The values an option may take. `text` is what messages and `-help` print.
struct Range {
  std::string text;
  bool (*accepts)(double value) = nullptr;  ///< numbers: the test, applied to each number of a list
  std::vector<std::string> words = {};      ///< texts: the words to choose from
  bool words_or_number = false;             ///< texts: a number that `accepts` allows will do as well
  std::string variables = {};               ///< numbers: of which of x, y, t a formula may be in their place
};

namespace range {
extern const Range any, positive, non_negative, at_least_one, unit;           // unit: 0 < x <= 1
Range one_of(std::vector<std::string> words);                                 // exactly one of the words
Range one_of_or_number(std::vector<std::string> words, const Range& number);  // `auto` or seconds, say
Range or_formula(Range range, std::string variables);  // in place of a number, see Options::quantity
}  // namespace range

/// Fallbacks that are not values.
inline constexpr const char* required = "(required)";  ///< asking for it when not given is the user's error
inline constexpr const char* absent = "(none)";        ///< the scene does not have it

/// One option, declared once: reading, checking, `-help` and `run.yaml` all come from this line.
struct Option {
  std::string name;  ///< without dash; `<region>` or `<boundary>` stands for a name of the mesh;
                     ///< `<entry>` for anything at all, which is neither read nor checked
  Kind kind;
  std::string unit;      ///< SI unit, "1" for a ratio, "" for texts and flags
  std::string fallback;  ///< the default as the user would type it, or `required`, or `absent`
  Range range;
  std::string help;  ///< one sentence
};

using Schema = std::vector<Option>;

Schema operator+(Schema left, const Schema& right);

/// The options of a schema that begin with `beginning`, placeholders filled in with `filling`: what a reader
/// of a group of options goes through, so that one declared later is not forgotten.
std::vector<std::string> names_in(const Schema& schema, const std::string& beginning = "",
                                  const std::string& filling = "");

/// The parameters of formulas.
Schema parameter_schema();

/// Where the user wrote an option. The later place has the last word: the scene files one after the other,
/// then the command line.
struct Origin {
  int order = 0;      ///< 0: before all of these, in PETSc's own files and variables
  std::string place;  ///< "scene.yaml"
};

/// One option as the user wrote it.
struct Written {
  std::string name;                       ///< without dash
  std::optional<std::string> value = {};  ///< none where nothing stands behind the option
  Origin origin = {};
  bool in_yaml = false;
  std::string doubt = {};  ///< of a YAML file: the word in its value that YAML takes for more than a text
};

/// Why options have no effect in a scene, in words that complete a sentence.
struct Idle {
  std::string why;                       ///< after "has no effect": "with -friction_law coulomb"
  std::string cure;                      ///< after "remove it, or": "give -friction_law regularized"
  std::vector<std::string> causes = {};  ///< the options that make it so, where they can be overruled
};

/// The options of one run: what command line, YAML files and defaults say, checked against a schema.
///
/// Every reader throws `UserError` with one sentence when the value is missing, is not of its kind or is out
/// of range. Names are given without dash and with the region or boundary filled in:
/// `real("material_matrix_young")`.
///
/// An option that is given either has an effect or stops the run: a reader asks only for what its scene has
/// and passes the rest to `refuse_idle`, and `refuse_unread` finds what everybody forgot. What a later place
/// makes idle is set aside instead, as a value that it repeats would be: a law on the command line overrules
/// the constants of another law in the file. An option set aside counts as not given.
///
/// An option that is declared and that no reader asks for or passes to `refuse_idle` is a mistake of the
/// programmer, which `refuse_unread` reports (`std::logic_error`) in every run, whether it is given or not.
///
/// All members are collective in effect: every rank holds the same options and throws the same error.
class Options {
 public:
  /// Takes what PETSc's database holds and nobody has read (it comes first) and then `written`, the last of
  /// which has the last word, and checks it against the schema as far as that is possible without a mesh.
  /// PETSc's database is limited to 512 options; `written` is not. `solvers` are the prefixes of PETSc's own
  /// solvers in this program, "cell_": their options are PETSc's to read.
  Options(std::string program, Schema schema, const std::vector<Written>& written = {},
          std::vector<std::string> solvers = {});

  double real(const std::string& name) const;
  std::optional<double> find_real(const std::string& name) const;
  PetscInt integer(const std::string& name) const;
  std::optional<PetscInt> find_integer(const std::string& name) const;
  std::string text(const std::string& name) const;
  std::optional<std::string> find_text(const std::string& name) const;
  bool flag(const std::string& name) const;
  std::vector<double> reals(const std::string& name) const;  ///< empty when absent
  bool given(const std::string& name) const;                 ///< on the command line or in a file

  /// What stands where a number or a formula may stand. A formula of constants alone is the number that it
  /// makes. Throws UserError for a formula with a fault, see Formula, or with a value out of range.
  Quantity quantity(const std::string& name) const;
  std::vector<Quantity> quantities(const std::string& name) const;  ///< of a list
  /// The value of a formula is of the option's range: the sentence that says it is not, or empty. For those
  /// who evaluate one.
  std::string outside(const std::string& name, const Quantity& quantity, double value) const;
  /// Numbers that formulas may name, beside the parameters that the user gave. Throws UserError for a
  /// parameter whose name is taken or is none. Before the first formula is read.
  void know_constants(const std::map<std::string, double>& constants);
  /// Takes the parameters of formulas as read, for a program that leaves the formulas aside.
  void pass_over_parameters() const;

  /// Every option that the user gave, declared or not, but none of PETSc's own; in their order.
  const std::vector<std::string>& typed() const { return typed_; }

  /// Tells which names may stand for a placeholder: `know_names("region", {"matrix", "inclusion", "all"})`.
  /// An option like `-material_martix_young` then stops the run with the nearest known name. Names that
  /// differ only in case are refused, because PETSc's database folds case.
  void know_names(const std::string& placeholder, const std::vector<std::string>& names);

  /// Options that have no effect in this scene. Throws UserError for one that is given, unless it is set
  /// aside because one of the causes comes from a later place.
  void refuse_idle(const std::vector<std::string>& names, const Idle& idle) const;

  /// Two options that say the same in two ways. The one of the later place counts and the other is set aside;
  /// from the same place they contradict one another: UserError.
  void refuse_both(const std::string& one, const std::string& other) const;

  /// Stops on any declared option that is given and that nobody has read, and on names that no placeholder
  /// takes. Call when the scene is read.
  void refuse_unread() const;

  /// What was set aside, and what PETSc collected by itself, one sentence each, for the user to see.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Stops on any option that neither the schema declares nor PETSc has used. Call when set-up is done.
  void refuse_unknown() const;

  /// Every option asked for so far with the value in effect, as the user would type it; sorted by name.
  const std::map<std::string, std::string>& effective() const { return effective_; }

 private:
  struct Match {
    const Option* option = nullptr;
    std::string filled;  ///< what stands for the placeholder
  };
  Match match(const std::string& name) const;
  const Written* find(const std::string& name) const;
  std::optional<std::string> value(const std::string& name) const;
  std::string needed(const std::string& name) const;
  Quantity quantity_of(const Option& option, const std::string& name, const std::string& text) const;
  std::vector<std::string> parameters() const;
  void take(const Written& entry);
  void tell_of(const std::vector<Written>& collected, const std::vector<Written>& written);
  void check(const Written& entry) const;
  bool is_petsc(const std::string& name) const;
  void refuse_if_unknown(const std::string& name, bool at_last) const;
  void refuse_forgotten() const;
  [[noreturn]] void refuse(const std::string& name, const std::string& sentence) const;
  Origin origin(const std::string& name) const;
  bool overruled(const std::string& name, const std::vector<std::string>& by, const std::string& why) const;

  std::string program_;
  Schema schema_;
  std::vector<std::string> solvers_;
  std::map<std::string, std::vector<std::string>> names_;  ///< placeholder -> what may stand for it
  std::map<std::string, Written> given_;                   ///< by name: the entry that has the last word
  std::vector<std::string> typed_;                         ///< every name in `given_`, in its order
  std::map<std::string, double> constants_;                ///< of formulas
  mutable std::set<std::string> touched_;                  ///< the names that some reader knows of
  mutable std::map<std::string, std::string> effective_;
  mutable std::set<std::string> aside_;
  mutable std::vector<std::string> notes_;
};

/// The manual: every option with unit, range, default and help, grouped by the first word of the name.
std::string manual(const std::string& program, const std::string& purpose, const Schema& schema);

/// The word of `known` nearest to `word` (edit distance, case folded); empty when none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace slipscale
