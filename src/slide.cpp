#include <memory>

#include "commit.hpp"
#include "scene_names.hpp"
#include "slipscale/base/log.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/dynamics/friction_notes.hpp"
#include "slipscale/dynamics/remarks.hpp"
#include "slipscale/dynamics/scene.hpp"
#include "slipscale/dynamics/sliding_body.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/record/checkpoints.hpp"
#include "slipscale/record/hints.hpp"
#include "slipscale/record/initial_file.hpp"
#include "slipscale/record/recorder.hpp"
#include "slipscale/solid/material.hpp"

using namespace slipscale;

namespace {

/// What may differ in a run that goes on: how long, how often it records, and what is checked by its content.
const std::vector<std::string> may_change{"restart",
                                          "time_end",
                                          "time_wall",
                                          "checkpoint_minutes",
                                          "checkpoint_every",
                                          "progress",
                                          "history_every",
                                          "history_interval",
                                          "contact_every",
                                          "contact_interval",
                                          "interfaces_every",
                                          "interfaces_interval",
                                          "fields_every",
                                          "fields_interval",
                                          "fields_times",
                                          "mesh_file",
                                          "mesh_partitioner",
                                          "material_file",
                                          "material_*_file",
                                          "stiffness_kernel",
                                          "stiffness_instructions"};

void print_scene(const Scene& scene, const InitialFile& initial) {
  if (!initial.description.empty()) print("initial state: " + initial.description + "\n");
  for (const BoundaryCondition& condition : scene.conditions)
    print("boundary " + condition.boundary + ": " + describe(condition) + "\n");
  if (scene.surface) print(describe(*scene.surface) + "; friction: " + describe(scene.friction) + "\n");
}

/// A signal that came during set-up ends the run while the folder is still as it was. Collective.
void stop_if_asked(MPI_Comm comm, const StopRequest& request) {
  int signal = request.signal();
  MPI_Allreduce(MPI_IN_PLACE, &signal, 1, MPI_INT, MPI_MAX, comm);
  if (signal != 0)
    throw Interruption(
        format("interrupted by {} before the first step; no file was touched, so give the same command again",
               signal_name(signal)));
}

std::unique_ptr<Restart> find_restart(MPI_Comm comm, const std::optional<std::string>& folder) {
  if (!folder) return nullptr;
  auto restart = std::make_unique<Restart>(comm, *folder);
  if (!restart->note().empty()) print_notes({restart->note()});
  print(format("going on with '{}' after step {}\n", *folder, restart->steps_done() - 1));
  return restart;
}

bool is_finished(const Restart& restart, const TimeStep& step) {
  const bool finished = restart.steps_done() > step.count;
  if (finished) restart.expect_files();
  if (finished)
    print(format("the run in '{}' is finished (t = {:g} s); a later -time_end would make it longer\n",
                 restart.folder(), static_cast<double>(step.count) * step.step));
  return finished;
}

void slide(Options& options) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  const StopRequest request;
  auto set_up = std::make_unique<LogStage>("Set-up");

  const Mesh mesh = read_mesh(comm, periodic_mesh_source(options));
  know_names(options, mesh);
  const auto materials = read_materials(options, mesh);
  Scene scene = read_scene(options, mesh);
  const RecordChoice record = read_record(options);
  const TimeChoice time = read_time(options);
  const Model::Storage storage = read_storage(options);
  const StiffnessKernel kernel = read_kernel(options);
  end_reading(options);
  const auto restart = find_restart(comm, record.restart);
  const InitialFile initial = read_initial_file(mesh, record.folder, scene.initial);
  if (restart) restart->check(mesh, materials, initial.checksum);
  const Model model(mesh, materials, storage, kernel);
  print_notes(mesh.notes);
  print(describe(mesh, descriptions(materials)));
  print_scene(scene, initial);
  print_notes(notes_on_friction(options, mesh, scene));

  const TimeStep step = restart ? restart->time_step(time.end) : choose_step(comm, model, scene, time);
  print(describe(step, model) + describe_kernel(comm, model));
  options.refuse_unknown();

  if (restart && is_finished(*restart, step)) return;

  SlidingBody body(comm, model, scene, step.step);
  if (record.contact_sums) body.keep_contact_sums();
  if (record.cell_damping()) body.keep_cell_damping();
  if (restart) {
    restart->read(body.state());
    body.resume();
  }
  print(describe_memory(body));
  print_notes(remarks_at_start(body));
  if (!restart) print_notes(hints_at_start(body, step, record));
  stop_if_asked(comm, request);
  Recorder recorder(body, record, step, restart.get());
  recorder.write_run(options);
  Checkpoints checkpoints(body, recorder, request,
                          scene_marks(options, mesh, materials, recorder.run(), initial.checksum),
                          record.checkpoint);
  print(recorder.forecast() + checkpoints.forecast());
  set_up.reset();

  const LogStage steps("Steps");
  for (long n = body.steps_done(); n <= step.count; ++n) {
    body.advance(recorder.observes(n));
    if (n == 0) print_notes(remarks_on_first_step(body));
    recorder.after_step(n);
    checkpoints.after_step(n);
  }
  print("\n" + recorder.finish());
  checkpoints.finish(step.count);
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(
      argc, argv,
      {"slide",
       "Explicit dynamics of a deformable block that is pressed on a rigid surface moving under it: "
       "beta2 time scheme, Lagrange multipliers for contact, regularised Coulomb friction.",
       periodic_mesh_schema() + material_schema() + scene_schema() + record_schema(),
       slide,
       commit,
       {},
       {},
       RestartRule{options_of_checkpoint, may_change}});
}
