#include <gtest/gtest.h>

#include <cmath>

#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double speed = 3, gap = 0.105, time_step = 0.01;  // m/s, m, s

/// A falling body so soft that each of its surface nodes is a free mass.
struct Landing {
  double impulse = 0;  ///< over m|v|, of the node farthest from 1
  double ratio = 0;  ///< of velocities from one step to the next once the node lies on the surface, likewise
  double rebound = 0;  ///< largest velocity away from the surface, over |v|
  double energy = 0;  ///< lost at the surface and in the scheme, over the kinetic energy of the surface nodes
};

/// Of all the nodes on all ranks the value farthest from `expected`.
double farthest(const std::vector<double>& values, double expected) {
  struct {
    double distance;
    int rank;
  } most{-1, 0};
  most.rank = rank_of(PETSC_COMM_WORLD);
  double value = expected;
  for (const double x : values)
    if (std::abs(x - expected) > most.distance) {
      most.distance = std::abs(x - expected);
      value = x;
    }
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE_INT, MPI_MAXLOC, PETSC_COMM_WORLD);
  MPI_Bcast(&value, 1, MPI_DOUBLE, most.rank, PETSC_COMM_WORLD);
  return value;
}

Landing landing(double beta2) {
  Block block;
  block.shape = Shape::mixed;
  block.distortion = 0.2;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(1e-30, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.initial.velocity = {0, -speed};
  scene.initial.gap = gap;
  scene.beta2 = beta2;
  scene.surface = Surface{"bottom", 0, 0, 0};
  SlidingBody body(PETSC_COMM_WORLD, model, scene, time_step);
  const ContactNodes& contact = body.contact();
  const auto count = static_cast<std::size_t>(contact.size());
  std::vector<double> impulse(count, 0), ratio(count, 0), velocity(count, 0);
  Landing found;
  int landed_steps = 0;
  for (int n = 0; n < 100; ++n) {
    body.advance(n == 99);
    const bool landed = n > 0 && count > 0 && contact.pressure[0] > 0;
    landed_steps += landed;
    for (std::size_t k = 0; k < count; ++k) {
      impulse[k] += contact.force[k][1] * time_step / (contact.mass[k] * speed);
      const double w = body.next_predictor()[contact.node[k]][1];
      if (landed_steps == 3) ratio[k] = w / velocity[k];  // the first step closes the gap, the second stops
      velocity[k] = w;
      found.rebound = std::max(found.rebound, w / speed);
    }
  }
  double kinetic = 0;
  for (const double m : contact.mass) kinetic += 0.5 * m * speed * speed;
  MPI_Allreduce(MPI_IN_PLACE, &kinetic, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &found.rebound, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  const Energy energy = body.energy();
  found.energy = (energy.impact_loss + energy.scheme_dissipation) / kinetic;
  found.impulse = farthest(impulse, 1);
  found.ratio = farthest(ratio, (beta2 - 0.5) / (beta2 + 0.5));
  return found;
}

}  // namespace

/// The position constraint makes the impact of a node plastic. Its momentum m|v| passes
/// to the surface exactly, it never rebounds, what velocity is left shrinks by (β2−½)/(β2+½) in each step,
/// and all its kinetic energy is lost. Rounding of sums over 100 steps: 1e-13.
TEST(NodeImpact, OfTheNodesOfABodyIsPlastic) {
  for (const double beta2 : {0.5, 0.6, 0.8, 1.0}) {
    const Landing found = landing(beta2);
    const double ratio = (beta2 - 0.5) / (beta2 + 0.5);
    SCOPED_TRACE(beta2);
    EXPECT_NEAR(found.impulse, 1, 1e-13);
    EXPECT_NEAR(found.ratio, ratio, 1e-13);
    EXPECT_LE(found.rebound, 1e-13);
    EXPECT_NEAR(found.energy, 1, 1e-13);
    report({"Impact of the surface nodes of a body",
            format("beta2 {:.1f}: impulse over m v; velocity left per step; energy lost over m v2/2", beta2),
            format("1; {:.4f}; 1", ratio),
            format("{:.10f}; {:.4f}; {:.10f}", found.impulse, std::abs(found.ratio), found.energy), "",
            "position constraint, lumped mass"});
  }
}
