#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "scenes.hpp"

namespace slipscale::testing_support {

/// Sustained frictional instability of a homogeneous slab, as second_program.py runs it: a strip of
/// length 2π, periodic in x, its top held, pressed with p0 = 1e-4 G. H = 2, c_s = ρ = G = 1, ν = .3, μ = .5.
struct Strip {
  int nx = 64;
  double speed = 7e-4;              ///< V/c_s
  bool stored_strength = false;     ///< threshold of the friction law
  double relaxation_time = 0.2;     ///< T; 0 is Coulomb
  double stiffness_damping = 0.02;  ///< b
  double step = 0.4;                ///< Δt over 2/ω_max, the undamped limit
  double seed = 0.01;               ///< v_x over V at the start
  int ny() const { return nx == 32 ? 10 : nx == 64 ? 20 : 41; }
};

/// Means over time, all taken at the surface.
struct StripMeans {
  double friction = 0;   ///< ⟨T⟩/⟨N⟩
  double load = 0;       ///< ⟨N⟩ over p0 L
  double power = 0;      ///< ⟨τ u̇⟩ that passes into the body, over μ p0 L V
  double separated = 0;  ///< part of the nodes that is open
  double stick = 0;
};

struct StripOutcome {
  StripMeans whole, early, late;  ///< t in [200, 400], [200, 300], [300, 400]
};

/// What the nodes of one rank add up to over a window of time.
class StripSums {
 public:
  void add(const SlidingBody& body) {
    const ContactNodes& contact = body.contact();
    const BoundaryNodes& nodes = body.boundary_nodes();
    for (int k = 0; k < contact.size(); ++k) {
      const int slot = contact.slot[k];
      const double next = body.next_displacement()[contact.node[k]][0] - nodes.displacement[slot][0],
                   velocity = (next + nodes.past_increment[slot][0]) / (2 * body.time_step());
      sum_[0] += contact.force[k][0];
      sum_[1] += contact.force[k][1];
      sum_[2] += contact.force[k][0] * velocity;
      sum_[3] += contact.status[k] == ContactStatus::open;
      sum_[4] += contact.status[k] == ContactStatus::stick;
    }
    ++steps_;
  }

  StripMeans means(const Strip& strip, double load) const {
    std::array<double, 5> sum = sum_;
    MPI_Allreduce(MPI_IN_PLACE, sum.data(), 5, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    const double n = static_cast<double>(steps_), visits = n * strip.nx;
    return {sum[0] / sum[1], sum[1] / n / load, sum[2] / n / (0.5 * load * strip.speed), sum[3] / visits,
            sum[4] / visits};
  }

  StripSums operator+(const StripSums& other) const {
    StripSums both = *this;
    for (int k = 0; k < 5; ++k) both.sum_[k] += other.sum_[k];
    both.steps_ += other.steps_;
    return both;
  }

 private:
  std::array<double, 5> sum_{};
  long steps_ = 0;
};

inline StripOutcome run_strip(const Strip& strip) {
  constexpr double length = 2 * std::numbers::pi, pressure = 1e-4, friction = 0.5;
  Block block;
  block.nx = strip.nx;
  block.ny = strip.ny();
  block.width = length;
  block.height = 2;
  block.shape = Shape::quadrilaterals;
  block.periodic_x = true;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(2.6, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.conditions = {{"top", {0.0, 0.0}, 0, 0, 0}};
  scene.initial.pressure = pressure;
  scene.initial.shear = friction * pressure;
  scene.initial.amplitude = strip.seed * strip.speed;
  scene.initial.wavelength = length;
  scene.damping.stiffness = strip.stiffness_damping;
  scene.surface = Surface{"bottom", 0, strip.speed, 0};
  scene.friction = {
      FrictionChoice::Law::regularized, friction, false, strip.stored_strength, strip.relaxation_time, 0, 0};
  const double dt = strip.step * 2 / largest_frequency(PETSC_COMM_WORLD, model).sharp;
  SlidingBody body(PETSC_COMM_WORLD, model, scene, dt);
  StripSums early, late;
  while (body.steps_done() == 0 || body.time() + dt <= 400) {
    body.advance(false);
    if (body.time() >= 200) (body.time() < 300 ? early : late).add(body);
  }
  const double load = pressure * length;
  return {(early + late).means(strip, load), early.means(strip, load), late.means(strip, load)};
}

}  // namespace slipscale::testing_support
