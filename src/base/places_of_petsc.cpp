#include "places_of_petsc.hpp"

#include <array>
#include <cstdlib>

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

PetscOptions from_variable(const char* variable) {
  PetscOptions database = nullptr;
  petsc(PetscOptionsCreate(&database));
  if (const char* text = std::getenv(variable))
    if (PetscOptionsInsertString(database, text)) (void)take_petsc_message();
  return database;
}

PetscOptions from_file(const std::string& path) {
  PetscOptions database = nullptr;
  petsc(PetscOptionsCreate(&database));
  if (PetscOptionsInsertFile(PETSC_COMM_WORLD, database, path.c_str(), PETSC_FALSE))
    (void)take_petsc_message();
  return database;
}

}  // namespace

std::vector<Written> options_of_petsc_file(const std::string& path) {
  std::vector<Written> options;
  PetscOptions database = from_file(path);
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  petsc(PetscOptionsLeftGet(database, &count, &names, &values));
  for (PetscInt k = 0; k < count; ++k) {
    options.push_back({names[k], std::nullopt, {0, "'" + path + "'"}});
    if (values[k]) options.back().value = values[k];
  }
  petsc(PetscOptionsLeftRestore(database, &count, &names, &values));
  petsc(PetscOptionsDestroy(&database));
  return options;
}

PlacesOfPetsc::PlacesOfPetsc(bool nothing) {
  if (nothing) return;
  std::array<char, PETSC_MAX_PATH_LEN> home{};
  petsc(PetscGetHomeDirectory(home.data(), home.size()));
  places_.emplace_back("the variable PETSC_OPTIONS", from_variable("PETSC_OPTIONS"));
  for (const std::string& file :
       {std::string("petscrc"), std::string(".petscrc"), std::string(home.data()) + "/.petscrc"})
    places_.emplace_back("'" + file + "'", from_file(file));
}

PlacesOfPetsc::~PlacesOfPetsc() {
  for (auto& [place, database] : places_) (void)PetscOptionsDestroy(&database);
}

std::string PlacesOfPetsc::of(const std::string& name) const {
  for (const auto& [place, database] : places_) {
    PetscBool found = PETSC_FALSE;
    const char* value = nullptr;
    petsc(PetscOptionsFindPair(database, nullptr, ("-" + name).c_str(), &value, &found));
    if (found) return place;
  }
  return "";
}

}  // namespace slipscale
