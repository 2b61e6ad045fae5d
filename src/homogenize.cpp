#include <sys/resource.h>

#include <chrono>

#include "commit.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/log.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/homogenize/homogenised.hpp"
#include "slipscale/homogenize/localisation_file.hpp"
#include "slipscale/mesh/read.hpp"

using namespace slipscale;

namespace {

Schema cell_schema() {
  return {
      {"cell_boundary", Kind::text, "", "periodic", range::one_of({"periodic", "kubc", "subc", "all"}),
       "periodic, linear displacement, uniform traction, or on a periodic mesh all three for comparison"},
      {"cell_estimate_error",
       Kind::flag,
       "",
       "true",
       {},
       "solve once more on the uniformly refined mesh for an error bar; costs about five times the run"},
      {"output_folder",
       Kind::text,
       "",
       required,
       {},
       "gets effective.yaml, localization.h5 and localization.xdmf"},
      {"run_<entry>", Kind::text, "", absent, range::any, "what a file tells about a run; read by nobody"}};
}

struct Choice {
  MeshSource source;
  std::vector<CellBoundary> kinds;
  bool estimate_error;
  std::string folder;
};

std::vector<CellBoundary> boundaries(const Options& options) {
  const std::string text = options.text("cell_boundary");
  std::vector<CellBoundary> found;
  for (const CellBoundary each : {CellBoundary::periodic, CellBoundary::kubc, CellBoundary::subc})
    if (text == "all" || text == name(each)) found.push_back(each);
  return found;
}

Choice read_choice(const Options& options) {
  return {mesh_source(options), boundaries(options), options.flag("cell_estimate_error"),
          options.text("output_folder")};
}

/// A mesh for each kind of boundary: the torus, and the same block with its sides open.
Mesh mesh_for(MPI_Comm comm, MeshSource source, CellBoundary boundary) {
  source.cut = boundary != CellBoundary::periodic;
  return read_mesh(comm, source);
}

std::vector<Phase> phases(const Mesh& mesh, const std::vector<Material>& materials) {
  std::vector<Phase> found;
  for (std::size_t k = 0; k < mesh.regions.size(); ++k)
    found.push_back({mesh.regions[k].name, mesh.regions[k].area / mesh.area(), materials[k]});
  return found;
}

/// Largest memory of this process so far, bytes.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

void measure_costs(MPI_Comm comm, std::chrono::steady_clock::time_point start, Homogenised& found) {
  found.memory = peak_memory();
  MPI_Allreduce(MPI_IN_PLACE, &found.memory, 1, MPI_DOUBLE, MPI_SUM, comm);
  found.ranks = ranks_of(comm);
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Solves for each kind of boundary, for the first on its mesh `mesh`, and on the refined ones.
Homogenised solve(MPI_Comm comm, const Choice& choice, const Mesh& mesh,
                  const std::vector<Material>& materials, const Options& options) {
  Homogenised found;
  found.phases = phases(mesh, materials);
  found.cells = mesh.cells.total;
  found.nodes = mesh.nodes.total;
  MeshSource finer = choice.source;
  ++finer.refine;
  for (const CellBoundary kind : choice.kinds) {
    const bool is_first = kind == choice.kinds.front();
    found.solutions.push_back(is_first
                                  ? solve_cell(comm, mesh, materials, kind)
                                  : solve_cell(comm, mesh_for(comm, choice.source, kind), materials, kind));
    if (is_first) options.refuse_unknown();  // the solver has read its own
    if (choice.estimate_error)
      found.refined.push_back(solve_cell(comm, mesh_for(comm, finer, kind), materials, kind).stiffness);
  }
  found.phase_means = phase_means(comm, mesh, found.solutions.front());
  return found;
}

void homogenize(Options& options) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const auto start = std::chrono::steady_clock::now();
  const Choice choice = read_choice(options);
  refuse_unwritable(comm, choice.folder);
  const Mesh mesh = mesh_for(comm, choice.source, choice.kinds.front());
  std::vector<std::string> regions = mesh.region_names();
  regions.push_back("all");
  options.know_names("region", regions);
  const std::vector<Material> materials = read_materials(options, mesh.region_names());
  end_reading(options);

  Homogenised found = solve(comm, choice, mesh, materials, options);

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
       mesh_schema() + material_schema() + cell_schema(),
       homogenize,
       commit,
       {"cell_"}});
}
