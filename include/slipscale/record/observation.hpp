#pragma once

#include <string>
#include <vector>

#include "slipscale/dynamics/sliding_body.hpp"
#include "slipscale/mesh/ordered_gather.hpp"

namespace slipscale {

/// Load that a boundary carries, N per metre of depth.
struct BoundaryLoad {
  double normal = 0;  ///< > 0 in compression
  double tangential =
      0;  ///< of the body on its support, > 0 along +x (along +y where the boundary is vertical)
};

/// Unit vectors at a boundary: its mean outward normal (+y where it has none), and along it towards +x (+y
/// where it is vertical).
struct Directions {
  Vector2 normal, tangent;
};
Directions directions_of(const Boundary& boundary);

/// One contact node at t_n.
struct ContactReading {
  Vector2 u{};              ///< m
  Vector2 v{};              ///< m/s
  double gap = 0;           ///< height above the surface, m
  double strength = 0;      ///< what the friction law remembers, Pa
  double traction = 0;      ///< tangential, on the body along +x, Pa
  double normal_force = 0;  ///< λ, N/m
  ContactStatus status = ContactStatus::open;
  ContactTotals totals = {};  ///< where the body keeps them
};

/// The plate that keeps a side straight, at t_n: along y, and about its middle, counter-clockwise.
struct PlateReading {
  PlateMotion moved{};     ///< since the start, m and rad
  PlateMotion velocity{};  ///< m/s and rad/s
  PlateMotion momentum{};  ///< of the plate alone, kg/s and kg m/s
};

/// What is measured at t_n, the same bits on any number of ranks; on rank 0, energies and momenta on every
/// rank.
struct Observation {
  double time = 0;  ///< s
  long step = 0;
  std::vector<BoundaryLoad> boundaries;  ///< in the order of SlidingBody::boundary_names
  std::vector<ContactReading> contact;   ///< along x
  BoundaryLoad surface;                  ///< force of the surface on the body: λ and τA summed
  double drive_power = 0;                ///< Σ τA V, W/m
  double power_into_body = 0;            ///< Σ τA v_x, W/m
  double friction_heat = 0;              ///< Σ τA (V − v_x), W/m
  double stick = 0, slip = 0, open = 0;  ///< fractions of the contact boundary's length
  double friction = 0;  ///< tangential over normal load at the measured boundary; NaN without load
  Momentum momentum;    ///< where it is asked for; summed as the energies are
  std::vector<PlateReading> plates;  ///< likewise, in the order of SlidingBody::straight_sides
  Energy energy;
};

/// Gathers what an observation needs. Collective.
class Observer {
 public:
  /// `momentum`: of body and plates, at the cost of a sum over the nodes and the ranks for each observation.
  Observer(const SlidingBody& body, bool momentum);

  /// State at t_n of an observed step; forces on the boundaries, and energies and momenta, which are sums
  /// over the bulk, only where they are asked for. Collective.
  Observation observe(bool bulk = true) const;

  const std::vector<double>& contact_x() const { return contact_x_; }              ///< rank 0, ascending, m
  const std::vector<double>& contact_y() const { return contact_y_; }              ///< rank 0, m
  const std::vector<double>& tributary_length() const { return contact_length_; }  ///< rank 0, m
  /// Part of each node's tributary length that belongs to each region, [nodes, regions]; rank 0.
  const std::vector<double>& region_shares() const { return contact_shares_; }
  int measured() const { return measured_; }  ///< index of the measured boundary; −1 without one

 private:
  void observe_boundaries(Observation& seen) const;
  void observe_contact(Observation& seen) const;
  void observe_plates(Observation& seen) const;

  const SlidingBody& body_;
  const bool momentum_;
  OrderedGather boundary_gather_, contact_gather_;
  std::vector<std::vector<int>> members_;  ///< rank 0, by boundary: rows of the gathered boundary nodes
  std::vector<int> along_x_;               ///< rank 0: gathered contact rows in the order of x
  std::vector<double> contact_x_, contact_y_, contact_length_, contact_shares_;
  int measured_ = -1;
};

}  // namespace slipscale
