#include "command_line.hpp"

#include <unistd.h>

#include <filesystem>

#include "names.hpp"
#include "slipscale/base/error.hpp"
#include "spelling.hpp"

namespace slipscale {
namespace {

/// An option's name, not a value: `-0.3`, `-.5` and `-inf` are values. PETSc's own rule decides, but for
/// formulas such as `-p0*x`: no name holds their signs.
bool is_option(const std::string& argument) {
  if (argument.find_first_of("*/+^(),") != std::string::npos && argument.find('=') == std::string::npos)
    return false;
  PetscBool valid = PETSC_FALSE;
  petsc(PetscOptionsValidKey(argument.c_str(), &valid));
  return valid;
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

/// By the rank that would write, so that all see the same. Collective where there is a file.
bool cannot_be_written(const std::string& file) {
  if (file.empty()) return false;
  const std::string folder = std::filesystem::path(file).parent_path().string();
  int fault = access(folder.empty() ? "." : folder.c_str(), W_OK) != 0;
  MPI_Bcast(&fault, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return fault != 0;
}

}  // namespace

CommandLine read_command_line(int argc, char** argv) {
  CommandLine line;
  const std::vector<std::string> arguments(argv, argv + argc);
  if (!arguments.empty()) line.program = arguments[0];
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
    const std::string folded = spelling::fold(name);
    const bool file = folded == "-options_file" || folded == "-options_file_yaml";
    if (file && (!has_value || arguments[k + 1].empty()))
      throw UserError(name + " has no value; write the name of a file after it");
    // PETSc takes `-options_file scene.yaml` for YAML too.
    const bool scene = file && (folded == "-options_file_yaml" || arguments[k + 1].ends_with(".yaml") ||
                                arguments[k + 1].ends_with(".yml"));
    if (file) {
      (scene ? line.scene_files : line.option_files).push_back(arguments[++k]);
      continue;
    }
    line.options.push_back({name.substr(1)});
    if (has_value) line.options.back().value = arguments[++k];
  }
  return line;
}

void check_petsc_values(const std::vector<Written>& options) {
  for (const Written& option : options) {
    std::string wanted = names::petsc_wants(option.name, option.value);
    if (wanted.empty() && cannot_be_written(names::petsc_file(option.name, option.value)))
      wanted = "a file in a folder that can be written to";
    if (!wanted.empty())
      throw UserError("-" + option.name + " is '" + option.value.value_or("") + "', but it must be " +
                      wanted + " (an option of PETSc" +
                      (option.origin.place.empty() ? "" : ", in " + option.origin.place) + ")");
  }
}

}  // namespace slipscale
