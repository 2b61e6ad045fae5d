#pragma once

#include <cstdint>
#include <limits>

#include "slipscale/morphology/recipe.hpp"

namespace slipscale::testing_support {

inline constexpr double length = 5e-3, size = 0.12e-3, degree = 0.017453292519943295;

inline Family family(slipscale::Shape shape, double fraction, double diameter) {
  Family f;
  f.region = "inclusion";
  f.shape = shape;
  f.fraction = fraction;
  f.diameter = diameter;
  f.diameter_deviation = 0.15;
  if (shape == slipscale::Shape::disc) return f;
  f.aspect = 2;
  f.rounding = 0.6;
  f.angle_deviation = std::numeric_limits<double>::infinity();
  return f;
}

inline Recipe empty_recipe(std::uint64_t seed) {
  Recipe recipe;
  recipe.room.block.upper = {length, length};
  recipe.mesh.size = {size, size, size, 0};
  recipe.mesh.worst_angle = 15 * degree;
  recipe.mesh.cell = seed % 3 == 2 ? CellShape::quadrilateral : CellShape::triangle;
  recipe.room.periodic = {seed % 4 >= 1, seed % 4 == 3};
  recipe.room.edge = seed % 8 < 4 ? Edge::cut : Edge::inside;
  recipe.room.keep_out = seed % 4 == 2 ? 0.2e-3 : 0;
  recipe.room.gap = recipe.room.clearance = size;
  recipe.repair = size;
  recipe.seed = seed;
  return recipe;
}

/// One of all shapes, arrangements, sides and cells by its seed.
inline Recipe recipe_of(std::uint64_t seed) {
  Recipe recipe = empty_recipe(seed);
  switch (seed % 7) {
    case 0:
      recipe.families = {family(slipscale::Shape::disc, 0.3, 0.6e-3)};
      break;
    case 1:
      recipe.families = {family(slipscale::Shape::ellipse, 0.25, 0.9e-3)};
      break;
    case 2:
      recipe.families = {family(slipscale::Shape::rectangle, 0.2, 1e-3)};
      break;
    case 3:
      recipe.families = {family(slipscale::Shape::disc, 0.2, 1e-3),
                         family(slipscale::Shape::ellipse, 0.1, 0.8e-3)};
      recipe.families[1].region = "small";
      break;
    case 4:
    case 5:
      recipe.families = {family(seed % 7 == 4 ? slipscale::Shape::disc : slipscale::Shape::ellipse, 0.25, 0)};
      recipe.families[0].angle_deviation = 0;
      recipe.families[0].angle = static_cast<double>(seed % 5) * 20 * degree;
      recipe.array = {seed % 2 ? Arrangement::square : Arrangement::hexagonal, 4, 4, size};
      recipe.composite = Composite::array;
      return recipe;
    default:
      recipe.composite = Composite::laminate;
      recipe.laminate = {0.4, length / 4,
                         recipe.room.periodic[0] ? 0 : static_cast<double>(seed % 9) * 9 * degree};
      return recipe;
  }
  recipe.composite = Composite::random;
  return recipe;
}

}  // namespace slipscale::testing_support
