#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>

#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// Stiffness of a cell, [2 corners, 2 corners], corner-wise (x, y), N/m per metre of depth = Pa.
using ElementStiffness = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 8, 8>;

/// Strain-displacement matrix, [3, 2 corners], rows (xx, yy, xy) with engineering shear, 1/m.
using StrainDisplacement = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 8>;

/// ∫ Bᵀ C B dA of a linear triangle (three corners) or a bilinear quadrilateral (four, 2×2 Gauss points).
/// `corners` run counter-clockwise, m; `elasticity` is [3, 3] in Voigt order (xx, yy, xy), Pa.
ElementStiffness element_stiffness(std::span<const Vector2> corners, const Eigen::Matrix3d& elasticity);

/// The same with the cell's mean dilatation in place of that at each Gauss point (B-bar: Nagtegaal, Parks and
/// Rice, Comput. Methods Appl. Mech. Engng 4 (1974) 153; Hughes, Int. J. Numer. Meth. Engng 15 (1980) 1413):
/// a quadrilateral that does not lock where the solid is nearly incompressible. A linear triangle has but one
/// dilatation, so its stiffness is the same, and it locks.
ElementStiffness mean_dilatation_stiffness(std::span<const Vector2> corners,
                                           const Eigen::Matrix3d& elasticity);

/// ∫ N_i dA, the row sum of the mass matrix over the density, one a corner, m². Unused entries are zero.
std::array<double, 4> corner_areas(std::span<const Vector2> corners);

/// B at the centre of the cell.
StrainDisplacement centre_strain_displacement(std::span<const Vector2> corners);

/// Largest eigenvalue of M⁻¹K of one cell with the row-sum mass of density `density` [kg/m³], 1/s². The
/// largest over all cells bounds that of the whole body from above (B. M. Irons, G. Treharne, "A
/// bound theorem in eigenvalues and its practical applications", 3rd Conf. Matrix Methods in Structural
/// Mechanics, Wright-Patterson Air Force Base, 1971).
double largest_element_eigenvalue(std::span<const Vector2> corners, const Eigen::Matrix3d& elasticity,
                                  double density);

}  // namespace slipscale
