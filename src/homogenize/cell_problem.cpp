#include "slipscale/homogenize/cell_problem.hpp"

#include <cmath>

#include "cell_means.hpp"
#include "cell_outline.hpp"
#include "cell_solver.hpp"
#include "cell_system.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/homogenize/effective.hpp"

namespace slipscale {
namespace {

void hold_first_node(const Mesh& mesh, CellSystem& system) {
  for (int i = 0; i < mesh.nodes.owned; ++i)
    if (mesh.nodes.number[i] == 0)
      for (int axis = 0; axis < 2; ++axis) system.hold(i, axis);
}

/// Holds one more component, at the outer node farthest from the first one, so that the body cannot turn.
void hold_rotation(MPI_Comm comm, const Mesh& mesh, CellSystem& system) {
  Vector2 origin{};
  for (int i = 0; i < mesh.nodes.owned; ++i)
    if (mesh.nodes.number[i] == 0) origin = mesh.nodes.position[i];
  MPI_Allreduce(MPI_IN_PLACE, origin.data(), 2, MPI_DOUBLE, MPI_SUM, comm);
  struct {
    double distance;
    int number;
  } farthest{-1, 0};
  const auto distance = [&](int i) {
    return std::hypot(mesh.nodes.position[i][0] - origin[0], mesh.nodes.position[i][1] - origin[1]);
  };
  for (int i = 0; i < mesh.nodes.owned; ++i)
    if (distance(i) > farthest.distance) farthest = {distance(i), static_cast<int>(mesh.nodes.number[i])};
  MPI_Allreduce(MPI_IN_PLACE, &farthest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm);
  for (int i = 0; i < mesh.nodes.owned; ++i)
    if (mesh.nodes.number[i] == farthest.number) {
      const Vector2& x = mesh.nodes.position[i];
      system.hold(i, std::abs(x[0] - origin[0]) >= std::abs(x[1] - origin[1]) ? 1 : 0);
    }
}

void hold_supports(MPI_Comm comm, const Mesh& mesh, CellBoundary boundary,
                   const std::vector<OuterEdge>& outer, CellSystem& system) {
  if (boundary == CellBoundary::kubc) {
    for (const OuterEdge& edge : outer)
      for (int node : edge.nodes)
        if (node < mesh.nodes.owned)
          for (int axis = 0; axis < 2; ++axis) system.hold(node, axis);
    return;
  }
  hold_first_node(mesh, system);
  if (boundary == CellBoundary::subc) hold_rotation(comm, mesh, system);
}

Eigen::Vector3d unit(int load_case) { return Eigen::Vector3d::Unit(load_case); }

/// Unit strain as homogeneous part of the displacement, or unit stress as tractions.
void apply(int load_case, const Mesh& mesh, CellBoundary boundary, const std::vector<OuterEdge>& outer,
           CellSystem& system) {
  if (boundary != CellBoundary::subc) {
    system.set_strain(unit(load_case));
    return;
  }
  const Eigen::Vector3d stress = unit(load_case);
  std::fill_n(system.external_force(), mesh.nodes.owned, Vector2{});
  for (const OuterEdge& edge : outer)
    for (int node : edge.nodes)
      if (node < mesh.nodes.owned) {
        Vector2& force = system.external_force()[node];
        force[0] += 0.5 * (stress[0] * edge.outward[0] + stress[2] * edge.outward[1]);
        force[1] += 0.5 * (stress[2] * edge.outward[0] + stress[1] * edge.outward[1]);
      }
}

/// Euclidean norm of the nodal forces of single elements under a unit load, about: stress times the square
/// root of the area, N/m.
double force_size(const Mesh& mesh, const std::vector<Material>& materials, CellBoundary boundary) {
  double stress = boundary == CellBoundary::subc ? 1 : 0;
  if (boundary != CellBoundary::subc)
    for (const Material& material : materials)
      stress = std::max(stress, material.stiffness.diagonal().maxCoeff());
  return stress * std::sqrt(mesh.area());
}

/// Names of nearly incompressible regions that are meshed in triangles, in part at least.
std::vector<std::string> locking_regions(MPI_Comm comm, const Mesh& mesh,
                                         const std::vector<Material>& materials) {
  std::vector<int> triangles(mesh.regions.size(), 0);
  for (int element = 0; element < mesh.cells.size(); ++element)
    if (mesh.cells.corner_count(element) == 3) triangles[mesh.cells.region[element]] = 1;
  MPI_Allreduce(MPI_IN_PLACE, triangles.data(), static_cast<int>(triangles.size()), MPI_INT, MPI_MAX, comm);
  std::vector<std::string> names;
  for (std::size_t k = 0; k < triangles.size(); ++k)
    if (triangles[k] && nearly_incompressible(materials[k].stiffness)) names.push_back(mesh.regions[k].name);
  return names;
}

void refuse_mechanism(const Mesh& mesh, const CellSolution& solution) {
  constexpr double nothing = 1e-10;
  if (solution.holes.count > 0 && excess(solution.stiffness, Eigen::Matrix3d::Zero()) < nothing)
    throw UserError(format(
        "the cell of '{}' bears no load in some direction: its holes leave a mechanism (parts that hang "
        "by one node, or a pore from side to side); connect the solid",
        mesh.file));
}

}  // namespace

const char* name(CellBoundary boundary) {
  switch (boundary) {
    case CellBoundary::periodic:
      return "periodic";
    case CellBoundary::kubc:
      return "kubc";
    case CellBoundary::subc:
      return "subc";
  }
  return "";
}

CellSolution solve_cell(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials,
                        CellBoundary boundary) {
  const CellOutline outline = cell_outline(comm, mesh, boundary);
  CellSystem system(comm, mesh, materials);
  hold_supports(comm, mesh, boundary, outline.outside, system);
  CellSolver solver(comm, system, force_size(mesh, materials, boundary));
  CellSolution solution;
  solution.boundary = boundary;
  solution.set_up_seconds = solver.set_up_seconds();
  solution.solver = solver.description();
  for (const std::string& idle : solver.idle_options())
    solution.notes.push_back(idle + " is idle: the cell is solved directly (" + solution.solver + ")");
  solution.locking = locking_regions(comm, mesh, materials);
  solution.unknowns = 2 * mesh.nodes.total;
  CellMeans means(comm, system, outline);
  for (int k = 0; k < load_cases; ++k) {
    apply(k, mesh, boundary, outline.outside, system);
    solution.cost[k] = solver.solve(k);
    means.add(k);
  }
  means.finish(solution);
  if (boundary == CellBoundary::subc) per_unit_strain(solution);
  refuse_mechanism(mesh, solution);
  return solution;
}

}  // namespace slipscale
