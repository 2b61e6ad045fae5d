#pragma once

#include <Eigen/Dense>
#include <memory>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/mesh/mesh.hpp"

namespace slipscale {

/// The constants of a linear elastic solid in plane strain.
struct Solid {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  ///< as of Material
  double density = 0;
  bool operator==(const Solid& other) const = default;
};

/// What varies from cell to cell in a region whose constants are formulas of the place: each cell has those
/// at the mean of its corners, throughout, which is of second order in its size.
struct Grading {
  std::vector<Solid> of_cell;  ///< [local cells]; of cells of other regions nothing
  Solid fastest;               ///< where waves along y are, of the whole region
  double modulus = 0;          ///< largest component of any stiffness of the region, Pa
  bool locks = false;          ///< some solid of the region is nearly incompressible
};

/// A linear elastic solid in plane strain. Of a graded one stiffness and density are those of the cell with
/// the slowest waves along y.
struct Material {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  ///< Voigt (xx, yy, xy), engineering shear, Pa
  double density = 0;                                   ///< kg/m³
  std::string description;                              ///< for tables: "E 30 GPa, nu 0.25, 1800 kg/m3"
  std::string doubt = {};  ///< what the homogenisation that found it was not content with; or empty
  std::shared_ptr<const Grading> grading = {};  ///< null: the same everywhere

  Solid at(int cell) const { return grading ? grading->of_cell[cell] : Solid{stiffness, density}; }
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
WaveSpeeds wave_speeds(const Solid& solid, double nx, double ny);
WaveSpeeds wave_speeds(const Material& material, double nx, double ny);

/// Whether ν of the nearest isotropic solid exceeds .49: with a plane bulk modulus of more than fifty shear
/// moduli, linear triangles and fully integrated quadrilaterals lock.
bool nearly_incompressible(const Eigen::Matrix3d& stiffness);
/// The same anywhere in a region.
bool nearly_incompressible(const Material& material);

Schema material_schema();

/// One material a region, in the order of `regions`. `material_all_…` (or `material_file`) serves every
/// region that has none of its own. Throws UserError for a region without material, a value missing, out of
/// range or given twice, a stiffness that is not positive definite, and a formula of the place.
std::vector<Material> read_materials(const Options& options, const std::vector<std::string>& regions);

/// The same for a body whose constants may be formulas of the place. Throws UserError where one makes, in a
/// cell, what its option may not be. Collective.
std::vector<Material> read_materials(const Options& options, const Mesh& mesh);

}  // namespace slipscale
