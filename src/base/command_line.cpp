#include "command_line.hpp"

#include "slipscale/base/error.hpp"
#include "spelling.hpp"

namespace slipscale {
namespace {

/// An option's name, not a value: `-0.3`, `-.5` and `-inf` are values. PETSc's own rule decides.
bool is_option(const std::string& argument) {
  PetscBool valid = PETSC_FALSE;
  petsc(PetscOptionsValidKey(argument.c_str(), &valid));
  return valid;
}

/// PETSc reads `-history` as the name of a log file and starts writing to it.
void refuse_history(const std::string& argument, const std::string& program, const Schema& schema) {
  if (spelling::fold(argument) != "-history") return;
  for (const Option& option : schema) {
    if (option.name.starts_with("history_"))
      throw UserError("-history is not an option of " + program +
                      " but opens a log file of PETSc; did you mean -" + option.name + "?");
  }
}

void refuse_spelling(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  const std::string bare = argument.substr(argument.find_first_not_of('-'));
  if (equals != std::string::npos) {
    const std::string name = bare.substr(0, bare.find('=')), value = bare.substr(bare.find('=') + 1);
    throw UserError(argument + " is not understood; write -" + name + " " + value +
                    ", with a blank for the =");
  }
  if (argument.starts_with("--"))
    throw UserError(argument + " is not understood; write -" + bare + ", with one dash");
}

}  // namespace

CommandLine read_command_line(int argc, char** argv, const std::string& program, const Schema& schema) {
  CommandLine line;
  const std::vector<std::string> arguments(argv, argv + argc);
  if (!arguments.empty()) line.arguments.push_back(arguments[0]);
  for (std::size_t k = 1; k < arguments.size(); ++k) {
    const std::string& name = arguments[k];
    if (!is_option(name))
      throw UserError("'" + name +
                      "' belongs to no option; write -name value, and lists as a,b,c without blanks");
    const bool has_value = k + 1 < arguments.size() && !is_option(arguments[k + 1]);
    if (name == "-h" || name == "-help" || name == "--help") {
      line.help = true;
      k += has_value;
      continue;
    }
    if (name == "-version" || name == "--version") {
      line.version = true;
      continue;
    }
    refuse_spelling(name);
    refuse_history(name, program, schema);
    const std::string folded = spelling::fold(name);
    const bool file = folded == "-options_file" || folded == "-options_file_yaml";
    if (file && (!has_value || arguments[k + 1].empty()))
      throw UserError(name + " has no value; write the name of a file after it");
    // PETSc takes `-options_file scene.yaml` for YAML too.
    const bool scene = file && (folded == "-options_file_yaml" || arguments[k + 1].ends_with(".yaml") ||
                                arguments[k + 1].ends_with(".yml"));
    if (scene) {
      line.scene_files.push_back(arguments[++k]);
      continue;
    }
    line.arguments.push_back(name);
    if (has_value) line.arguments.push_back(arguments[++k]);
  }
  return line;
}

}  // namespace slipscale
