#include "extremes_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale::testing_support {
namespace {

double over_ranks(double value, MPI_Op operation) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, operation, PETSC_COMM_WORLD);
  return value;
}

/// Contact after one step; `peak` [contact nodes] is the largest pressure since a node closed.
void look_at_contact(const SlidingBody& body, std::vector<double>& peak, Watched& seen) {
  const ContactNodes& contact = body.contact();
  const FrictionChoice& friction = body.scene().friction;
  const bool remembers = friction.law == FrictionChoice::Law::regularized;
  for (int k = 0; k < contact.size(); ++k) {
    const double p = contact.pressure[k], traction = std::abs(contact.traction[k]);
    peak[k] = p > 0 && remembers ? std::max(peak[k], p) : p;
    const double gap = contact.clearance[k] + body.next_displacement()[contact.node[k]][1];
    seen.penetration = std::max(seen.penetration, -gap);
    seen.suction = std::max(seen.suction, -p);
    seen.traction = std::max(seen.traction, traction);
    const double strength = friction.coefficient * peak[k];
    if (traction > strength) seen.excess = std::max(seen.excess, strength > 0 ? traction / strength - 1 : 1);
    const int slot = contact.slot[k];
    const double slip = body.surface_travel() - (body.next_displacement()[contact.node[k]][0] -
                                                 body.boundary_nodes().displacement[slot][0]);
    if (contact.traction[k] * slip < 0) seen.against = std::max(seen.against, std::abs(slip));
    seen.drag += contact.force[k][0];
    seen.load += contact.force[k][1];
  }
}

void look_at_energy(const SlidingBody& body, Watched& seen) {
  const Energy energy = body.energy();
  if (energy.flowed > 0) {
    seen.residual = std::max(seen.residual, std::abs(energy.residual) / energy.flowed);
    seen.heat = energy.friction_heat / energy.flowed;
  }
  if (!std::isfinite(energy.residual)) seen.residual = INFINITY;
}

double largest_displacement(const SlidingBody& body) {
  double largest = 0;
  for (int i = 0; i < body.model().mesh.nodes.owned; ++i)
    for (const double u : body.next_displacement()[i]) largest = std::max(largest, std::abs(u));
  return largest;
}

}  // namespace

bool Watched::sound() const {
  constexpr double rounding = 1e-14;
  return residual < 1e-12 && penetration <= rounding && suction <= 0 && excess <= rounding &&
         against <= rounding && heat >= 0;
}

void Watched::include(const Watched& run) {
  residual = std::max(residual, run.residual);
  penetration = std::max(penetration, run.penetration);
  suction = std::max(suction, run.suction);
  excess = std::max(excess, run.excess);
  against = std::max(against, run.against);
  heat = std::min(heat, run.heat);
}

void Group::add(const Watched& run, double reach, const std::string& what) {
  EXPECT_TRUE(run.sound()) << topic_ << ", " << what << ": residual " << run.residual << ", penetration "
                           << run.penetration << ", suction " << run.suction << ", excess " << run.excess
                           << ", against " << run.against << ", heat " << run.heat;
  EXPECT_LE(run.displacement, 2 * reach) << topic_ << ", " << what;
  worst_.include(run);
  reached_ = std::max(reached_, run.displacement / reach);
  ++runs_;
}

void Group::report_worst() const {
  report({topic_,
          format("{} runs: energy residual; penetration; tau beyond mu p; slip against tau; u over U + V t",
                 runs_),
          "< 1e-12; <= 1e-14; <= 1e-14; <= 1e-14; <= 2",
          "<= " + decade_above(worst_.residual) + "; " + decade_above(worst_.penetration) + "; " +
              decade_above(worst_.excess) + "; " + decade_above(worst_.against) +
              format("; {:.1g}", reached_),
          "", "rounding"});
}

Watched watch(SlidingBody& body, long steps) {
  Watched seen;
  std::vector<double> peak(static_cast<std::size_t>(body.contact().size()), 0);
  for (long n = 0; n < steps; ++n) {
    const bool observed = n % 10 == 0;
    body.advance(observed);
    look_at_contact(body, peak, seen);
    if (!observed) continue;
    look_at_energy(body, seen);
    seen.displacement = std::max(seen.displacement, largest_displacement(body));
  }
  for (double* worst :
       {&seen.penetration, &seen.suction, &seen.excess, &seen.against, &seen.displacement, &seen.traction})
    *worst = over_ranks(*worst, MPI_MAX);
  seen.penetration /= seen.displacement;
  seen.against /= seen.displacement + std::abs(body.surface_travel());
  for (double* sum : {&seen.drag, &seen.load}) *sum = over_ranks(*sum, MPI_SUM) / static_cast<double>(steps);
  return seen;
}

std::string decade_above(double value) {
  return value > 0 ? format("{:.0e}", std::pow(10, std::ceil(std::log10(value)))) : "0";
}

Scene pressed_scene() {
  Scene scene = scene_r();
  scene.conditions[0].ramp = 2e-6;
  return scene;
}

Block pressed_block() {
  Block block;
  block.width = block.height = 5e-3;
  block.nx = block.ny = 10;
  block.shape = Shape::quadrilaterals;
  return block;
}

WatchedRun run_watched(const Block& block, const std::vector<Material>& materials, const Scene& scene,
                       long steps) {
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, materials, Model::Storage::full);
  const double time_step =
      0.9 * stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, scene.beta2, scene.damping);
  SlidingBody body(PETSC_COMM_WORLD, model, scene, time_step);
  return {watch(body, steps), std::abs(*scene.conditions[0].displacement[1]) +
                                  std::abs(scene.surface->travel(static_cast<double>(steps) * time_step))};
}

}  // namespace slipscale::testing_support
