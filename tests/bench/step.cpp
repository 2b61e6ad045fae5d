// What a time step costs on one core, against PETSc's matrix products with the same stiffness and node order:
//   tests/bench/bench_step -nodes 4000,24000,145000 -repetitions 31 -shape triangles
//   tests/bench/bench_step -mesh block.msh              (any mesh with curves `bottom` and `top`)
//   tests/bench/bench_step -nodes 24000 -shape triangles -write block.msh    (the mesh, and nothing else)
// Shapes: triangles or quadrilaterals of a grid, or general triangles, of which no two are alike. Region
// `inclusion`, where a mesh has it, is three times as stiff.
// The variants take turns within one run, and every figure is a median, so that a busy machine disturbs all
// alike.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>

#include "../solid/assembled.hpp"
#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

struct Variant {
  std::string name;
  std::function<void()> run;
  std::vector<double> seconds = {};  ///< of one call, by repetition
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Processor time, which does not count when others have the core.
double seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double time_of(const std::function<void()>& action, int calls) {
  const double begin = seconds();
  for (int k = 0; k < calls; ++k) action();
  return (seconds() - begin) / calls;
}

/// A block under pressure that slides; everything moves, so no arithmetic meets zeros or denormal numbers.
Scene sliding_block(double stiffness_damping, bool uniform) {
  Scene scene = scene_r();
  scene.damping.stiffness = stiffness_damping;
  if (uniform) {  // a composite has no uniform state
    scene.initial.pressure = 15e6;
    scene.initial.shear = 7.5e6;
  }
  scene.initial.amplitude = 0.01;
  scene.initial.wavelength = 5e-3;
  return scene;
}

/// The same with formulas of time at the top and along the contact.
Scene following(Scene scene) {
  const auto formula = [](const std::string& text, const std::string& variables) {
    return std::make_shared<const Formula>(text, variables, Formula::Names{}, "a formula of the benchmark");
  };
  scene.conditions[0].displacement_formula[1] = formula("1 + 0.01*sin(1e6*t)*x", "xyt");
  scene.friction.coefficient_formula = formula("1 + 0.1*sin(1e6*t)*x", "xt");
  return scene;
}

/// The same with sides that let waves out.
Scene open_sides(Scene scene, const Mesh& mesh) {
  for (const char* side : {"left", "right"}) {
    if (!mesh.find_boundary(side)) continue;
    BoundaryCondition condition;
    condition.boundary = side;
    condition.absorbing = true;
    scene.conditions.push_back(condition);
  }
  return scene;
}

OwnedMat product(const Mesh& mesh, const std::vector<Material>& materials, MatType type) {
  if (std::string(type) != MATSEQSELL) return assembled_stiffness(PETSC_COMM_SELF, mesh, materials, type);
  OwnedMat matrix, from = assembled_stiffness(PETSC_COMM_SELF, mesh, materials, MATSEQAIJ);
  petsc(MatConvert(from, MATSEQSELL, MAT_INITIAL_MATRIX, matrix.put()));
  return matrix;
}

void measure(const Mesh& mesh, int repetitions) {
  std::vector<Material> materials;
  for (const Region& region : mesh.regions) {
    materials.push_back(scene_r_material());
    if (region.name == "inclusion") materials.back().stiffness *= 3;
  }
  const bool uniform = materials.size() == 1;
  const StiffnessKernel runs, pairs{false, runs.instructions}, base{true, Instructions::base};
  const Model model(mesh, materials, Model::Storage::full, runs),
      visited(mesh, materials, Model::Storage::full, pairs),
      plain(mesh, materials, Model::Storage::full, base),
      single(mesh, materials, Model::Storage::single, runs);
  const double limit =
      choose_step(PETSC_COMM_SELF, model, sliding_block(2e-9, uniform), {{}, 0.9, 1e-3}).step;
  SlidingBody undamped(PETSC_COMM_SELF, model, sliding_block(0, uniform), limit);
  SlidingBody undamped_pairs(PETSC_COMM_SELF, visited, sliding_block(0, uniform), limit);
  SlidingBody undamped_base(PETSC_COMM_SELF, plain, sliding_block(0, uniform), limit);
  SlidingBody follows(PETSC_COMM_SELF, model, following(sliding_block(0, uniform)), limit);
  SlidingBody open(PETSC_COMM_SELF, model, open_sides(sliding_block(0, uniform), mesh), limit);
  SlidingBody damped(PETSC_COMM_SELF, model, sliding_block(2e-9, uniform), limit);
  SlidingBody damped_single(PETSC_COMM_SELF, single, sliding_block(2e-9, uniform), limit);
  NodalVector u(PETSC_COMM_SELF, mesh.nodes, true), f(PETSC_COMM_SELF, mesh.nodes, true);
  for (int i = 0; i < mesh.nodes.owned; ++i) u.data()[i] = {std::sin(0.1 * i), std::cos(0.1 * i)};
  const OwnedMat baij = product(mesh, materials, MATSEQBAIJ);

  const auto multiply = [&](Mat matrix) { petsc(MatMult(matrix, u.vec(), f.vec())); };
  std::vector<Variant> variants{
      {"MATBAIJ product", [&] { multiply(baij); }},
      {"product", [&] { model.multiply(u.data(), f.data()); }},
      {"product, pairs", [&] { visited.multiply(u.data(), f.data()); }},
      {"step", [&] { undamped.advance(false); }},
      {"step, pairs", [&] { undamped_pairs.advance(false); }},
      {"step, base instructions", [&] { undamped_base.advance(false); }},
      {"step, formulas of time", [&] { follows.advance(false); }},
      {"step, open sides", [&] { open.advance(false); }},
      {"step, stiffness damping", [&] { damped.advance(false); }},
      {"the same, single", [&] { damped_single.advance(false); }},
  };
  OwnedMat aij, sell;
  if (mesh.nodes.owned < 30000) {  // for comparison; they take their memory
    aij = product(mesh, materials, MATSEQAIJ);
    sell = product(mesh, materials, MATSEQSELL);
    variants.push_back({"MATAIJ product", [&] { multiply(aij); }});
    variants.push_back({"MATSELL product", [&] { multiply(sell); }});
  }
  const int calls = std::max(2, static_cast<int>(5e5 / mesh.nodes.owned));
  for (int k = -1; k < repetitions; ++k)  // the first round warms up
    for (Variant& variant : variants) {
      const double duration = time_of(variant.run, calls);
      if (k >= 0) variant.seconds.push_back(duration);
    }

  const auto& stiffness = std::get<PairStiffness<double>>(model.stiffness);
  std::printf(
      "%d nodes, %d cells, %d repetitions, %s; %.1f %% of the nodes gathered, %.1f %% repeat; %.0f bytes a "
      "node\n",
      mesh.nodes.owned, mesh.cells.size(), repetitions, name_of(runs.instructions).c_str(),
      100.0 * stiffness.gathered() / mesh.nodes.owned, 100.0 * stiffness.repeating() / mesh.nodes.owned,
      static_cast<double>(stiffness.bytes()) / mesh.nodes.owned);
  for (const Variant& variant : variants) {
    std::vector<double> ratio;
    for (int k = 0; k < repetitions; ++k) ratio.push_back(variant.seconds[k] / variants[0].seconds[k]);
    const double least = *std::min_element(variant.seconds.begin(), variant.seconds.end());
    std::printf("  %-24s %7.2f ns per node (least %6.2f)   %5.3f x MATBAIJ\n", variant.name.c_str(),
                median(variant.seconds) / mesh.nodes.owned * 1e9, least / mesh.nodes.owned * 1e9,
                median(ratio));
  }
  std::fflush(stdout);
}

void write_mesh(PetscInt nodes, const std::string& shape, const std::string& path) {
  Block block;
  block.width = block.height = 5e-3;
  block.nx = block.ny = static_cast<int>(std::sqrt(static_cast<double>(nodes))) - 1;
  block.distortion = shape == "general" ? 0.2 : 0;
  block.shape = shape == "quadrilaterals" ? Shape::quadrilaterals : Shape::triangles;
  write_block(block, path);
}

Mesh mesh_with(PetscInt nodes, const std::string& shape) {
  const std::string path = scratch("bench.msh");
  write_mesh(nodes, shape, path);
  Mesh mesh = read_mesh(PETSC_COMM_SELF, {path});
  std::remove(path.c_str());
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  petsc(PetscInitialize(&argc, &argv, nullptr, nullptr));
  PetscInt nodes[16] = {4000, 24000, 145000}, count = 16, repetitions = 31;
  PetscBool given = PETSC_FALSE;
  char path[PETSC_MAX_PATH_LEN] = "", out[PETSC_MAX_PATH_LEN] = "", shape[64] = "general";
  PetscBool writes = PETSC_FALSE;
  petsc(PetscOptionsGetIntArray(nullptr, nullptr, "-nodes", nodes, &count, &given));
  if (!given) count = 3;
  petsc(PetscOptionsGetInt(nullptr, nullptr, "-repetitions", &repetitions, nullptr));
  petsc(PetscOptionsGetString(nullptr, nullptr, "-shape", shape, sizeof(shape), nullptr));
  petsc(PetscOptionsGetString(nullptr, nullptr, "-mesh", path, sizeof(path), &given));
  petsc(PetscOptionsGetString(nullptr, nullptr, "-write", out, sizeof(out), &writes));
  if (writes) write_mesh(nodes[0], shape, out);
  if (given) measure(read_mesh(PETSC_COMM_SELF, {path}), static_cast<int>(repetitions));
  for (PetscInt k = 0; !given && !writes && k < count; ++k)
    measure(mesh_with(nodes[k], shape), static_cast<int>(repetitions));
  petsc(PetscFinalize());
  return 0;
}
