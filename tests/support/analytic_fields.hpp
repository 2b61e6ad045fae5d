#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "block_mesh.hpp"
#include "slipscale/mesh/mesh.hpp"

/// Fields that a reader can check from coordinates alone; of period 1 along x.
namespace slipscale::analytic {

inline double u_x(double x, double y, double t) { return std::sin(2 * std::numbers::pi * x) * (1 + y) + t; }
inline double u_y(double x, double y, double) { return std::cos(2 * std::numbers::pi * x) - 2 * y; }

struct Fields {
  std::vector<double> u, v, stress;
};

/// u and v at all local nodes, v = -u; stress = (x, y, t) at the centres of all local cells.
inline Fields fields(const Mesh& mesh, double t) {
  Fields f;
  for (const auto& x : mesh.nodes.position) {
    f.u.insert(f.u.end(), {u_x(x[0], x[1], t), u_y(x[0], x[1], t)});
    f.v.insert(f.v.end(), {-u_x(x[0], x[1], t), -u_y(x[0], x[1], t)});
  }
  const Cells& cells = mesh.cells;
  for (int cell = 0; cell < cells.size(); ++cell) {
    Vector2 centre{};
    for (int k = cells.first[cell]; k < cells.first[cell + 1]; ++k)
      for (int d = 0; d < 2; ++d) centre[d] += cells.corners[k][d] / cells.corner_count(cell);
    f.stress.insert(f.stress.end(), {centre[0], centre[1], t});
  }
  return f;
}

struct Case {
  std::string name;
  testing_support::Block block;
};

inline std::vector<Case> cases() {
  using testing_support::Shape;
  const auto regions = [](double x, double y) { return x > 0.4 && y > 0.3 ? 2 : 1; };
  testing_support::Block block;
  block.nx = 9;
  block.ny = 5;
  block.height = 0.5;
  block.distortion = 0.1;
  block.region = regions;
  std::vector<Case> all;
  for (bool torus : {false, true})
    for (auto [name, shape] :
         {std::pair("triangles", Shape::triangles), std::pair("quadrilaterals", Shape::quadrilaterals),
          std::pair("mixed", Shape::mixed)}) {
      block.periodic_x = torus;
      block.shape = shape;
      all.push_back({std::string(torus ? "torus-" : "") + name, block});
    }
  return all;
}

}  // namespace slipscale::analytic
