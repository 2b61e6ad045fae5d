#include <algorithm>
#include <limits>

#include "gmsh_fault.hpp"
#include "slipscale/base/print.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

std::string at(const Vector2& x) { return format("({:g}, {:g}) m", x[0], x[1]); }

Vector2 centre(const CellGeometry& cell) {
  Vector2 sum{};
  for (std::size_t k = 0; k < cell.size(); ++k)
    sum = {sum[0] + cell.corners[k][0], sum[1] + cell.corners[k][1]};
  const double n = static_cast<double>(cell.size());
  return {sum[0] / n, sum[1] / n};
}

/// What is measured on rank 0 and told to all.
class Survey {
 public:
  explicit Survey(Whole& whole) : whole_(whole), mesh_(whole.plain) {}

  void run() {
    regions();
    cells();
    boundaries();
    for (int axis = 0; axis < 2; ++axis) whole_.periodic[axis] = shifts_[axis] > 0.5 * whole_.shortest_edge;
  }

 private:
  void regions() {
    region_of_.assign(mesh_.cells.size(), -1);
    for (std::size_t r = 0; r < whole_.regions.size(); ++r) {
      Region& region = whole_.regions[r];
      for (const PetscInt cell : mesh_.region_cells[r]) {
        int& known = region_of_[cell];
        if (known >= 0)
          throw GmshFault(": cell at " + at(centre(mesh_.cell(cell))) + " belongs to both regions '" +
                          whole_.regions[known].name + "' and '" + region.name +
                          "'; leave it in one physical surface");
        known = static_cast<int>(r);
        ++region.cells;
      }
      if (region.cells == 0)
        throw GmshFault(": region '" + region.name +
                        "' holds no cell; remove this physical surface or mesh it");
    }
  }

  void cells() {
    whole_.lower.fill(std::numeric_limits<double>::max());
    whole_.upper.fill(-std::numeric_limits<double>::max());
    whole_.shortest_edge = std::numeric_limits<double>::max();
    whole_.cell_count = static_cast<PetscInt>(mesh_.cells.size());
    whole_.node_count = static_cast<PetscInt>(mesh_.position.size());
    for (PetscInt cell = 0; cell < whole_.cell_count; ++cell) check(cell);
  }

  void check(PetscInt cell) {
    const CellGeometry shape = mesh_.cell(cell);
    const std::size_t n = shape.size();
    double longest = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vector2 &a = shape.corners[k], &b = shape.corners[(k + 1) % n];
      const double edge = std::hypot(b[0] - a[0], b[1] - a[1]);
      longest = std::max(longest, edge);
      whole_.shortest_edge = std::min(whole_.shortest_edge, edge);
      const Vector2& home = mesh_.position[shape.vertices[k]];
      for (int axis = 0; axis < 2; ++axis) {
        whole_.lower[axis] = std::min(whole_.lower[axis], a[axis]);
        whole_.upper[axis] = std::max(whole_.upper[axis], a[axis]);
        if (a[axis] != home[axis]) shifts_[axis] = std::max(shifts_[axis], std::abs(a[axis] - home[axis]));
      }
    }
    // Relative to its longest edge, so that a mesh in millimetres or metres is judged alike.
    const double smallest = shape.smallest_corner();
    if (!(smallest > 1e-9 * longest * longest))  // not a number counts as well
      throw GmshFault(": the cell at " + at(centre(shape)) +
                      (smallest < 0
                           ? " is inverted (its corners do not run counter-clockwise, or it is not convex)"
                           : " is degenerate (it has next to no area)") +
                      "; mend the mesh");
    if (region_of_[cell] < 0)
      throw GmshFault(": the cell at " + at(centre(shape)) +
                      " belongs to no region; put its surface in a Physical Surface (known: " +
                      names(whole_.regions) + ")");
    whole_.regions[region_of_[cell]].area += shape.area();
  }

  void boundaries() {
    for (std::size_t b = 0; b < whole_.boundaries.size(); ++b) {
      Boundary& boundary = whole_.boundaries[b];
      const BoundarySides& found = mesh_.boundaries[b];
      boundary.interior = found.interior;
      boundary.edge_count = static_cast<PetscInt>(found.sides.size());
      if (found.sides.empty())
        throw GmshFault(": boundary '" + boundary.name +
                        "' holds no edge; remove this physical curve or mesh it");
      Vector2 sum{};
      for (const CellSide& side : found.sides) {
        const Vector2 outward = mesh_.cell(side.cell).outward(side.corner);
        sum = {sum[0] + outward[0], sum[1] + outward[1]};
        boundary.length += std::hypot(outward[0], outward[1]);
      }
      const double size = std::hypot(sum[0], sum[1]);
      if (!boundary.interior && size > 1e-6 * boundary.length)
        boundary.normal = {sum[0] / size, sum[1] / size};
    }
  }

  static std::string names(const std::vector<Region>& regions) {
    std::string list;
    for (const auto& region : regions) list += (list.empty() ? "" : ", ") + region.name;
    return list;
  }

  Whole& whole_;
  const PlainMesh& mesh_;
  std::vector<int> region_of_;  ///< by cell
  Vector2 shifts_{};  ///< largest distance between a corner and its vertex: the period, where there is one
};

}  // namespace

void survey(Whole& whole) { Survey(whole).run(); }

}  // namespace slipscale::mesh_stages
