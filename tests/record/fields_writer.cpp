#include <filesystem>

#include "analytic_fields.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/record/fields_file.hpp"

using namespace slipscale;

/// Writes one folder of fields for every kind of mesh below the folder it is given, for readers to try.
int main(int argc, char** argv) {
  if (PetscInitialize(&argc, &argv, nullptr, nullptr)) return 1;
  for (const auto& [name, block] : analytic::cases()) {
    const OutputFolder folder(PETSC_COMM_WORLD, std::string(argv[1]) + "/" + name);
    testing_support::write_block(block, folder.path("block.msh"));
    MeshSource source;
    source.file = folder.path("block.msh");
    const Mesh mesh = read_mesh(PETSC_COMM_WORLD, source);
    FieldsFile file(PETSC_COMM_WORLD, mesh, folder.path(), {});
    for (double t : {0.0, 0.1, 1.0 / 3}) {
      const auto f = analytic::fields(mesh, t);
      file.write(t, f.u.data(), f.v.data(), f.stress.data());
    }
    file.close();
  }
  return PetscFinalize() ? 1 : 0;
}
