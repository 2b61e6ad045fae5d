#pragma once

#include <cstdint>

namespace slipscale {

enum class ContactStatus : std::uint8_t { open = 0, stick = 1, slip = 2 };

/// What a contact node remembers from one step to the next; zero when it is open.
struct FrictionMemory {
  double traction = 0;  ///< of the last step; with the regularised threshold the stored strength; Pa
  double pressure = 0;  ///< of the last step, Pa
};

/// What a law answers at a closed node.
struct Friction {
  double traction;  ///< on the body, along +x, Pa
  ContactStatus status;
};

/// What a law is asked at a closed node.
struct FrictionDemand {
  double trial;      ///< τ*, the traction that would make the node stick over the step, Pa
  double pressure;   ///< p > 0, Pa
  double slip_rate;  ///< of the surface relative to the body, m/s; read only where `uses_slip_rate`
};

/// Exact update over one step of ṡ = −(s − μp)/T for a pressure that varies linearly over it:
///     s_n = keep s_{n−1} + μ (now p_n + before p_{n−1})
/// Both weights are ≥ 0, so that the strength never leaves the range of what it relaxes to. Second order in
/// Δt/T; a pressure held over the step would be first order only.
struct Relaxation {
  double keep = 0, now = 1, before = 0;
};

/// The weights for x = Δt/T ≥ 0: e = exp(−x), 1 − g and g − e with g = (1 − e)/x. Infinite x, T = 0, is
/// Coulomb.
Relaxation relaxation(double x);

struct Frictionless {
  static constexpr bool uses_slip_rate = false;
  Friction operator()(const FrictionDemand&, FrictionMemory&) const { return {0, ContactStatus::slip}; }
};

struct Coulomb {
  static constexpr bool uses_slip_rate = false;
  double coefficient;  ///< μ
  Friction operator()(const FrictionDemand& demand, FrictionMemory& memory) const;
};

/// Simplified Prakash-Clifton law: in slip the traction relaxes to μp in the time T instead of jumping,
///     τ̇ = −(τ − μp sign τ*)/T.
/// The law of what is called *the paper* everywhere in this code: G. Peillex, L. Baillet, Y. Berthier,
/// "Homogeneous approach for composite under dynamic contact with friction", IJTC2007-44438, ASME/STLE
/// International Joint Tribology Conference 2007 (see also "Homogenization in non-linear dynamics due to
/// frictional contact", Int. J. Solids Struct. 45 (2008) 2451). After A. Cochard, J. R. Rice, J. Geophys.
/// Res. 105 (2000) 25891. `rate: surface`: T = L*/|V| is one constant. Threshold `instantaneous`, the
/// paper's: sticks while |τ*| ≤ μp(t), the memory is the traction.
struct RegularisedInstantaneous {
  static constexpr bool uses_slip_rate = false;
  double coefficient;
  Relaxation step;
  Friction operator()(const FrictionDemand& demand, FrictionMemory& memory) const;
};

/// Threshold `regularized`: a stored strength relaxes to μp always, stick or slip, and |τ*| is compared with
/// it.
struct RegularisedStrength {
  static constexpr bool uses_slip_rate = false;
  double coefficient;
  Relaxation step;
  Friction operator()(const FrictionDemand& demand, FrictionMemory& memory) const;
};

/// A coefficient that goes from its static to its kinetic value with the slip rate v,
///     μ(v) = μ_k + (μ_s − μ_k) exp(−|v|/V_c),
/// in the law of `RegularisedInstantaneous`: in slip τ̇ = −(τ − μ(v) p sign τ*)/T; a node sticks while |τ*| ≤
/// μ_s p. The slip rate of the step is that in its middle, so that the update is of second order.
///
/// Falling friction without memory is ill-posed: where −μ'(v) p exceeds ρ c_s, the resistance of an elastic
/// half-space to a change of slip rate, all wavelengths grow without bound, the shorter the faster. With T >
/// 0 none grows faster than (−μ' p/(ρ c_s) − 1)/T.
struct Exponential {
  static constexpr bool uses_slip_rate = true;
  double coefficient;  ///< μ_s
  double kinetic;      ///< μ_k
  double slip_rate;    ///< V_c, m/s
  Relaxation step;
  Friction operator()(const FrictionDemand& demand, FrictionMemory& memory) const;
};

/// μ(v) of a slip rate of any sign, and its derivative by |v|, s/m.
double exponential_coefficient(double still, double kinetic, double over, double slip_rate);
double exponential_slope(double still, double kinetic, double over, double slip_rate);

/// `rate: slip`: T = L/(|slip rate| + V*), with either threshold (A. M. Rubin, J.-P. Ampuero, J. Geophys.
/// Res. 112 (2007) B05307).
template <class Threshold>
struct SlipRate {
  static constexpr bool uses_slip_rate = true;
  double coefficient;
  double length;          ///< L, m
  double rate_reference;  ///< V*, m/s
  double time_step;       ///< s
  Friction operator()(const FrictionDemand& demand, FrictionMemory& memory) const {
    const double rate = (demand.slip_rate < 0 ? -demand.slip_rate : demand.slip_rate) + rate_reference;
    return Threshold{coefficient, relaxation(time_step * rate / length)}(demand, memory);
  }
};

}  // namespace slipscale
