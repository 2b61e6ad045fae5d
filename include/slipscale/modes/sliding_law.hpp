#pragma once

#include <complex>
#include <optional>

#include "slipscale/contact/law_at_node.hpp"
#include "slipscale/dynamics/scene.hpp"

namespace slipscale {

using Complex = std::complex<double>;

/// The time step of the beta2 scheme, where its own modes are asked for.
struct SchemeStep {
  double step = 0;  ///< Δt, s
  double beta2 = 0.5;
};

/// What the time law makes of a perturbation u e^{pt} of steady sliding:
///     N(p) u = [K + q(p) M − μ φ(p) G + δ(p) D] u = 0
/// In continuous time q = (p² + ap)/(1 + bp) and φ = 1/(1 + pT), for (1 + pT)[p²M + p(aM + bK) + K] u =
/// μ(1 + bp) G u over 1 + bp and 1 + pT: Rayleigh damping a, b; the traction relaxes to μp in the time T,
/// which is 0 for Coulomb's law. In full slip the threshold plays no part; `rate: slip` has T = L/(|V| + V*),
/// because a perturbation of T multiplies ds/dt, which is 0 in the steady state.
///
/// Where the coefficient depends on the slip rate, D = diag(μ'(V) λ) at the x of closed nodes and δ = pφ/(1 +
/// bp): falling friction damps negatively. G has the coefficients of the nodes, over μ, where they differ.
///
/// In the scheme (dynamics/scheme.hpp) u_n = zⁿ u with z = e^{pΔt}, and with the stiffness damping that lags,
///     κ = 1 + (b/Δt)(1 − 1/z),  q = (z − 1)²/(Δt² [1 + (β2 + ½)(z − 1)]) (1 + aΔt/(z − 1))/κ,
///     φ = [(1 − g) + (g − e)/z]/(1 − e/z)
/// with e and g of `relaxation` (contact/friction.hpp): λ_n = κ (Ku)_y, since the y of a closed node rests.
/// The slip rate of a step is V − w_n: δ = (1 − e)/(1 − e/z) (z − 1)/(Δt [1 + (β2 + ½)(z − 1)])/κ.
struct SlidingLaw {
  double coefficient = 0;  ///< μ
  double time = 0;         ///< T, s
  Damping damping;
  std::optional<SchemeStep> scheme{};

  struct Value {
    Complex inertia;   ///< q, 1/s²
    Complex friction;  ///< μφ
    Complex slip{};    ///< δ, 1/s
  };
  Value at(Complex p) const;
  /// Its derivative, by central differences: for Newton's method, whose limit does not depend on it.
  Value slope_at(Complex p) const;
};

/// In continuous time.
SlidingLaw sliding_law(const Scene& scene);

/// μ of a law that serves all nodes: their coefficients are their weights times it, see ClosedNode.
double reference_coefficient(const Scene& scene);
/// Coefficient of steady sliding at a node, and its derivative by the slip rate, s/m.
struct SteadyCoefficient {
  double value = 0, slope = 0;
};
SteadyCoefficient steady_coefficient(const Scene& scene, const ContactPlace& node);

}  // namespace slipscale
