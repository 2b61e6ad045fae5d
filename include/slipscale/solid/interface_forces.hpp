#pragma once

#include <array>
#include <span>
#include <vector>

#include "slipscale/base/plane_tensor.hpp"
#include "slipscale/mesh/inclusions.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// Traction along the interfaces of inclusions, recovered from nodal forces: what the rest of the body does
/// to an inclusion at a node of its outline is what its own cells there need to balance,
///     F_i = Σ over the inclusion's cells around i of m a + K u (or ∫ Bᵀσ),
/// so that the forces on an inclusion that touches nothing else add up to its inertia, to rounding; and
/// t_i = F_i over ∫ N_i n ds. With a uniform stress t = σ n exactly, on any mesh. That is the consistent
/// traction of boundary flux recovery (G. F. Carey, Commun. Appl. Numer. Meth. 1 (1985) 33).

/// From the state of a distributed mesh: at the interface nodes that this rank owns.
class InterfaceForces {
 public:
  /// `region`: of the inclusions. Throws what `find_inclusions` throws. The mesh must outlive this object.
  InterfaceForces(const Mesh& mesh, const std::vector<Material>& materials, int region,
                  const RegionInclusions& found);

  /// Rows among Inclusions::interface, ascending, and the local nodes they belong to.
  const std::vector<int>& rows() const { return rows_; }
  int node(std::size_t k) const { return node_[k]; }
  double mass(std::size_t k) const { return mass_[k]; }  ///< of the inclusion's cells there, kg/m

  /// K u of the inclusion's cells at row k, N/m. `displacement` [all local nodes], m.
  Vector2 internal(std::size_t k, const Vector2* displacement) const;

 private:
  struct Part {
    int cell, block;  ///< where its two rows of the cell's stiffness start in `blocks_`
  };
  const Mesh& mesh_;
  std::vector<int> rows_, node_, first_{0};
  std::vector<double> mass_, blocks_;
  std::vector<Part> parts_;
};

/// From the stress of cells of a mesh that every rank holds whole: cells of inclusions around their
/// interfaces alone are asked for.
class StressForces {
 public:
  StressForces(const PlaneGrid& grid, const RegionInclusions& found);

  /// Cells of the grid whose stress is needed, ascending.
  const std::vector<int>& cells() const { return cells_; }
  /// Of each row of Inclusions::interface, N/m; `stress` [cells()], Pa.
  std::vector<Vector2> operator()(std::span<const PlaneTensor> stress) const;

 private:
  struct Part {
    int row, cell;
    std::array<double, 2> area_gradient;  ///< ∫ grad N_i dA, m
  };
  std::size_t interface_;
  std::vector<int> cells_;
  std::vector<Part> parts_;
};

}  // namespace slipscale
