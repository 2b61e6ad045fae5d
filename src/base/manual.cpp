#include <sstream>

#include "names.hpp"
#include "slipscale/base/options.hpp"
#include "value.hpp"

namespace slipscale {
namespace {

constexpr std::size_t columns = 110;

/// The words of `text` in lines that begin with `indent` blanks, the first one with what `start` says.
std::string wrapped(const std::string& start, const std::string& text, std::size_t indent) {
  std::string result, line = start;
  bool fresh = true;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!fresh && line.size() + 1 + word.size() > columns) {
      result += line + "\n";
      line = std::string(indent, ' ');
      fresh = true;
    }
    line += (fresh ? "" : " ") + word;
    fresh = false;
  }
  return result + line + "\n";
}

std::string fallback_text(const Option& option) {
  if (option.fallback == required) return "required";
  if (option.fallback == absent || option.fallback.empty()) return "no default";
  return "default " + option.fallback;
}

std::string paragraph(const Option& option) {
  if (names::ignored(names::pattern(option.name)))
    return wrapped("  -" + option.name + "  ", "anything", 6) + wrapped("      ", option.help, 6);
  return wrapped("  -" + option.name + "  ", value::wanted(option) + "; " + fallback_text(option), 6) +
         wrapped("      ", option.help, 6);
}

std::string first_word(const std::string& name) { return name.substr(0, name.find('_')); }

}  // namespace

std::string manual(const std::string& program, const std::string& purpose, const Schema& schema) {
  std::string text = wrapped(program + ": ", purpose, 2) + "\n";
  text += "usage: " + program + " -options_file_yaml scene.yaml [-option value ...]\n";
  text += "       mpiexec -n 4 " + program + " -options_file_yaml scene.yaml [-option value ...]\n\n";
  text += wrapped(
      "",
      "Options may stand on the command line or in YAML files, where nested keys join with _: "
      "`friction: {coefficient: 0.3}` is `-friction_coefficient 0.3`. The command line wins over the "
      "files, a later file over an earlier one. Lists are flat: `-body_acceleration 0,-9.81`, in YAML "
      "`[0, -9.81]`. All quantities are in SI units.",
      0);
  text += wrapped(
      "",
      "An option that has no effect in its scene stops the run. Only what a later place overrules is set "
      "aside, with a note: a law on the command line, say, the constants of another law in the file.",
      0);
  text += wrapped(
      "",
      "PETSc's own options work too, such as -log_view (where the time went) and -options_view; those "
      "it reads at its start belong on the command line.",
      0);
  std::vector<std::string> groups;
  std::map<std::string, std::string> paragraphs;
  for (const Option& option : schema) {
    const std::string group = first_word(option.name);
    if (!paragraphs.contains(group)) groups.push_back(group);
    paragraphs[group] += paragraph(option);
  }
  for (const std::string& group : groups) text += "\n" + group + "\n" + paragraphs[group];
  return text;
}

}  // namespace slipscale
