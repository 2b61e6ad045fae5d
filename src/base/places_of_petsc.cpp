#include "places_of_petsc.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "spelling.hpp"

namespace slipscale {
namespace {

/// Of rank 0, as PETSc takes it; empty where it is not set.
std::string variable_on_all(const char* variable) {
  const char* found = is_root(PETSC_COMM_WORLD) ? std::getenv(variable) : nullptr;
  std::string text = found ? found : "";
  auto size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, PETSC_COMM_WORLD);
  return text;
}

void refuse_stray_words(const std::string& text, const std::string& place) {
  std::istringstream words(text);
  bool may_be_value = false;
  for (std::string word; words >> word;) {
    PetscBool is_option = PETSC_FALSE;
    petsc(PetscOptionsValidKey(word.c_str(), &is_option));
    if (!is_option && !may_be_value)
      throw UserError("'" + word + "' in " + place +
                      " belongs to no option; write -name value there, and lists as a,b,c without blanks");
    may_be_value = is_option;
  }
}

PetscOptions from_variable(const std::string& text) {
  PetscOptions database = nullptr;
  petsc(PetscOptionsCreate(&database));
  if (PetscOptionsInsertString(database, text.c_str())) (void)take_petsc_message();
  return database;
}

PetscOptions from_yaml_variable(const std::string& text) {
  PetscOptions database = nullptr;
  petsc(PetscOptionsCreate(&database));
  if (!text.empty() && PetscOptionsInsertStringYAML(database, text.c_str())) (void)take_petsc_message();
  return database;
}

PetscOptions from_file(const std::string& path) {
  PetscOptions database = nullptr;
  petsc(PetscOptionsCreate(&database));
  if (PetscOptionsInsertFile(PETSC_COMM_WORLD, database, path.c_str(), PETSC_FALSE))
    (void)take_petsc_message();
  return database;
}

/// Of a database that nobody has asked yet.
std::vector<Written> all_of(PetscOptions database, const std::string& place) {
  std::vector<Written> options;
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  petsc(PetscOptionsLeftGet(database, &count, &names, &values));
  for (PetscInt k = 0; k < count; ++k) {
    options.push_back({names[k], std::nullopt, {0, place}});
    if (values[k]) options.back().value = values[k];
  }
  petsc(PetscOptionsLeftRestore(database, &count, &names, &values));
  return options;
}

}  // namespace

std::vector<Written> options_of_petsc_file(const std::string& path) {
  PetscOptions database = from_file(path);
  std::vector<Written> options = all_of(database, "'" + path + "'");
  petsc(PetscOptionsDestroy(&database));
  return options;
}

PlacesOfPetsc::PlacesOfPetsc() {
  const std::string text = variable_on_all("PETSC_OPTIONS"), yaml = variable_on_all("PETSC_OPTIONS_YAML"),
                    place = "the variable PETSC_OPTIONS";
  refuse_stray_words(text, place);
  take(from_yaml_variable(yaml), place + "_YAML");
  take(from_variable(text), place);
  PetscBool skip = PETSC_FALSE;
  petsc(PetscOptionsGetBool(nullptr, nullptr, "-skip_petscrc", &skip, nullptr));
  if (skip) return;
  std::array<char, PETSC_MAX_PATH_LEN> home{};
  petsc(PetscGetHomeDirectory(home.data(), home.size()));
  for (const std::string& file :
       {std::string("petscrc"), std::string(".petscrc"), std::string(home.data()) + "/.petscrc"})
    take(from_file(file), "'" + file + "'");
}

void PlacesOfPetsc::take(PetscOptions database, const std::string& place) {
  for (const Written& option : all_of(database, place))
    if (of(option.name).empty()) options_.push_back(option);
  petsc(PetscOptionsDestroy(&database));
}

std::string PlacesOfPetsc::of(const std::string& name) const {
  const auto found = std::ranges::find_if(
      options_, [&](const Written& option) { return spelling::fold(option.name) == spelling::fold(name); });
  return found == options_.end() ? "" : found->origin.place;
}

}  // namespace slipscale
