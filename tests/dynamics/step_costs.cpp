#include <gtest/gtest.h>
#include <petsclog.h>

#include <cstdlib>
#include <new>

#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

// The step loop promises one halo exchange, no reduction and no allocation. All three are counted here:
// allocations by replacing the global operator new, collectives by MPI's profiling interface, exchanges by
// PETSc's event log.

namespace {

long allocations = 0, collectives = 0, gathers = 0;

PetscLogDouble scatters() {
  PetscLogEvent event = 0;
  petsc(PetscLogEventGetId("VecScatterBegin", &event));
  PetscStageLog log = nullptr;
  petsc(PetscLogGetStageLog(&log));
  int stage = 0;
  petsc(PetscStageLogGetCurrent(log, &stage));
  PetscEventPerfInfo info;
  petsc(PetscLogEventGetPerfInfo(stage, event, &info));
  return info.count;
}

}  // namespace

// Kept out of line: GCC warns of `free` where it sees only one of a pair of operators inlined.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {  // of sorting
  ++allocations;
  return std::malloc(size ? size : 1);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

// PETSc's headers count MPI calls with macros of the same names.
#undef MPI_Allreduce
#undef MPI_Reduce
#undef MPI_Bcast
#undef MPI_Gatherv
#undef MPI_Allgatherv
#undef MPI_Barrier

extern "C" {
int MPI_Allreduce(const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  ++collectives;
  return PMPI_Allreduce(in, out, n, type, op, comm);
}
int MPI_Reduce(const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm) {
  ++collectives;
  return PMPI_Reduce(in, out, n, type, op, root, comm);
}
int MPI_Bcast(void* data, int n, MPI_Datatype type, int root, MPI_Comm comm) {
  ++collectives;
  return PMPI_Bcast(data, n, type, root, comm);
}
int MPI_Gatherv(const void* in, int n, MPI_Datatype type, void* out, const int* counts, const int* starts,
                MPI_Datatype out_type, int root, MPI_Comm comm) {
  ++collectives;
  return PMPI_Gatherv(in, n, type, out, counts, starts, out_type, root, comm);
}
int MPI_Allgatherv(const void* in, int n, MPI_Datatype type, void* out, const int* counts, const int* starts,
                   MPI_Datatype out_type, MPI_Comm comm) {
  ++gathers;
  return PMPI_Allgatherv(in, n, type, out, counts, starts, out_type, comm);
}
int MPI_Barrier(MPI_Comm comm) {
  ++collectives;
  return PMPI_Barrier(comm);
}
}

namespace {

/// Costs of 100 steps of the scene. A scene with straight sides gathers once a step for each side of which
/// the rank holds nodes.
void expect_costs(const Scene& scene, const std::string& side, bool sums = false) {
  petsc(PetscLogDefaultBegin());
  Block block;
  block.nx = block.ny = 12;
  block.width = block.height = 5e-3;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 5e-9);
  if (sums) {
    body.keep_contact_sums();
    body.keep_cell_damping();
  }
  EXPECT_GT(collectives, 0) << "the counter counts nothing";
  for (int n = 0; n < 3; ++n) body.advance(false);

  const long new_before = allocations, collective_before = collectives;
  const long gathers_before = gathers;
  const PetscLogDouble scatters_before = scatters();
  constexpr int steps = 100;
  for (int n = 0; n < steps; ++n) body.advance(false);
  EXPECT_EQ(allocations - new_before, 0);
  EXPECT_EQ(collectives - collective_before, 0);
  EXPECT_EQ(scatters() - scatters_before, steps);
  const bool holds = !side.empty() && !mesh.find_boundary(side)->nodes.empty();
  EXPECT_EQ(gathers - gathers_before, holds ? steps : 0);
}

}  // namespace

TEST(StepCosts, OneHaloExchangeNoReductionNoAllocation) {
  Scene scene = scene_r();
  scene.beta2 = 0.6;
  scene.damping.mass = 10;
  expect_costs(scene, "");
}

TEST(StepCosts, SumsOverEveryStepAskForNoMore) {
  Scene scene = scene_r();
  scene.damping.mass = 10;
  expect_costs(scene, "", true);
}

TEST(StepCosts, AStraightSideGathersOnce) {
  Scene scene = scene_r();
  scene.conditions[0].displacement[1].reset();
  scene.conditions[0].straight = BoundaryCondition::Straight::rigid;
  scene.conditions[0].plate_force = -7e4;
  expect_costs(scene, "top");
}
