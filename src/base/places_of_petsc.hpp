#pragma once

#include <string>
#include <utility>
#include <vector>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// Where options stand that PETSc collects by itself when it starts: its variables and files.
class PlacesOfPetsc {
 public:
  /// Reads them again, each by itself, unless `nothing` is to be found. Collective.
  explicit PlacesOfPetsc(bool nothing);
  ~PlacesOfPetsc();
  PlacesOfPetsc(const PlacesOfPetsc&) = delete;
  PlacesOfPetsc& operator=(const PlacesOfPetsc&) = delete;

  /// "the variable PETSC_OPTIONS", "'.petscrc'"; empty when it is none of them.
  std::string of(const std::string& name) const;

 private:
  std::vector<std::pair<std::string, PetscOptions>> places_;  ///< the last word first
};

/// What stands in a file of PETSc's own format (`-options_file`). Collective.
std::vector<Written> options_of_petsc_file(const std::string& path);

}  // namespace slipscale
