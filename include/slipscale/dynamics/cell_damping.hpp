#pragma once

#include <vector>

#include "slipscale/base/state_group.hpp"
#include "slipscale/dynamics/model.hpp"
#include "slipscale/dynamics/scheme.hpp"

namespace slipscale {

/// What bulk damping has taken in each cell since t = 0: the ledger's row of damping, shared out exactly.
/// With Δ_n = u_n − u_{n−1} the step n−1 → n takes in a cell with stiffness K and row-sum masses m_i
///     b/Δt Δ_nᵀ K [β2 Δ_n + (1−β2) Δ_{n−1}]  +  a Σ m_i Δ_n·[β2 w_n + (1−β2) w_{n−1}]
/// which are the works of its damping forces as EnergyLedger weighs them; over all cells they add up to the
/// ledger's row, whatever the elements. One pass over the cells for each step, which nobody pays who does not
/// ask. A single step may give energy back to a cell where β2 < 1 and the motion turns round: by the order of
/// one step. The stiffness is that of full precision.
class CellDamping {
 public:
  /// `displacement` u_0 and `past` u_{−1} by local node, ghosts included, m; `predictor` w_0, owned nodes,
  /// m/s.
  CellDamping(MPI_Comm comm, const Model& model, const Damping& damping, double beta2, double time_step,
              const Vector2* displacement, const Vector2* past, const Vector2* predictor);

  /// Once u_n is known, ghosts included, and w_n, before anything else of step n.
  void close_step(const Vector2* displacement, const Vector2* predictor);

  /// Work over volume at t_n in each local cell that this rank owns, J/m³; zero in the others. Collective.
  void density(std::vector<double>& of_cells);
  /// Memory on this rank, bytes.
  double bytes() const;

  /// For a checkpoint: adds arrays to the group of the owned nodes, and a group of the owned cells.
  void add_state(StateGroup& nodes);
  StateGroup cells_state();
  void resume();

 private:
  /// A cell's stiffness for displacements relative to its first corner, [2 (corners − 1)]² numbers from
  /// `stiffness` on: rigid translations cost nothing.
  struct Cell {
    int local, stiffness;
  };
  int add_stiffness(int cell);

  MPI_Comm comm_;
  const Model& model_;
  const double mass_, stiffness_;  ///< a, 1/s; b/Δt
  const double beta2_;
  std::vector<Cell> cells_;         ///< owned
  std::vector<double> relative_;    ///< Pa, of all shapes
  std::vector<double> work_;        ///< [owned cells] by stiffness damping, J/m
  NodalVector before_, increment_;  ///< u_{n−1} and Δ_{n−1}, m
  std::vector<Vector2> weighed_;    ///< β2 Δ_n + (1−β2) Δ_{n−1}, m; by local node
  NodalVector past_predictor_;      ///< w_{n−1}, m/s
  NodalVector
      mass_work_;  ///< Σ Δ_n·[β2 w_n + (1−β2) w_{n−1}] in the first component, m²/s; ghosts only when asked
};

}  // namespace slipscale
