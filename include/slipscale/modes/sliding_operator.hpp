#pragma once

#include <memory>

#include "slipscale/modes/free_components.hpp"

namespace slipscale {

/// A node of the body that is closed: held in y at the surface, sliding along x.
struct ClosedNode {
  int node = 0;       ///< local, owned
  double length = 0;  ///< tributary length, m
  double weight = 1;  ///< its coefficient of friction over that of the law
};

/// Stiffness and friction of a body that slides steadily, for a set of closed nodes, on the free components:
///     K = CᵀK̄C,    (G w) in the row of the x of a closed node = ± weight λ,   λ = (K̄ C w)_y at that node
/// with the stiffness K̄ of all components, the reaction λ of the held y, and + where the surface moves along
/// +x. K is factorised once, when it is first solved with.
class SlidingOperator {
 public:
  /// `direction`: 1 or −1, the sign of the surface's speed. Collective, as are all members that multiply
  /// or solve.
  SlidingOperator(MPI_Comm comm, const Model& model, FreeComponents free, std::vector<ClosedNode> closed,
                  double direction);
  ~SlidingOperator();

  const FreeComponents& free() const { return free_; }
  const std::vector<ClosedNode>& closed() const { return closed_; }
  double direction() const { return direction_; }
  const Model& model() const { return model_; }
  MPI_Comm comm() const { return comm_; }
  /// Where the x of a closed node stands among the free components; −1: its x is held.
  const std::vector<int>& sliding_places() const { return sliding_; }

  /// K w, and the reactions λ [closed], N/m.
  void multiply(const double* w, double* kw, double* reaction) const;
  /// K̄ u of the owned nodes for any u [owned], N/m.
  void internal_force(const Vector2* u, Vector2* force) const;
  /// Adds to r the friction `factor` λ along x.
  template <class Vector, class Factor, class Reaction>
  void add_friction(Factor factor, const Reaction& reaction, Vector& r) const {
    for (std::size_t k = 0; k < sliding_.size(); ++k)
      if (sliding_[k] >= 0)
        r[sliding_[k]] += factor * direction_ * closed_[k].weight * reaction[static_cast<Eigen::Index>(k)];
  }
  /// μ'(V) λ of the closed nodes where the coefficient depends on the slip rate, N s/m² per m; else empty.
  std::vector<double> slip_slope;
  /// Adds to r what `factor` times them makes of a motion `u`(k) along x.
  template <class Vector, class Factor, class Motion>
  void add_slip(Factor factor, const Motion& u, Vector& r) const {
    for (std::size_t k = 0; k < slip_slope.size(); ++k)
      if (sliding_[k] >= 0) r[sliding_[k]] += factor * slip_slope[k] * u(sliding_[k]);
  }
  /// K⁻¹ of each column. Throws UserError when K cannot be factorised.
  Columns solve(const Columns& right) const;

 private:
  struct Factor;
  void factorise() const;

  MPI_Comm comm_;
  const Model& model_;
  FreeComponents free_;
  std::vector<ClosedNode> closed_;
  double direction_;
  std::vector<int> sliding_;
  std::unique_ptr<NodalVector> u_;
  mutable std::vector<Vector2> force_;
  mutable std::unique_ptr<Factor> factor_;
};

}  // namespace slipscale
