#include "slipscale/dynamics/scene.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "slipscale/base/physical_range.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/dynamics/formulas.hpp"
#include "slipscale/mesh/boundary_cells.hpp"

namespace slipscale {
namespace {

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

const Boundary& known_boundary(const Mesh& mesh, const std::string& name, const char* option) {
  const Boundary* boundary = mesh.find_boundary(name);
  if (!boundary)
    throw UserError("-" + std::string(option) + ": the mesh has no boundary '" + name + "'; it has " +
                    (mesh.boundaries.empty() ? "none, add Physical Curve(…) to its geometry"
                                             : list(mesh.boundary_names())));
  if (boundary->interior)
    throw UserError("-" + std::string(option) + ": boundary '" + name +
                    "' lies inside the body (a periodic seam or an interface); choose an outer one");
  return *boundary;
}

/// A node whose y is prescribed is never a contact node.
void refuse_held_contact(const std::vector<BoundaryCondition>& conditions, const std::string& boundary) {
  for (const BoundaryCondition& condition : conditions)
    if (condition.boundary == boundary && (condition.displacement[1] || condition.is_straight()))
      throw UserError("-boundary_" + boundary +
                      "_y prescribes the motion of the boundary that -surface_boundary names, " +
                      "so that none of it could meet the surface; make it free, or name another boundary");
}

/// Whether an edge of the boundary belongs to each region. Collective.
std::vector<char> regions_at(const Mesh& mesh, const Boundary& boundary) {
  std::vector<char> touches(mesh.regions.size(), 0);
  for (const int cell : boundary_cells(mesh, boundary)) touches[mesh.cells.region[cell]] = 1;
  MPI_Allreduce(MPI_IN_PLACE, touches.data(), static_cast<int>(touches.size()), MPI_CHAR, MPI_MAX, mesh.comm);
  return touches;
}

void read_body_acceleration(const Options& options, const Mesh& mesh, Scene& scene) {
  const auto acceleration = options.quantities("body_acceleration");
  if (acceleration.size() != 2)
    throw UserError("-body_acceleration needs two numbers or formulas ax,ay in m/s2");
  std::vector<int> nodes(static_cast<std::size_t>(mesh.nodes.owned));
  std::iota(nodes.begin(), nodes.end(), 0);
  for (int axis = 0; axis < 2; ++axis) {
    check_at(options, "body_acceleration", acceleration[axis], mesh, nodes);
    scene.body_acceleration[axis] = acceleration[axis].number;
    scene.body_acceleration_formula[axis] = acceleration[axis].formula;
  }
  if (scene.acceleration().of_time() && scene.acceleration().of_place())
    throw UserError(
        "-body_acceleration varies with the place and with t, which would take a formula at every node in "
        "every step; make it vary with one of them");
}

}  // namespace

std::vector<std::string> unsteady_formulas(const Scene& scene) {
  std::vector<std::string> names;
  const auto name = [&](bool unsteady, const std::string& option) {
    if (unsteady) names.push_back(option);
  };
  const auto of_time = [](const SharedFormula& formula) { return formula && formula->of_time(); };
  for (const BoundaryCondition& condition : scene.conditions) {
    const std::string prefix = "boundary_" + condition.boundary + "_";
    name(condition.displacement_formula[0] != nullptr, prefix + "x");
    name(condition.displacement_formula[1] != nullptr, prefix + "y");
    name(of_time(condition.pressure_formula), prefix + "pressure");
    name(of_time(condition.shear_formula), prefix + "shear");
    name(condition.force_formula != nullptr, prefix + "force");
  }
  name(scene.acceleration().of_place() || scene.acceleration().of_time(), "body_acceleration");
  name(scene.surface && scene.surface->height_formula, "surface_height");
  name(scene.surface && scene.surface->speed_formula, "surface_speed");
  name(scene.friction.coefficient_formula != nullptr, "friction_coefficient");
  name(scene.friction.kinetic.formula != nullptr, "friction_kinetic");
  name(!scene.friction.phases.empty(), "friction_<region>_coefficient");
  return names;
}

Schema scene_schema() {
  const Schema own{
      {"body_acceleration", Kind::reals, "m/s2", "0,0", range::or_formula(range::physical, "xyt"),
       "acceleration of every part of the body, ax,ay (gravity); formulas either of the place or of time"},
      {"damping_mass", Kind::real, "1/s", "0", range::physical_non_negative,
       "Rayleigh damping proportional to mass, a"},
      {"damping_stiffness", Kind::real, "s", "0", range::physical_non_negative,
       "Rayleigh damping proportional to stiffness, b, lagged by one step"},
      {"time_step", Kind::text, "s", "auto", range::one_of_or_number({"auto"}, range::positive),
       "auto: safety times the stable step, at most the end; or seconds, refused above the stable step"},
      {"time_safety", Kind::real, "1", "0.9", range::unit, "part of the stable step that auto takes"},
      {"time_end", Kind::real, "s", required, range::positive, "simulated time at the end of the run"},
      {"time_beta2",
       Kind::real,
       "1",
       "0.5",
       {"in [0.5, 1]", [](double x) { return x >= 0.5 && x <= 1; }},
       "beta2 of the scheme: 0.5 is central difference, more dissipates at high frequency"},
      {"history_boundary", Kind::text, "", absent, range::any,
       "boundary where the load and the global friction are measured; `top` when the mesh has one"},
      {"stiffness_storage", Kind::text, "", "double", range::one_of({"double", "single"}),
       "precision in which the stiffness is stored; arithmetic is always double"},
      {"stiffness_kernel", Kind::text, "", "runs", range::one_of({"runs", "pairs"}),
       "runs: successive nodes whose rows repeat are summed together; pairs: every pair of nodes is visited, "
       "for comparison; the same bits"},
      {"stiffness_instructions", Kind::text, "", "auto", range::one_of({"auto", "base", "avx2", "avx512"}),
       "vector instructions of the inner loops: auto takes the widest that the processor has, the others are "
       "for comparison; the same bits"},
  };
  return own + parameter_schema() + boundary_schema() + initial_schema() + surface_schema() +
         friction_schema();
}

Scene read_scene(const Options& options, const Mesh& mesh) {
  Scene scene;
  scene.conditions = read_conditions(options, mesh);
  scene.initial = read_initial(options, mesh);
  read_body_acceleration(options, mesh, scene);
  scene.damping = {options.real("damping_mass"), options.real("damping_stiffness")};
  scene.beta2 = options.real("time_beta2");
  if (has_surface(options)) {
    scene.surface = read_surface(options);
    constexpr double aslant = 1e-6;  // rounding tilts an upright side by far less
    if (!(known_boundary(mesh, scene.surface->boundary, "surface_boundary").normal[1] < -aslant))
      throw UserError("-surface_boundary: boundary '" + scene.surface->boundary +
                      "' does not face down, where the rigid surface is; name the lower side of the body");
    refuse_held_contact(scene.conditions, scene.surface->boundary);
    const auto& nodes = mesh.find_boundary(scene.surface->boundary)->nodes;
    check_at(options, "surface_height", {scene.surface->height, scene.surface->height_formula}, mesh, nodes);
    check_at(options, "surface_speed", {scene.surface->speed, scene.surface->speed_formula}, mesh, nodes);
    scene.friction = read_friction(options, *scene.surface, mesh.region_names(),
                                   regions_at(mesh, *mesh.find_boundary(scene.surface->boundary)));
    check_at(options, "friction_coefficient", scene.friction.mu(), mesh, nodes);
    check_at(options, "friction_kinetic", scene.friction.kinetic, mesh, nodes);
    for (std::size_t r = 0; r < scene.friction.phases.size(); ++r) {
      const std::string prefix = "friction_" + mesh.regions[r].name + "_";
      const FrictionConstants& phase = scene.friction.phases[r];
      if (options.given(prefix + "coefficient"))
        check_at(options, prefix + "coefficient", phase.coefficient, mesh, nodes);
      if (options.given(prefix + "kinetic"))
        check_at(options, prefix + "kinetic", phase.kinetic, mesh, nodes);
    }
  } else {
    auto idle = names_in(surface_schema());
    for (const std::string& name : friction_options(mesh.region_names())) idle.push_back(name);
    std::erase(idle, "surface_boundary");
    options.refuse_idle(idle, without_surface);
  }
  if (const auto measured = options.find_text("history_boundary"))
    scene.measured = known_boundary(mesh, *measured, "history_boundary").name;
  else if (const Boundary* top = mesh.find_boundary("top"); top && !top->interior)
    scene.measured = "top";
  return scene;
}

TimeChoice read_time(const Options& options) {
  TimeChoice time;
  const std::string step = options.text("time_step");
  if (step == "auto") {
    time.safety = options.real("time_safety");
  } else {
    time.step = std::strtod(step.c_str(), nullptr);
    options.refuse_idle({"time_safety"}, {"with -time_step " + step, "give -time_step auto", {"time_step"}});
  }
  time.end = options.real("time_end");
  return time;
}

Model::Storage read_storage(const Options& options) {
  return options.text("stiffness_storage") == "single" ? Model::Storage::single : Model::Storage::full;
}

StiffnessKernel read_kernel(const Options& options) {
  StiffnessKernel kernel;
  kernel.runs = options.text("stiffness_kernel") == "runs";
  const std::string wanted = options.text("stiffness_instructions");
  if (wanted == "auto") return kernel;
  const Instructions widest = kernel.instructions;
  while (name_of(kernel.instructions) != wanted && kernel.instructions != Instructions::base)
    kernel.instructions = static_cast<Instructions>(static_cast<int>(kernel.instructions) - 1);
  if (name_of(kernel.instructions) != wanted)
    throw UserError("-stiffness_instructions is " + wanted + ", but this processor has no more than " +
                    name_of(widest) + "; choose that, a lesser kind or auto");
  return kernel;
}

}  // namespace slipscale
