#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/solid/material.hpp"

namespace slipscale {

/// A part of the unit cell made of one material; holes are one without stiffness.
struct Phase {
  std::string region;
  double fraction = 0;  ///< of the unit cell's area
  Material material;

  bool is_empty() const { return material.stiffness.isZero(0); }
};

/// The phases that differ in stiffness, in the order they first appear: regions of one stiffness are one
/// phase, whose name is that of the first.
std::vector<Phase> elastic_phases(const std::vector<Phase>& phases);

double mean_density(const std::vector<Phase>& phases);          ///< kg/m³
Eigen::Matrix3d voigt_bound(const std::vector<Phase>& phases);  ///< ⟨C⟩, Pa
Eigen::Matrix3d reuss_bound(const std::vector<Phase>& phases);  ///< ⟨C⁻¹⟩⁻¹, Pa; 0 with holes

/// Whether C is that of an isotropic solid, to 1e-9 of its size.
bool is_isotropic(const Eigen::Matrix3d& stiffness);

/// Bounds of the plane bulk modulus k = λ + G and the shear modulus G of an isotropic mixture, Pa. For a
/// mixture that is not isotropic they hold for k and for the mean of its two shear moduli (trace bounds:
/// Milton and Kohn, J. Mech. Phys. Solids 36 (1988) 597).
struct HashinShtrikman {
  double bulk_low = 0, bulk_high = 0, shear_low = 0, shear_high = 0;
};

/// Hashin, J. Mech. Phys. Solids 13 (1965) 119, in Walpole's form, which needs no order of the phases; for
/// two isotropic elastic phases in plane strain, absent otherwise.
std::optional<HashinShtrikman> hashin_shtrikman(const std::vector<Phase>& phases);

/// Smallest eigenvalue of a − b over the largest of a: not below zero where a ≥ b as quadratic forms.
double excess(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

/// Largest |C_ij − C_ji| over the largest |C_ij|.
double symmetry_defect(const Eigen::Matrix3d& stiffness);

/// Constants of the effective solid in plane strain, from the symmetric part of C and its inverse S.
struct EngineeringConstants {
  double young_x = 0, young_y = 0;         ///< 1/S11, 1/S22: of a plate that cannot strain out of plane, Pa
  double poisson_xy = 0, poisson_yx = 0;   ///< −S12/S11, −S12/S22
  double shear = 0;                        ///< 1/S66, Pa
  double bulk = 0;                         ///< plane bulk modulus (C11 + C22 + 2 C12)/4, Pa
  double shear_least = 0, shear_most = 0;  ///< over all directions of shear, Pa
  /// Nearest isotropic solid (same k, and G as the mean of the two shear moduli), three-dimensional E and ν.
  double young = 0, poisson = 0;
  double anisotropy = 0;  ///< distance of C to that solid's over the size of C (Frobenius, Mandel's scaling)

  double shear_mean() const { return 0.5 * (shear_least + shear_most); }  ///< Pa
};
EngineeringConstants engineering_constants(const Eigen::Matrix3d& stiffness);

/// The coefficient of friction of a face on which phases with coefficients of their own alternate,
/// `fractions` of its length, once it slides slowly, in contact and in slip everywhere:
///     tan⟨arctan βμ⟩/β,   β = (1 − 2ν)/(2(1 − ν)),
/// for a half-plane of one stiffness whose phases are small against it (derived and tested in
/// tests/verification/friction_of_phases.cpp); less than the mean, since the pressure is less where friction
/// is more. The fractions need not add up to 1.
double effective_friction(const std::vector<double>& fractions, const std::vector<double>& coefficients,
                          double poisson);

/// Residual of f (C₂ − C₁):⟨A⟩₂ = C_eff − C₁ for two phases, over the size of the left side (or a millionth
/// of C_eff, where the phases hardly differ). `mean_second` is ⟨A⟩₂, the mean of A over the second phase.
double two_phase_identity(const std::vector<Phase>& phases, const Eigen::Matrix3d& stiffness,
                          const Eigen::Matrix3d& mean_second);

/// Richardson's estimate from a mesh and its uniform refinement, for the method's order 2.
struct Richardson {
  Eigen::Matrix3d error;         ///< of the coarse mesh's stiffness, signed, Pa
  Eigen::Matrix3d extrapolated;  ///< Pa
};
Richardson richardson(const Eigen::Matrix3d& coarse, const Eigen::Matrix3d& fine);

}  // namespace slipscale
