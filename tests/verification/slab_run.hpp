#pragma once

#include <vector>

#include "slab_determinant.hpp"

namespace slipscale::testing_support {

/// How a slab is put on a mesh and in time: 2π m of its length, Q1 elements, square up to the rounding of the
/// number of layers. The defaults suit growth rates for k = 1/m, c_s = 1 m/s.
struct SlabMesh {
  int elements = 128;              ///< along the length
  double seed_wavelength = 0;      ///< m; 0: the length
  double end = 40;                 ///< s
  double sample_interval = 0.125;  ///< s
};

/// What the bottom did: u_x of its nodes along x at the sampled times, the same bits on any number of ranks.
struct SlabMotion {
  double interval = 0, time_step = 0;             ///< s
  std::vector<std::vector<double>> displacement;  ///< [samples][nodes], m
  bool always_slipping = true;

  /// Amplitude of exp(i k x) in the bottom's u_x, whole wave number k, at the samples from `start` s on.
  std::vector<Complex> component(int wave_number, double start) const;
};

/// The library's answer to a small wave on the uniform sliding state: v_x = ε cos(2πx/λ)(1 − y/H)² at t = 0;
/// Δt = .4 · 2/ω_max of the undamped body.
SlabMotion run_slab(const SlidingSlab& slab, const SlabMesh& mesh);

/// Exponents p of Σ A exp(pt) in an evenly sampled series, by the matrix pencil (Hua and Sarkar, IEEE Trans.
/// ASSP 38 (1990) 814); singular values below `noise` of the largest are dropped.
std::vector<Complex> exponents(const std::vector<Complex>& series, double interval, double noise);

/// The one of `found` nearest to `expected`.
Complex nearest(const std::vector<Complex>& found, Complex expected);

}  // namespace slipscale::testing_support
