#pragma once

#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// Where options stand that PETSc collects by itself when it starts: its variables and files.
class PlacesOfPetsc {
 public:
  /// Reads them again, each by itself. Throws UserError for words of a variable that belong to no option,
  /// which PETSc skips (in its files it refuses them). Collective.
  PlacesOfPetsc();

  /// "the variable PETSC_OPTIONS", "'.petscrc'"; empty when it is none of them.
  std::string of(const std::string& name) const;
  /// All of them with their origins, each name once, from the place that has the last word.
  const std::vector<Written>& all() const { return options_; }

 private:
  void take(PetscOptions database, const std::string& place);

  std::vector<Written> options_;
};

/// What stands in a file of PETSc's own format (`-options_file`). Collective.
std::vector<Written> options_of_petsc_file(const std::string& path);

}  // namespace slipscale
