#pragma once

#include <Eigen/Dense>
#include <complex>
#include <functional>

namespace slipscale::testing_support {

using Complex = std::complex<double>;

/// A slab 0 < y < H whose top is held and whose bottom slides everywhere on a rigid surface that moves along
/// +x. Perturbations of the uniform sliding state are u(y) exp(ikx + pt).
struct SlidingSlab {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  ///< Voigt (xx, yy, xy), engineering shear, Pa
  double density = 1;                                   ///< kg/m³
  double height = 1;                                    ///< H, m
  double wave_number = 1;                               ///< k, 1/m
  double friction = 0;                                  ///< μ
  double relaxation_time = 0;                           ///< T of the regularised law, s; 0 is Coulomb
  double damping = 0;                                   ///< b, stiffness damping, s

  double shear_speed() const;  ///< √(C66/ρ), m/s
};

/// Zero where p [1/s] belongs to a mode: u_x = u_y = 0 at the top, u_y = 0 and σ_xy = μ/(1 + pT) σ_yy at the
/// bottom; the damping multiplies every modulus by 1 + bp. Any anisotropy of the plane: the four vertical
/// wave numbers kη come from Christoffel's quartic equation. The 4 × 4 determinant is divided by
/// Π(η_i − η_j), so that it is analytic in p and has no zeros where two η coincide.
Complex slab_determinant(const SlidingSlab& slab, Complex p);

/// The same for an isotropic solid, from its two potentials with decay rates √(k² + p²/c²): another
/// derivation, with false zeros at p = 0 and p = ±ikc.
Complex potential_determinant(const SlidingSlab& slab, Complex p);

/// The zero of an analytic function near `start`, by Muller's method (D. E. Muller, Math. Comp. 10 (1956)
/// 208). NaN when it does not settle.
Complex zero_near(const std::function<Complex(Complex)>& function, Complex start);

/// The mode near `start`; growth rate and frequency over k c_s: s = p/(k c_s).
Complex scaled_mode(const SlidingSlab& slab, Complex start);

}  // namespace slipscale::testing_support
