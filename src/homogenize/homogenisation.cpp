#include "slipscale/homogenize/homogenisation.hpp"

#include <algorithm>

#include "slipscale/base/error.hpp"
#include "slipscale/base/physical_range.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

std::vector<CellBoundary> boundaries(const std::string& text) {
  std::vector<CellBoundary> found;
  for (const CellBoundary each : {CellBoundary::periodic, CellBoundary::kubc, CellBoundary::subc})
    if (text == "all" || text == name(each)) found.push_back(each);
  return found;
}

Mesh mesh_for(MPI_Comm comm, MeshSource source, CellBoundary boundary) {
  source.cut = boundary != CellBoundary::periodic;
  return read_mesh(comm, source);
}

/// Reads again what was read before.
Mesh mesh_again(MPI_Comm comm, const MeshSource& source, CellBoundary boundary, const Mesh& first) {
  Mesh mesh = mesh_for(comm, source, boundary);
  if (mesh.checksum != first.checksum)
    throw UserError("mesh '" + mesh.file +
                    "' has changed since homogenize began to read it; run again when it is complete");
  return mesh;
}

/// A name that no region has.
std::string name_of_holes(const Mesh& mesh) {
  std::string name = "holes";
  while (std::ranges::any_of(mesh.regions, [&](const Region& region) { return region.name == name; }))
    name += "_";
  return name;
}

/// What the cell is made of, and what A is there on average.
void describe_phases(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials,
                     Homogenised& found) {
  const CellSolution& solution = found.solutions.front();
  for (std::size_t k = 0; k < mesh.regions.size(); ++k)
    found.phases.push_back({mesh.regions[k].name, mesh.regions[k].area / solution.area, materials[k]});
  found.phase_means = phase_means(comm, mesh, solution);
  if (solution.holes.count == 0) return;
  found.phases.push_back(
      {name_of_holes(mesh), solution.holes.area / solution.area, {Eigen::Matrix3d::Zero(), 0, "empty"}});
  found.phase_means.push_back(solution.holes.localisation);
}

}  // namespace

Schema homogenisation_schema() {
  return {
      {"cell_boundary", Kind::text, "", "periodic", range::one_of({"periodic", "kubc", "subc", "all"}),
       "periodic, linear displacement, uniform traction, or on a periodic mesh all three for comparison; the "
       "edges of holes are free"},
      {"cell_estimate_error",
       Kind::flag,
       "",
       "true",
       {},
       "solve once more on the uniformly refined mesh for an error bar; costs about five times the run"},
      {"friction_<region>_coefficient", Kind::real, "1", absent, range::physical_non_negative,
       "coefficient of friction of that phase; with those of all phases the report has that of the whole "
       "face"},
      {"output_folder",
       Kind::text,
       "",
       required,
       {},
       "gets effective.yaml, localization.h5 and localization.xdmf"},
      {"run_<entry>", Kind::text, "", absent, range::any, "what a file tells about a run; read by nobody"}};
}

HomogenisationChoice read_homogenisation(const Options& options) {
  return {mesh_source(options), boundaries(options.text("cell_boundary")),
          options.flag("cell_estimate_error"), options.text("output_folder")};
}

std::vector<double> read_coefficients(const Options& options, const std::vector<std::string>& regions) {
  std::vector<double> coefficients;
  std::string missing, given;
  for (const std::string& region : regions) {
    const std::string name = "friction_" + region + "_coefficient";
    if (const auto mu = options.find_real(name)) {
      coefficients.push_back(*mu);
      given = name;
    } else {
      missing = name;
    }
  }
  if (!given.empty() && !missing.empty())
    throw UserError("-" + given +
                    " is given, but the friction of the whole face needs that of every phase; give -" +
                    missing + " as well, or neither");
  return coefficients;
}

Mesh homogenisation_mesh(MPI_Comm comm, const HomogenisationChoice& choice) {
  return mesh_for(comm, choice.source, choice.boundaries.front());
}

Homogenised homogenise(MPI_Comm comm, const HomogenisationChoice& choice, const Mesh& mesh,
                       const std::vector<Material>& materials,
                       const std::function<void(const CellSolution&)>& after_first) {
  Homogenised found;
  found.cells = mesh.cells.total;
  found.nodes = mesh.nodes.total;
  found.mesh_checksum = mesh.checksum;
  MeshSource finer = choice.source;
  ++finer.refine;
  for (const CellBoundary boundary : choice.boundaries) {
    if (found.solutions.empty()) {
      found.solutions.push_back(solve_cell(comm, mesh, materials, boundary));
      after_first(found.solutions.front());
    } else {
      found.solutions.push_back(
          solve_cell(comm, mesh_again(comm, choice.source, boundary, mesh), materials, boundary));
    }
    if (choice.estimate_error)
      found.refined.push_back(
          solve_cell(comm, mesh_again(comm, finer, boundary, mesh), materials, boundary).stiffness);
  }
  describe_phases(comm, mesh, materials, found);
  return found;
}

}  // namespace slipscale
