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

PlacesOfPetsc::PlacesOfPetsc(bool nothing) {
  if (nothing) return;
  std::array<char, PETSC_MAX_PATH_LEN> home{};
  petsc(PetscGetHomeDirectory(home.data(), home.size()));
  std::array<char, PETSC_MAX_PATH_LEN> named{};
  PetscBool is_named = PETSC_FALSE;
  petsc(PetscOptionsGetString(nullptr, nullptr, "-options_file", named.data(), named.size(), &is_named));
  if (is_named) places_.emplace_back("'" + std::string(named.data()) + "'", from_file(named.data()));
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
