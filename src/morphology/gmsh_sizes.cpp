#include <gmsh.h>

#include <cmath>

#include "gmsh_geometry.hpp"

namespace slipscale::in_gmsh_model {

void set(const char* option, double value) { gmsh::option::setNumber(option, value); }

void set_sizes(const SizeField& field, const MeshSize& size) {
  set("Mesh.MeshSizeFromPoints", 0);
  set("Mesh.MeshSizeExtendFromBoundary", 0);
  set("Mesh.MeshSizeMax", size.bulk);
  set("Mesh.MeshSizeMin", 0);
  if (!field.uniform())
    gmsh::model::mesh::setSizeCallback([&field](int, int, double x, double y, double) {
      return field({x, y});
    });
}

double expected_triangles(const SizeField& field, const Box& block) {
  constexpr int samples = 100;
  double sum = 0;
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const double length = field({block.lower[0] + (i + 0.5) / samples * block.width(),
                                   block.lower[1] + (j + 0.5) / samples * block.height()});
      sum += 4 / std::sqrt(3) / (length * length);
    }
  return sum * block.width() * block.height() / (samples * samples);
}

void recombine(std::size_t faces, double triangles) {
  constexpr double most_for_blossom = 2e5;
  set("Mesh.RecombinationAlgorithm", triangles > most_for_blossom ? 0 : 1);
  for (std::size_t face = 1; face <= faces; ++face)
    gmsh::model::mesh::setRecombine(2, static_cast<int>(face));
}

}  // namespace slipscale::in_gmsh_model
