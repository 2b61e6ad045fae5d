#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// What acts on one named boundary. Displacements are counted from the initial state; every amplitude follows
/// ½(1 − cos(πt/ramp)) and is then held; ramp 0 applies it at once.
struct BoundaryCondition {
  /// Along y: not held together; straight and level; straight and free to tilt.
  enum class Straight { no, rigid, tilting };

  std::string boundary;
  std::array<std::optional<double>, 2> displacement{};  ///< prescribed along x, y, m; 0 is `fixed`
  double pressure = 0;                                  ///< > 0 compresses, Pa
  double shear = 0;                                     ///< traction on the body along +x, Pa
  double ramp = 0;                                      ///< s
  Straight straight = Straight::no;
  double plate_force = 0;  ///< on a straight side, along +y, N per metre of depth
  double plate_mass = 0;   ///< of what keeps it straight, kg per metre of depth
  bool absorbing = false;  ///< waves leave through it, see AbsorbingSides
  // Where a formula stands, the value is that number (1, of a force ±1) times it:
  std::array<SharedFormula, 2> displacement_formula{};
  SharedFormula pressure_formula{}, shear_formula{}, force_formula{};

  Quantity imposed(int axis) const { return {*displacement[axis], displacement_formula[axis]}; }
  bool is_straight() const { return straight != Straight::no; }
};

Schema boundary_schema();

/// The conditions of the scene in the order of the mesh's boundaries. Throws UserError for a condition on an
/// interior boundary (the seam of a periodic mesh, say), and for a straight side that faces along x or tilts
/// on a mesh that is periodic along x.
std::vector<BoundaryCondition> read_conditions(const Options& options, const Mesh& mesh);

std::string describe(const BoundaryCondition& condition);

/// Displacement [m] and velocity [m/s] of all local nodes.
struct InitialFields {
  std::vector<Vector2> displacement, velocity;
};

/// How the body starts.
struct InitialState {
  Vector2 velocity{};     ///< m/s
  double rotation = 0;    ///< counter-clockwise about the middle of the block, rad/s
  double amplitude = 0;   ///< of v_x = amplitude cos(2πx/wavelength)(1 − y/H)², m/s
  double wavelength = 0;  ///< m
  double gap = 0;         ///< lifts the body, m
  double pressure = 0;    ///< uniform state u_y = −p y/C22, Pa
  double shear = 0;       ///< uniform state u_x = τ(H − y)/C66, Pa
  // Where a formula stands, the value is that number, 1, times it:
  std::array<SharedFormula, 2> velocity_formula{};
  SharedFormula pressure_formula{}, shear_formula{};
  std::array<Quantity, 2> displacement{};  ///< added to all that, m
  std::string file = {};                   ///< of `fields`; empty: none
  std::optional<double> file_time = {};    ///< of its frame, s
  std::shared_ptr<const InitialFields> fields =
      {};  ///< what the file says, added to all that; read by others

  Quantity pressure_at_start() const { return {pressure, pressure_formula}; }
  Quantity shear_at_start() const { return {shear, shear_formula}; }
};

Schema initial_schema();
InitialState read_initial(const Options& options, const Mesh& mesh);

/// Sets u [all local nodes] and v [owned nodes]. Throws UserError for a uniform state in a body that is not
/// uniform, for a rotation of a periodic one, and for a formula that makes no number at a node. Collective.
void set_initial(const InitialState& initial, const Mesh& mesh, const std::vector<Material>& materials,
                 Vector2* displacement, Vector2* velocity);

}  // namespace slipscale
