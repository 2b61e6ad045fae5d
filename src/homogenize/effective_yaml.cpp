#include "slipscale/base/print.hpp"
#include "slipscale/files/yaml.hpp"
#include "slipscale/homogenize/homogenised.hpp"
#include "slipscale/version.hpp"

namespace slipscale {
namespace {

/// Numbers that are read back to 13 digits, in a spelling that YAML takes for numbers; 0 for -0.
std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + format("{:.12e}", value + 0.0);
  return "[" + text + "]";
}

std::string six(const Eigen::Matrix3d& c) {
  const Eigen::Matrix3d s = 0.5 * (c + c.transpose());
  return list({s(0, 0), s(1, 1), s(0, 1), s(2, 2), s(0, 2), s(1, 2)});
}

constexpr const char* six_names = "Pa, c11, c22, c12, c66, c16, c26";

/// One list for each row: PETSc reads no list of lists.
void write_matrix(Yaml& yaml, const std::string& key, const Eigen::Matrix3d& m, const std::string& comment) {
  const char* rows[] = {"_xx", "_yy", "_xy"};
  for (int i = 0; i < 3; ++i)
    yaml.line(key + rows[i], list({m(i, 0), m(i, 1), m(i, 2)}), i == 0 ? comment : "");
}

void write_phases(Yaml& yaml, const Homogenised& found) {
  yaml.begin("phases", found.solutions.front().holes.count > 0 ? "by region, and the holes" : "by region");
  for (std::size_t k = 0; k < found.phases.size(); ++k) {
    const Phase& phase = found.phases[k];
    yaml.begin(phase.region).exact("fraction", phase.fraction, "of the cell's area");
    yaml.text("material", phase.material.description);
    yaml.line("stiffness", six(phase.material.stiffness), six_names);
    yaml.exact("density", phase.material.density, "kg/m3");
    if (k < found.phase_means.size())
      write_matrix(yaml, "mean_localisation", found.phase_means[k],
                   "1, a row for each strain, a column for each load case");
    yaml.end();
  }
  yaml.end();
}

void write_cost(Yaml& yaml, const CellSolution& solution) {
  yaml.begin("cost").text("solver", solution.solver).integer("unknowns", solution.unknowns);
  std::vector<double> iterations, seconds, newton;
  std::string reasons;
  for (const CaseCost& cost : solution.cost) {
    newton.push_back(static_cast<double>(cost.newton_steps));
    iterations.push_back(static_cast<double>(cost.iterations));
    seconds.push_back(cost.seconds);
    reasons += (reasons.empty() ? "" : " ") + cost.converged;
  }
  yaml.numbers("newton_steps", newton, "of the load cases xx, yy, xy").numbers("iterations", iterations);
  yaml.text("converged", reasons)
      .number("set_up_seconds", solution.set_up_seconds, "matrix and preconditioner");
  yaml.numbers("solve_seconds", seconds).end();
}

void write_solution(Yaml& yaml, const Homogenised& found, std::size_t k) {
  const CellSolution& solution = found.solutions[k];
  yaml.begin(name(solution.boundary));
  write_matrix(yaml, "stiffness", solution.stiffness, "Pa, rows of C as found, not made symmetric");
  if (const auto error = discretisation_error(found, k)) {
    write_matrix(yaml, "discretisation_error", error->error,
                 "Pa, Richardson's estimate for order 2; without the error of the drawn polygons");
    write_matrix(yaml, "extrapolated_stiffness", error->extrapolated, "Pa, stiffness less that error");
  }
  yaml.number("symmetry_defect", symmetry_defect(solution.stiffness), "largest, over the largest entry");
  yaml.number("voigt_excess", excess(voigt_bound(found.phases), solution.stiffness),
              "smallest eigenvalue of Voigt's bound less C, over the largest of that bound");
  yaml.number("reuss_excess", excess(solution.stiffness, reuss_bound(found.phases)),
              "smallest eigenvalue of C less Reuss's bound, over the largest of C");
  yaml.number("hill_mandel_residual", hill_mandel_residual(solution));
  yaml.number("mean_localisation_defect", mean_localisation_defect(solution),
              "largest entry of the mean of A less I");
  write_cost(yaml, solution);
  yaml.end();
}

void write_constants(Yaml& yaml, const EngineeringConstants& e) {
  yaml.begin("engineering_constants", "of the solid above in plane strain");
  yaml.number("young_x", e.young_x, "Pa").number("young_y", e.young_y, "Pa");
  yaml.number("poisson_xy", e.poisson_xy).number("poisson_yx", e.poisson_yx);
  yaml.number("shear", e.shear, "Pa, along the axes").number("bulk", e.bulk, "Pa, plane bulk modulus");
  yaml.number("shear_least", e.shear_least, "Pa, over all directions")
      .number("shear_most", e.shear_most, "Pa");
  yaml.number("young", e.young, "Pa, of the nearest isotropic solid").number("poisson", e.poisson);
  yaml.number("anisotropy", e.anisotropy, "distance to that solid over the size of C").end();
}

void write_bounds(Yaml& yaml, const Homogenised& found) {
  yaml.begin("bounds");
  yaml.line("voigt", six(voigt_bound(found.phases)), six_names);
  yaml.line("reuss", six(reuss_bound(found.phases)), "");
  if (const auto bounds = hashin_shtrikman(found.phases)) {
    yaml.line("hashin_shtrikman_bulk", list({bounds->bulk_low, bounds->bulk_high}),
              "Pa, of plane bulk moduli");
    yaml.line("hashin_shtrikman_shear", list({bounds->shear_low, bounds->shear_high}),
              "Pa, of the mean of the two shear moduli");
  }
  yaml.end();
}

void write_friction(Yaml& yaml, const Homogenised& found) {
  const auto friction = friction_of_phases(found);
  if (!friction) return;
  yaml.number("friction_coefficient", friction->effective,
              "of the face in slow sliding, tan<arctan(beta mu)>/beta over the fractions of the phases");
  yaml.number("friction_mean", friction->mean, "mean of the phases' coefficients");
}

void write_waves(Yaml& yaml, const Material& material) {
  const WaveSpeeds x = wave_speeds(material, 1, 0), y = wave_speeds(material, 0, 1);
  yaml.numbers("wave_speeds_x", {x.fast, x.slow}, "m/s, of plane waves along x");
  yaml.numbers("wave_speeds_y", {y.fast, y.slow}, "m/s");
}

}  // namespace

std::string effective_yaml(const Homogenised& found, const std::map<std::string, std::string>& effective) {
  const Material material = effective_material(found);
  Yaml yaml;
  yaml.remark("The effective material; slide takes it with -material_file <this file>.");
  yaml.line("stiffness", six(material.stiffness), six_names);
  yaml.exact("density", material.density, "kg/m3");
  std::string doubt;
  for (const std::string& each : doubts(found)) doubt += (doubt.empty() ? "" : "; ") + each;
  if (!doubt.empty()) yaml.text("doubt", doubt);
  yaml.remark("how it was found; not read by slide");
  yaml.begin("homogenize").text("version", version);
  yaml.text("boundary", name(found.solutions.front().boundary), "whose stiffness stands above");
  yaml.text("mesh_checksum", format("fnv1a:{:016x}", found.mesh_checksum), "of the mesh file");
  yaml.exact("area", found.solutions.front().area, "m2, of the cell, holes included");
  yaml.integer("cells", found.cells).integer("nodes", found.nodes).integer("ranks", found.ranks);
  write_phases(yaml, found);
  for (std::size_t k = 0; k < found.solutions.size(); ++k) write_solution(yaml, found, k);
  write_constants(yaml, engineering_constants(material.stiffness));
  write_bounds(yaml, found);
  if (const auto identity = two_phase_residual(found))
    yaml.number("two_phase_identity", *identity, "residual of f (C2 - C1):<A>2 = C_eff - C1");
  write_waves(yaml, material);
  write_friction(yaml, found);
  yaml.number("memory", found.memory, "B, of all ranks").number("seconds", found.seconds, "in all");
  yaml.begin("options", "in effect");
  for (const auto& [option, value] : effective) yaml.text(option, value);
  return yaml.end().end().str();
}

}  // namespace slipscale
