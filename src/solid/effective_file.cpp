#include "effective_file.hpp"

#include <petscsys.h>

#include <fstream>

#include "slipscale/base/error.hpp"
#include "slipscale/base/yaml_text.hpp"

namespace slipscale {
namespace {

/// A private PETSc options database, so that a material file cannot set options of the program.
class Database {
 public:
  Database() { petsc(PetscOptionsCreate(&options_)); }
  ~Database() { (void)PetscOptionsDestroy(&options_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  operator PetscOptions() const { return options_; }

 private:
  PetscOptions options_ = nullptr;
};

}  // namespace

EffectiveFile read_effective_file(const std::string& path, const std::string& option) {
  if (!std::ifstream(path))
    throw UserError("-" + option + ": cannot read '" + path +
                    "'; give the effective.yaml of a homogenised material");
  // Refuses what PETSc would take for something else, or take for ever.
  (void)read_yaml("-" + option + ": '" + path + "'", read_on_all("-" + option, path));
  Database database;
  if (PetscOptionsInsertFileYAML(PETSC_COMM_WORLD, database, path.c_str(), PETSC_TRUE))
    throw UserError("-" + option + ": '" + path + "' is not valid YAML (" + take_petsc_message() +
                    "); write it again");
  EffectiveFile file;
  file.stiffness.resize(7);
  PetscInt count = 7;
  PetscBool has_stiffness = PETSC_FALSE, has_density = PETSC_FALSE;
  const PetscErrorCode bad_list = PetscOptionsGetRealArray(database, nullptr, "-stiffness",
                                                           file.stiffness.data(), &count, &has_stiffness);
  const PetscErrorCode bad_density =
      PetscOptionsGetReal(database, nullptr, "-density", &file.density, &has_density);
  file.stiffness.resize(static_cast<std::size_t>(count));
  if (bad_list || bad_density || !has_stiffness || !has_density || !(file.density > 0))
    throw UserError(
        "-" + option + ": '" + path +
        "' must hold 'stiffness: [c11, c22, c12, c66, c16, c26]' in Pa and 'density:' > 0 in kg/m3");
  std::string doubt(4096, '\0');
  PetscBool has_doubt = PETSC_FALSE;
  petsc(PetscOptionsGetString(database, nullptr, "-doubt", doubt.data(), doubt.size(), &has_doubt));
  if (has_doubt) file.doubt = doubt.c_str();
  return file;
}

}  // namespace slipscale
