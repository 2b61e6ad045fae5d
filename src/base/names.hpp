#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

/// The grammar of option names: `material_<region>_young` is a prefix, a placeholder and a suffix.
namespace slipscale::names {

/// Known names by placeholder: `{"region", {"matrix", "inclusion"}}`.
using Known = std::map<std::string, std::vector<std::string>>;

struct Pattern {
  std::string prefix, placeholder, suffix;  ///< all of the name is prefix when there is no placeholder
};
Pattern pattern(const std::string& declared);

/// What stands for the placeholder in `name`; "" for an option without placeholder that is `name` itself.
std::optional<std::string> filling(const Pattern& pattern, const std::string& name);

/// `run_<entry>`: a place for information about a run, which nobody reads and nobody checks.
bool ignored(const Pattern& pattern);

/// PETSc's own options by first word: solvers and meshes, and those with one of the prefixes `solvers`. They
/// count as unknown until PETSc has read them.
bool petsc_object(const std::string& name, const std::vector<std::string>& solvers);

/// The file that such an option of PETSc would write when the program ends; empty where there is none.
std::string petsc_file(const std::string& name, const std::optional<std::string>& value);

/// PETSc's own options that it reads when it starts or ends (`log_view`), by full name.
bool petsc_system(const std::string& name);

/// What such an option must be, when PETSc would not understand the value; empty when it does.
std::string petsc_wants(const std::string& name, const std::optional<std::string>& value);

/// What the user may have meant.
struct Guess {
  std::string name;   ///< an option that exists, with dash; empty when nothing is near
  bool open = false;  ///< once a mesh tells more names, one of them may be nearer
};
Guess meant(const std::string& name, const Schema& schema, const Known& known);

}  // namespace slipscale::names
