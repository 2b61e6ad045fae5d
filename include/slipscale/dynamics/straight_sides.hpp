#pragma once

#include <memory>
#include <vector>

#include "slipscale/base/state_group.hpp"
#include "slipscale/dynamics/body_acceleration.hpp"
#include "slipscale/dynamics/boundary_nodes.hpp"
#include "slipscale/dynamics/conditions.hpp"
#include "slipscale/dynamics/scheme.hpp"

namespace slipscale {

/// The motion of a straight side along y: of its middle, m, and its tilt, rad (small). Their time derivatives
/// and the forces that belong to them, N/m and N, come in the same pair.
using PlateMotion = std::array<double, 2>;

/// A side of the body that a rigid plate keeps straight: its nodes move along y as one, or along y and
/// tilting, under a force that is given. Along x they are as free as the boundary says.
///
/// The nodes' masses and that of the plate are one: with the forces R_i on the nodes and their distances s_i
/// from the middle along x,
///     (Σ m_i + m) A + Σ m_i s_i α           = F + Σ R_i
///     Σ m_i s_i A + (Σ m_i s_i² + m l²/12) α = Σ R_i s_i       (the second where the side may tilt)
/// and each node moves with A + α s_i; what that takes beyond R_i is the plate's push on it. The plate is a
/// uniform bar of the side's extent l; gravity does not act on it: its weight belongs to F.
class StraightSide {
 public:
  /// Sets `predictor` of its nodes to the straight motion with the same momentum. Collective.
  StraightSide(MPI_Comm comm, const Mesh& mesh, const BoundaryCondition& condition,
               const BoundaryNodes& nodes, const Vector2* displacement, Vector2* predictor);
  ~StraightSide();
  StraightSide(const StraightSide&) = delete;
  StraightSide& operator=(const StraightSide&) = delete;

  /// One step from t_n = `time`: moves the side, and adds the plate's push to `nodes.load`. `force` is K u_n.
  /// One small gather among the ranks that hold nodes of the side; summed in the order of the nodes' numbers.
  void apply(double time, const StepCoefficients& step, const Damping& damping,
             const BodyAcceleration& gravity, const Vector2* force, BoundaryNodes& nodes,
             const NodalState& state);

  /// What the plate's own mass adds to the energy ledger; on one rank, zero on the others.
  struct Inertia {
    double past = 0;    ///< M A_n · (U_n − U_{n−1}), J/m
    double next = 0;    ///< M A_n · (U_{n+1} − U_n), J/m
    double change = 0;  ///< ΔA · M ΔA of the step just closed, N²/kg/m
  };
  const Inertia& inertia() const { return inertia_; }
  /// ½ V·MV and ½ A·MA at t_n of the plate alone; on one rank. J/m, and N²/kg/m
  std::array<double, 2> energies() const;

  /// For a checkpoint: the motion, the same on all ranks that hold nodes of the side.
  StateGroup state();
  /// Mass and moment of inertia of the plate alone, kg/m and kg m; on one rank, zero on the others.
  PlateMotion plate_mass() const { return counts_ ? own_ : PlateMotion{}; }
  bool answers_for_plate() const { return counts_; }  ///< true on one rank

  const std::string& boundary() const { return boundary_; }
  const PlateMotion& displacement() const {
    return motion_.before;
  }  ///< at t_n since the start; on ranks that hold
  const PlateMotion& velocity() const { return motion_.velocity; }  ///< nodes of the side

 private:
  struct Member {
    int slot;
    double arm;      ///< s, m
    double initial;  ///< u_y at the start, m
  };
  PlateMotion gather(const std::vector<double>& mine);

  const std::string boundary_;
  const double force_, ramp_;
  const SharedFormula formula_;  ///< of the force, as a factor
  const bool tilts_;
  std::vector<Member> members_;
  PlateMotion own_{};                ///< mass and moment of inertia of the plate, kg/m and kg m
  std::array<double, 3> inverse_{};  ///< of the mass matrix: 11, 12, 22
  /// What one step leaves to the next.
  struct Motion {
    PlateMotion place{}, before{};           ///< U_{n+1}, U_n
    PlateMotion increment{};                 ///< U_{n+1} − U_n
    PlateMotion moves{};                     ///< W_{n+1}
    PlateMotion velocity{}, acceleration{};  ///< V_n, A_n
    double started = 0;                      ///< 1 when a step was made
  };
  Motion motion_;
  Inertia inertia_;

  MPI_Comm comm_ = MPI_COMM_NULL;  ///< of the ranks that hold nodes of the side
  bool counts_ = false;            ///< this rank answers for the plate
  std::vector<int> counts_of_, starts_of_;
  std::vector<int> order_;  ///< arriving values in the order of the nodes' numbers
  std::vector<double> mine_, all_, arms_;
};

/// All straight sides of a scene.
class StraightSides {
 public:
  /// Throws UserError where a node of a side belongs to another straight side, or is prescribed along y by
  /// another boundary. Collective.
  StraightSides(MPI_Comm comm, const Mesh& mesh, const std::vector<BoundaryCondition>& conditions,
                const BoundaryNodes& nodes, const Supports& supports, const Vector2* displacement,
                Vector2* predictor);
  bool empty() const { return sides_.empty(); }
  std::size_t size() const { return sides_.size(); }
  bool holds(int slot) const;  ///< whether a node belongs to one of them

  std::vector<std::unique_ptr<StraightSide>>::const_iterator begin() const { return sides_.begin(); }
  std::vector<std::unique_ptr<StraightSide>>::const_iterator end() const { return sides_.end(); }

 private:
  std::vector<std::unique_ptr<StraightSide>> sides_;
  std::vector<char> held_;  ///< by slot
};

}  // namespace slipscale
