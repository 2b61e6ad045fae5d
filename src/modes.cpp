#include <sys/resource.h>

#include <cstdlib>
#include <optional>

#include "commit.hpp"
#include "scene_names.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/dynamics/formulas.hpp"
#include "slipscale/dynamics/friction_notes.hpp"
#include "slipscale/files/output_folder.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/modes/modes_choice.hpp"
#include "slipscale/modes/modes_file.hpp"
#include "slipscale/modes/sliding_modes.hpp"
#include "slipscale/record/record_choice.hpp"

using namespace slipscale;

namespace {

/// Options of a scene for `slide` that say nothing about steady sliding. They are taken, so that one scene
/// serves both programs, and named.
void tell_of_idle(const Options& options, const Mesh& mesh, bool scheme) {
  std::vector<std::string> names = names_in(record_schema());
  std::erase(names, "output_folder");
  for (const char* name :
       {"initial_velocity", "initial_rotation", "initial_sine_amplitude", "initial_sine_wavelength",
        "initial_file", "initial_time", "history_boundary", "surface_speed_ramp"})
    names.push_back(name);
  for (const std::string& boundary : mesh.boundary_names()) names.push_back("boundary_" + boundary + "_ramp");
  if (!scheme)
    for (const char* name : {"time_end", "time_step", "time_safety", "time_beta2"}) names.push_back(name);
  options.pass_over_parameters();  // of formulas among them
  std::string idle;
  for (const std::string& name : names) {
    if (!options.given(name)) continue;
    (void)options.find_text(name);
    idle += (idle.empty() ? "-" : ", -") + name;
  }
  if (!idle.empty()) print_notes({"no meaning in modes, which make no time steps: " + idle});
}

/// How the step is chosen at which the time scheme is looked at.
std::optional<TimeChoice> read_scheme_time(const Options& options, bool scheme) {
  if (!scheme) return std::nullopt;
  TimeChoice time;
  if (const std::string step = options.text("time_step"); step != "auto") {
    time.step = std::strtod(step.c_str(), nullptr);
    options.refuse_idle({"time_safety"}, {"with -time_step " + step, "give -time_step auto", {"time_step"}});
  } else {
    time.safety = options.real("time_safety");
  }
  if (options.given("time_end")) time.end = options.real("time_end");
  return time;
}

/// As `slide` chooses it.
std::optional<SchemeStep> scheme_step(MPI_Comm comm, const Model& model, const Scene& scene,
                                      std::optional<TimeChoice> time) {
  if (!time) return std::nullopt;
  constexpr double steps = 1000;
  if (time->end == 0)
    time->end = steps * stable_step(largest_frequency(comm, model).sharp, scene.beta2, scene.damping);
  return SchemeStep{choose_step(comm, model, scene, *time).step, scene.beta2};
}

void measure_costs(MPI_Comm comm, ModesReport& report) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  report.memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
  MPI_Allreduce(MPI_IN_PLACE, &report.memory, 1, MPI_DOUBLE, MPI_SUM, comm);
  report.seconds = seconds_since_start();
}

void modes(Options& options) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  ModesChoice choice = read_modes(options);
  refuse_unwritable(comm, choice.folder);
  const Mesh mesh = read_mesh(comm, periodic_mesh_source(options));
  know_names(options, mesh);
  const auto materials = read_materials(options, mesh);
  const Scene scene = read_sliding_scene(options, mesh);
  read_sweeps(options, scene, choice);
  const Model::Storage storage = read_storage(options);
  const StiffnessKernel kernel = read_kernel(options);
  const auto time = read_scheme_time(options, choice.scheme);
  tell_of_idle(options, mesh, choice.scheme);
  end_reading(options);
  const Model model(mesh, materials, storage, kernel);
  print_notes(mesh.notes);
  print(describe(mesh, descriptions(materials)));
  print_notes(notes_on_friction(options, mesh, scene));
  const auto step = scheme_step(comm, model, scene, time);

  const SteadySliding state = steady_sliding(comm, model, scene);
  print_notes(state.notes);
  auto notes = remarks_on_modes(comm, model, scene);
  ModesBasis basis = basis_of_real_modes(state, choice, reach_of_start(notes));
  options.refuse_unknown();
  ModesReport report = find_sliding_modes(basis, state, scene, choice, step);
  report.search.notes.insert(report.search.notes.begin(), notes.begin(), notes.end());
  for (const SweepChoice& sweep : choice.sweeps) {
    report.sweeps.push_back(
        sweep_modes(basis, state, scene, sweep, {choice.to, choice.count, choice.tolerance}));
    notes = report.sweeps.back().notes;
    report.search.notes.insert(report.search.notes.end(), notes.begin(), notes.end());
  }

  // Only now do the files of an older run give way.
  const OutputFolder folder(comm, choice.folder, {"modes.yaml", "modes.h5", "modes.xdmf"});
  measure_costs(comm, report);
  write_modes(comm, folder.path(), mesh, report, state, choice.shapes, choice.frames);
  folder.write_text("modes.yaml", modes_yaml(report, state, mesh, options.effective()));
  print_notes(report.search.notes);
  print(describe(report, state));
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(
      argc, argv,
      {"modes",
       "Growth and frequency of small perturbations of steady sliding, from the scene that slide reads: "
       "eigenvalues of the body whose closed nodes slip, with damping and the memory of friction.",
       periodic_mesh_schema() + material_schema() + scene_schema() + record_schema() + modes_schema(),
       modes,
       commit,
       {"modes_"}});
}
