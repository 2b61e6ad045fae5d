#pragma once

#include <cmath>
#include <complex>
#include <variant>
#include <vector>

#include "scenes.hpp"
#include "slipscale/dynamics/bulk.hpp"

namespace slipscale::testing_support {

/// How far the phase speed of a wave may lie off on a mesh of spacing h, relative: the leading term (kd)²/24
/// of linear elements with lumped mass, with d = √2 h the longest way between neighbours. The stiffness of
/// the fastest wave blurs that of a slower one, hence (c_fast/c)².
inline double dispersion(double k, double spacing, double fast, double speed) {
  const double phase = k * spacing, ratio = fast / speed;
  return 2 * phase * phase / 24 * ratio * ratio;
}

/// A body that nothing touches, set in motion by any field: the library's own step, β2 = ½, without the
/// boundaries that a `SlidingBody` would have. A scene can describe only few initial states.
class FreeBody {
 public:
  /// `displacement` and `velocity` give u_0 [m] and v_0 [m/s] at a point.
  template <class Displacement, class Velocity>
  FreeBody(const Model& model, double time_step, const Displacement& displacement, const Velocity& velocity)
      : model_(model),
        time_step_(time_step),
        u_(PETSC_COMM_WORLD, model.mesh.nodes, true),
        w_(PETSC_COMM_WORLD, model.mesh.nodes, false),
        force_(model.mesh.nodes.number.size()) {
    const Nodes& nodes = model.mesh.nodes;
    for (int i = 0; i < nodes.size(); ++i) u_.data()[i] = displacement(nodes.position[i]);
    for (int i = 0; i < nodes.owned; ++i) w_.data()[i] = velocity(nodes.position[i]);
    for (const double m : model.mass) inverse_mass_.push_back(1 / m);
  }

  void advance() {
    const StepCoefficients step = first_ ? first_step(time_step_, 0.5) : beta2_step(time_step_, 0.5);
    first_ = false;
    u_.end_update();
    const BulkArrays arrays{inverse_mass_.data(), nullptr, u_.data(), w_.data(), nullptr};
    const FreeMotion move(BulkPhysics{}, model_.kernel.instructions, arrays, step, {}, {0, 0}, {}, {});
    std::get<PairStiffness<double>>(model_.stiffness)
        .multiply(u_.data(), force_.data(), [&](int begin, int end) { move(begin, end, force_.data()); });
    u_.begin_update();
  }

  const Vector2* next_displacement() const { return u_.data(); }  ///< u_{n+1}, owned nodes, m

  /// Σ m u·e exp(−ik·x) over the nodes that `counts(x)`: the phase of what moves along `direction`.
  template <class Counts>
  std::complex<double> component(const Vector2& k, const Vector2& direction, const Counts& counts) const {
    double sum[2] = {0, 0};
    for (int i = 0; i < model_.mesh.nodes.owned; ++i) {
      const Vector2 &x = model_.mesh.nodes.position[i], &u = u_.data()[i];
      if (!counts(x)) continue;
      const double weight = model_.mass[i] * (u[0] * direction[0] + u[1] * direction[1]);
      const double phase = k[0] * x[0] + k[1] * x[1];
      sum[0] += weight * std::cos(phase);
      sum[1] -= weight * std::sin(phase);
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    return {sum[0], sum[1]};
  }

  /// ‖u − u_exact‖ / ‖u_exact‖ with the masses as weights, `exact(x)` the displacement of now, m.
  template <class Exact>
  double relative_error(const Exact& exact) const {
    double sum[2] = {0, 0};
    for (int i = 0; i < model_.mesh.nodes.owned; ++i) {
      const Vector2 e = exact(model_.mesh.nodes.position[i]), &u = u_.data()[i];
      sum[0] += model_.mass[i] * (std::pow(u[0] - e[0], 2) + std::pow(u[1] - e[1], 2));
      sum[1] += model_.mass[i] * (e[0] * e[0] + e[1] * e[1]);
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    return std::sqrt(sum[0] / sum[1]);
  }

 private:
  const Model& model_;
  const double time_step_;
  NodalVector u_, w_;
  std::vector<Vector2> force_;
  std::vector<double> inverse_mass_;
  bool first_ = true;
};

}  // namespace slipscale::testing_support
