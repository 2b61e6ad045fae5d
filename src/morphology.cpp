// Links libgmsh, which is under the GNU General Public License (version 2 or later): so is this program as a
// whole when it is passed on in binary form. The rest of slipscale does not link it.
#include <filesystem>

#include "commit.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/files/folder_lock.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/morphology/compose.hpp"
#include "slipscale/morphology/picture.hpp"
#include "slipscale/morphology/report.hpp"
#include "slipscale/morphology/result_files.hpp"

using namespace slipscale;

namespace {

/// Sees before the work that there is a place for its result. Returns whether the folder is new.
bool make_folder(const std::string& folder) {
  if (const std::string fault = why_unwritable(folder); !fault.empty()) throw UserError(fault);
  std::error_code code;
  const bool is_new = std::filesystem::create_directories(folder, code);
  if (code) throw UserError("-output_folder '" + folder + "' cannot be created (" + code.message() + ")");
  return is_new;
}

void make(const Recipe& recipe, const Options& options, const std::string& folder) {
  const FolderLock lock(folder);
  constexpr double many = 1e5;  // take longer than people wait without a word
  if (const double cells = expected_cells(recipe); cells > many)
    print(format("some {:.2g} cells are drawn and meshed\n", cells));
  GmshModel gmsh;
  const Composed composed = compose(recipe, gmsh);
  ResultFiles files(folder);
  files.add("mesh.msh", [&](const std::string& path) { write_mesh(recipe, composed, gmsh, path); });
  files.add("morphology.png", [&](const std::string& path) { write_picture(composed.mesh, path); });
  files.add("morphology.yaml", [&](const std::string& path) {
    write_text(path, morphology_yaml(options.effective(), recipe, composed));
  });
  files.publish();
  print(describe(recipe, composed) + "mesh in " + folder + "/mesh.msh, picture in " + folder +
        "/morphology.png\n");
}

/// A new folder goes again when the recipe is refused.
void make_in_folder(const Recipe& recipe, const Options& options) {
  const std::string folder = options.text("output_folder");
  const bool is_new = make_folder(folder);
  try {
    make(recipe, options, folder);
  } catch (const UserError&) {
    std::error_code code;
    if (is_new) std::filesystem::remove(folder, code);
    throw;
  }
}

/// Drawing is serial: on several ranks the first one works, and all report its faults.
void morphology(Options& options) {
  const Recipe recipe = read_recipe(options);
  (void)options.text("output_folder");
  end_reading(options);
  options.refuse_unknown();
  std::string fault;
  try {
    if (is_root(PETSC_COMM_WORLD)) make_in_folder(recipe, options);
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
