#include "fitted_grid.hpp"

#include <cmath>

#include "relief.hpp"
#include "slipscale/morphology/quality.hpp"

namespace slipscale::morphology {
namespace {

std::vector<int> regions_of_parts(const std::vector<Body>& bodies, std::size_t parts) {
  std::vector<int> region(parts);
  for (const Body& body : bodies) region[body.part()] = body.region();
  return region;
}

CompositeMesh mesh_of(const Fit& fit, const std::vector<int>& region) {
  const int columns = fit.lattice.cells(0), rows = fit.lattice.cells(1);
  CompositeMesh mesh;
  mesh.nodes.reserve(static_cast<std::size_t>(columns + 1) * (rows + 1));
  mesh.cells.reserve(static_cast<std::size_t>(columns) * rows + fit.touches.size());
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) mesh.nodes.push_back(fit.position({column, row}));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto places = corners({column, row});
      const Square cut = square(fit, {column, row});
      for (int k = 0; k < cut.count; ++k) {
        const Square::Cell& from = cut.cells[k];
        CompositeMesh::Cell cell{{}, from.count, from.part == nobody ? 0 : region[from.part], from.part};
        for (int i = 0; i < from.count; ++i) {
          const Place& place = places[from.corners[i]];
          cell.corners[i] = place[1] * (columns + 1) + place[0];
        }
        mesh.cells.push_back(cell);
      }
    }
  return mesh;
}

}  // namespace

FittedGrid fitted_grid(const Lattice& lattice, const std::vector<Body>& bodies,
                       const std::vector<double>& drawn, const std::vector<std::string>& regions) {
  FittedGrid grid;
  Fit fitted = fit(lattice, bodies);
  grid.unresolved = fitted.unresolved;
  grid.squeezed = fitted.squeezed;
  if (!grid.unresolved.empty()) return grid;
  grid.relieved = relieve(fitted);
  grid.blunted = fitted.blunted;
  decide_surrounded(fitted);
  correct_areas(fitted, drawn);
  grid.mesh = mesh_of(fitted, regions_of_parts(bodies, drawn.size()));
  grid.mesh.regions = regions;
  return grid;
}

FittedGrid fitted_grid(const Lattice& lattice, const Contour& contour,
                       const std::vector<std::string>& regions, std::optional<double> drawn) {
  const std::vector<Body> none;
  Fit fitted = fit(lattice, none, contour);
  FittedGrid grid;
  grid.unresolved = fitted.unresolved;
  grid.squeezed = fitted.squeezed;
  if (drawn) grid.relieved = relieve(fitted);
  grid.blunted = fitted.blunted;
  decide_surrounded(fitted);
  const auto take_mesh = [&] {
    grid.mesh = mesh_of(fitted, {1});
    grid.mesh.regions = regions;
  };
  take_mesh();
  if (!drawn) return grid;
  constexpr double farthest = 0.05;  // in cells
  const double cell = lattice.step(0) * lattice.step(1),
               missing = std::abs(*drawn - region_areas(grid.mesh)[1]);
  if (missing > farthest * cell * static_cast<double>(fitted.touches.size())) return grid;
  correct_areas(fitted, {*drawn});
  take_mesh();
  return grid;
}

}  // namespace slipscale::morphology
