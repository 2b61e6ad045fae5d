#include "cells_composite.hpp"

#include <cmath>
#include <numbers>

#include "slipscale/base/parallel.hpp"

namespace slipscale::testing_support {
namespace {

Recipe discs(double height, double fraction, int elements, CellShape shape) {
  Recipe recipe;
  recipe.room.block.upper = {1, height};
  recipe.room.periodic = {true, true};
  Family family;
  family.region = "inclusion";
  family.fraction = fraction;
  recipe.families = {family};
  const double size = 1.0 / elements;
  recipe.mesh.size = {size, size, size, 0};
  recipe.mesh.cell = shape;
  recipe.mesh.worst_angle = 10 * std::numbers::pi / 180;
  recipe.room.gap = recipe.room.clearance = recipe.repair = size;
  return recipe;
}

}  // namespace

Recipe disc_array(Arrangement arrangement, double fraction, int elements, CellShape shape) {
  const bool hexagonal = arrangement == Arrangement::hexagonal;
  Recipe recipe = discs(hexagonal ? std::numbers::sqrt3 : 1, fraction, elements, shape);
  recipe.array = {arrangement, 1, hexagonal ? 2 : 1, 0};
  recipe.composite = Composite::array;
  return recipe;
}

Recipe random_discs(double fraction, double diameter, int elements, CellShape shape) {
  Recipe recipe = discs(1, fraction, elements, shape);
  recipe.families.front().diameter = diameter;
  recipe.composite = Composite::random;
  recipe.seed = 1;
  return recipe;
}

std::string drawn_file(const Recipe& recipe) {
  const std::string path = scratch("composite.msh");
  std::string fault;
  if (is_root(PETSC_COMM_WORLD)) {
    try {
      GmshModel gmsh;
      write_mesh(recipe, compose(recipe, gmsh), gmsh, path);
    } catch (const std::exception& error) {
      fault = error.what();
    }
  }
  throw_together(PETSC_COMM_WORLD, fault);
  return path;
}

Mesh drawn_mesh(const Recipe& recipe) { return read_mesh(PETSC_COMM_WORLD, {drawn_file(recipe)}); }

}  // namespace slipscale::testing_support
