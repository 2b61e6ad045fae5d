#include <sys/resource.h>

#include <chrono>

#include "commit.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/homogenize/homogenisation.hpp"
#include "slipscale/homogenize/localisation_file.hpp"

using namespace slipscale;

namespace {

using Clock = std::chrono::steady_clock;

void measure_costs(MPI_Comm comm, Clock::time_point start, Homogenised& found) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  found.memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
  MPI_Allreduce(MPI_IN_PLACE, &found.memory, 1, MPI_DOUBLE, MPI_SUM, comm);
  found.ranks = ranks_of(comm);
  found.seconds = std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<Material> read_phases(Options& options, const Mesh& mesh) {
  std::vector<std::string> regions = mesh.region_names();
  regions.push_back("all");
  options.know_names("region", regions);
  return read_materials(options, mesh.region_names());
}

void homogenize(Options& options) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const auto start = Clock::now();
  const HomogenisationChoice choice = read_homogenisation(options);
  refuse_unwritable(comm, choice.folder);
  const Mesh mesh = homogenisation_mesh(comm, choice);
  print_notes(mesh.notes);
  const std::vector<Material> materials = read_phases(options, mesh);
  const std::vector<double> coefficients = read_coefficients(options, mesh.region_names());
  end_reading(options);

  Homogenised found = homogenise(comm, choice, mesh, materials, [&](const CellSolution& first) {
    print_notes(first.notes);
    options.refuse_unknown();
  });

  found.coefficients = coefficients;

  // Only now do the files of an older run give way.
  const OutputFolder folder(comm, choice.folder, {"effective.yaml", "localization.h5", "localization.xdmf"});
  write_localisation(comm, mesh, materials, found.solutions.front(), folder.path());
  measure_costs(comm, start, found);
  folder.write_text("effective.yaml", effective_yaml(found, options.effective()));
  print(describe(found));
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(
      argc, argv,
      {"homogenize",
       "Effective stiffness and localisation tensors of a periodic cell or a whole block in plane "
       "strain, from three static load cases by SNES and KSP (prefix -cell_).",
       mesh_schema() + material_schema() + homogenisation_schema(),
       homogenize,
       commit,
       {"cell_"}});
}
