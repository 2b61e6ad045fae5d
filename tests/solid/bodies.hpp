#pragma once

#include <cmath>
#include <ostream>
#include <vector>

#include "scenes.hpp"

namespace slipscale::testing_support {

/// Full anisotropy: every one of the six numbers matters. Positive definite: diagonally dominant.
inline Material anisotropic() {
  Material material{{}, 2700, "anisotropic"};
  material.stiffness << 60e9, 15e9, 8e9, 15e9, 45e9, -5e9, 8e9, -5e9, 20e9;
  return material;
}

/// Matrix and inclusion: one isotropic, one anisotropic.
inline std::vector<Material> two_materials() { return {isotropic(30e9, 0.25, 1800), anisotropic()}; }

struct Body {
  Shape shape;
  bool periodic;
};

inline std::vector<Body> all_bodies() {
  std::vector<Body> bodies;
  for (Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed})
    for (bool periodic : {false, true}) bodies.push_back({shape, periodic});
  return bodies;
}

inline std::ostream& operator<<(std::ostream& out, const Body& body) {
  return out << "shape " << static_cast<int>(body.shape) << (body.periodic ? ", periodic" : "");
}

/// 12 by 8 distorted cells on 3 mm × 1.5 mm, the right half an inclusion.
inline Block block_of(const Body& body) {
  Block block;
  block.nx = 12;
  block.ny = 8;
  block.width = 3e-3;
  block.height = 1.5e-3;
  block.shape = body.shape;
  block.periodic_x = body.periodic;
  block.distortion = 0.2;
  block.region = [](double x, double) { return x < 1.5e-3 ? 1 : 2; };
  return block;
}

/// A field that depends on the node's number in the whole mesh only; rough, with many digits.
inline Vector2 rough(PetscInt number) {
  const auto n = static_cast<double>(number);
  return {1e-6 * std::sin(12.9898 * n + 1), 1e-6 * std::sin(78.233 * n + 2)};
}

inline std::vector<Vector2> rough_field(const Nodes& nodes) {
  std::vector<Vector2> u;
  for (PetscInt number : nodes.number) u.push_back(rough(number));
  return u;
}

}  // namespace slipscale::testing_support
