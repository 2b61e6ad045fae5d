#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// A linear elastic solid in plane strain.
struct Material {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  ///< Voigt (xx, yy, xy), engineering shear, Pa
  double density = 0;                                   ///< kg/m³
  std::string description;                              ///< for tables: "E 30 GPa, nu 0.25, 1800 kg/m3"
  std::string doubt = {};  ///< what the homogenisation that found it was not content with; or empty

  double c11() const { return stiffness(0, 0); }
  double c22() const { return stiffness(1, 1); }
  double c66() const { return stiffness(2, 2); }
  bool operator==(const Material& other) const = default;
};

/// C of an isotropic solid, Pa, from Young's modulus [Pa] and Poisson's ratio in plane strain.
Eigen::Matrix3d isotropic_stiffness(double young, double poisson);

struct WaveSpeeds {
  double fast = 0, slow = 0;  ///< m/s; dilatational and shear where the solid is isotropic
};

/// Speeds of plane waves that travel along the unit vector (nx, ny), from the acoustic tensor.
WaveSpeeds wave_speeds(const Material& material, double nx, double ny);

/// Whether ν of the nearest isotropic solid exceeds .49: with a plane bulk modulus of more than fifty shear
/// moduli, linear triangles and fully integrated quadrilaterals lock.
bool nearly_incompressible(const Eigen::Matrix3d& stiffness);

Schema material_schema();

/// One material a region, in the order of `regions`. `material_all_…` (or `material_file`) serves every
/// region that has none of its own. Throws UserError for a region without material, a value missing, out of
/// range or given twice, and a stiffness that is not positive definite.
std::vector<Material> read_materials(const Options& options, const std::vector<std::string>& regions);

}  // namespace slipscale
