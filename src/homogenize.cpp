#include <sys/resource.h>

#include <chrono>

#include "slipscale/base/error.hpp"
#include "slipscale/base/log.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/record/homogenised.hpp"
#include "slipscale/record/localization_file.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/record/output_folder.hpp"

using namespace slipscale;

namespace {

Schema cell_schema() {
  return {
      {"cell_boundary", Kind::text, "", "periodic", range::one_of({"periodic", "kubc", "subc", "all"}),
       "periodic, linear displacement, uniform traction, or all three for comparison"},
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

std::vector<CellBoundary> boundaries(const Options& options) {
  const std::string text = options.text("cell_boundary");
  std::vector<CellBoundary> found;
  for (const CellBoundary each : {CellBoundary::periodic, CellBoundary::kubc, CellBoundary::subc})
    if (text == "all" || text == name(each)) found.push_back(each);
  return found;
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
  MPI_Comm_size(comm, &found.ranks);
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void homogenize(Options& options) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const auto start = std::chrono::steady_clock::now();
  const MeshSource source = mesh_source(options);
  const std::vector<CellBoundary> kinds = boundaries(options);
  const bool estimate_error = options.flag("cell_estimate_error");
  const OutputFolder folder(comm, options.text("output_folder"),
                            {"effective.yaml", "localization.h5", "localization.xdmf"});

  Homogenised found;
  for (const CellBoundary kind : kinds) {
    const Mesh mesh = mesh_for(comm, source, kind);
    std::vector<std::string> regions = mesh.region_names();
    regions.push_back("all");
    options.know_names("region", regions);
    const std::vector<Material> materials = read_materials(options, mesh.region_names());
    if (kind == kinds.front()) {
      options.refuse_unread();
      found.phases = phases(mesh, materials);
      found.cells = mesh.cells.total;
      found.nodes = mesh.nodes.total;
    }
    CellSolution solution = solve_cell(comm, mesh, materials, kind);
    if (kind == kinds.front()) {
      options.refuse_unknown();
      found.phase_means = phase_means(comm, mesh, solution);
      write_localization(comm, mesh, materials, solution, folder.path());
    }
    found.solutions.push_back(std::move(solution));
    if (estimate_error) {
      MeshSource finer = source;
      ++finer.refine;
      const Mesh refined = mesh_for(comm, finer, kind);
      found.refined.push_back(solve_cell(comm, refined, materials, kind).stiffness);
    }
  }
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
       mesh_schema() + material_schema() + cell_schema(), homogenize});
}
