#include <memory>

#include "commit.hpp"
#include "slipscale/base/log.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/dynamics/remarks.hpp"
#include "slipscale/dynamics/scene.hpp"
#include "slipscale/dynamics/sliding_body.hpp"
#include "slipscale/mesh/read.hpp"
#include "slipscale/record/recorder.hpp"
#include "slipscale/solid/material.hpp"

using namespace slipscale;

namespace {

/// The names that options may carry: those of the mesh, and `all` for every region that has no material of
/// its own.
void know_names(Options& options, const Mesh& mesh) {
  auto regions = mesh.region_names();
  regions.push_back("all");
  options.know_names("region", regions);
  options.know_names("boundary", mesh.boundary_names());
}

std::vector<std::string> descriptions(const std::vector<Material>& materials) {
  std::vector<std::string> texts;
  for (const Material& material : materials) texts.push_back(material.description);
  return texts;
}

void print_scene(const Scene& scene) {
  for (const BoundaryCondition& condition : scene.conditions)
    print("boundary " + condition.boundary + ": " + describe(condition) + "\n");
  if (scene.surface)
    print(format("surface below {}: height {:g} m, speed {:g} m/s; friction: ", scene.surface->boundary,
                 scene.surface->height, scene.surface->speed) +
          describe(scene.friction) + "\n");
}

void slide(Options& options) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  auto set_up = std::make_unique<LogStage>("Set-up");

  const Mesh mesh = read_mesh(comm, periodic_mesh_source(options));
  know_names(options, mesh);
  const auto materials = read_materials(options, mesh.region_names());
  const Scene scene = read_scene(options, mesh);
  const RecordChoice record = read_record(options);
  const TimeChoice time = read_time(options);
  const Model::Storage storage = read_storage(options);
  const StiffnessKernel kernel = read_kernel(options);
  end_reading(options);
  const Model model(mesh, materials, storage, kernel);
  print(describe(mesh, descriptions(materials)));
  print_scene(scene);

  const TimeStep step = choose_step(comm, model, scene, time);
  print(describe(step, model) + describe_kernel(comm, model));
  options.refuse_unknown();

  SlidingBody body(comm, model, scene, step.step);
  for (const std::string& remark : remarks_at_start(body)) print("note: " + remark + "\n");
  Recorder recorder(body, record, step);
  recorder.write_run(options);
  print(recorder.forecast());
  set_up.reset();

  const LogStage steps("Steps");
  for (long n = 0; n <= step.count; ++n) {
    body.advance(recorder.due(n));
    recorder.after_step(n);
  }
  print("\n" + recorder.finish());
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(
      argc, argv,
      {"slide",
       "Explicit dynamics of a deformable block that is pressed on a rigid surface moving under it: "
       "beta2 time scheme, Lagrange multipliers for contact, regularised Coulomb friction.",
       periodic_mesh_schema() + material_schema() + scene_schema() + record_schema(), slide, commit});
}
