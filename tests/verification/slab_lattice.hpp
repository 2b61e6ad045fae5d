#pragma once

#include <vector>

#include "slab_determinant.hpp"

namespace slipscale::testing_support {

/// The slab on a mesh that repeats along x: Q1 elements of width and height `spacing`, lumped mass,
/// continuous time.
struct SlabLattice {
  SlidingSlab slab;  ///< its wave number counts; its height gives the number of layers
  double spacing;    ///< h, m
};

/// All exponents p [1/s] of waves u_j exp(ikx + pt) on the lattice that slide everywhere, from the eigenvalue
/// problem of one column of nodes: M p² u = −K(kh) u + e φ with T p φ = μλ − φ, λ the force that keeps the
/// bottom on the surface. Undamped.
std::vector<Complex> lattice_modes(const SlabLattice& lattice);

/// The one that grows fastest.
Complex fastest(const std::vector<Complex>& modes);

/// What the exponent p becomes when central difference with the step Δt [s] takes the place of time.
Complex with_time_step(Complex p, double time_step);

}  // namespace slipscale::testing_support
