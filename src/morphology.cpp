// Links libgmsh, which is under the GNU General Public License (version 2 or later): so is this program as a
// whole when it is passed on in binary form. The rest of slipscale does not link it.
#include <filesystem>
#include <fstream>

#include "commit.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/morphology/compose.hpp"
#include "slipscale/morphology/picture.hpp"
#include "slipscale/morphology/report.hpp"

using namespace slipscale;

namespace {

/// Sees before the work that there is a place for its result. Returns whether the folder is new.
bool make_folder(const std::string& folder) {
  std::error_code code;
  const bool is_new = std::filesystem::create_directories(folder, code);
  const std::string trial = folder + "/.morphology.partial";
  if (!std::ofstream(trial))
    throw UserError("-output_folder '" + folder + "' cannot be written to; name another");
  std::filesystem::remove(trial, code);
  return is_new;
}

Composed compose_for(const std::string& folder, const Recipe& recipe, GmshModel& gmsh) {
  const bool is_new = make_folder(folder);
  try {
    return compose(recipe, gmsh);
  } catch (const UserError&) {
    std::error_code code;
    if (is_new) std::filesystem::remove(folder, code);
    throw;
  }
}

/// Under its final name a file is always whole.
template <class Write>
void write_whole(const std::string& folder, const std::string& name, const Write& write) {
  const std::string partial = folder + "/.partial." + name;
  write(partial);
  std::filesystem::rename(partial, folder + "/" + name);
}

void make(const Recipe& recipe, const Options& options) {
  const std::string folder = options.text("output_folder");
  GmshModel gmsh;
  const Composed composed = compose_for(folder, recipe, gmsh);
  write_whole(folder, "mesh.msh", [&](const std::string& path) { gmsh.write(path); });
  write_whole(folder, "morphology.png", [&](const std::string& path) { write_picture(composed.mesh, path); });
  replace_text_file(folder + "/morphology.yaml", morphology_yaml(options.effective(), recipe, composed));
  print(describe(recipe, composed) + "mesh in " + folder + "/mesh.msh, picture in " + folder +
        "/morphology.png\n");
}

/// Drawing is serial: on several ranks the first one works, and all report its faults.
void morphology(Options& options) {
  const Recipe recipe = read_recipe(options);
  (void)options.text("output_folder");
  end_reading(options);
  options.refuse_unknown();
  std::string fault;
  try {
    if (is_root(PETSC_COMM_WORLD)) make(recipe, options);
  } catch (const UserError& error) {
    fault = error.what();
  }
  throw_together(PETSC_COMM_WORLD, fault);
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(
      argc, argv,
      {"morphology",
       "Draws a composite from a recipe and meshes it: inclusions at random or in arrays, laminates, "
       "pictures of real composites. Writes MSH 4.1 with named regions and sides.",
       recipe_schema(),
       morphology,
       commit,
       {},
       {"gmsh " + GmshModel::version()}});
}
