#pragma once

#include <string>

#include "block_mesh.hpp"
#include "slipscale/dynamics/sliding_body.hpp"
#include "slipscale/mesh/read.hpp"

namespace slipscale::testing_support {

/// Writes a block to a scratch file and reads it back as a partitioned mesh.
Mesh block_mesh(const Block& block, Partitioner partitioner = Partitioner::metis, int refine = 0);

Material isotropic(double young, double poisson, double density);

/// Value at the owned node nearest to `x`, the same on every rank: component `axis` of `field` [owned].
double value_near(const Mesh& mesh, const Vector2* field, const Vector2& x, int axis);

/// Sum over the boundary's nodes of the force of the body on its support, x and y, N/m. Collective.
Vector2 support_force(const SlidingBody& body, const std::string& boundary);

/// Scene R (science, section 8): a homogeneous block pressed at its top on a fast surface. Units SI.
Scene scene_r();
Material scene_r_material();

}  // namespace slipscale::testing_support
