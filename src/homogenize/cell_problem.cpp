#include "slipscale/homogenize/cell_problem.hpp"

#include <cmath>

#include "cell_fit.hpp"
#include "cell_solver.hpp"
#include "cell_system.hpp"
#include "slipscale/mesh/outer_boundary.hpp"
#include "slipscale/mesh/shape_functions.hpp"
#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

/// Where the whole mesh's first node is, and what the other ranks need to know of it.
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

struct CellGeometryView {
  std::span<const Vector2> corners;
  int first;
  double area;
};

CellGeometryView view(const Mesh& mesh, int cell) {
  const auto corners = mesh.cells.corners_of(cell);
  return {corners, mesh.cells.first[cell], cell_area(corners)};
}

/// Mean strain of a cell: by Gauss's theorem from its edges, on which the displacement is linear.
Eigen::Vector3d mean_strain(const CellGeometryView& cell, const CellSystem& system) {
  Eigen::Vector3d strain = Eigen::Vector3d::Zero();
  const int count = static_cast<int>(cell.corners.size());
  for (int i = 0; i < count; ++i) {
    const int j = (i + 1) % count;
    const Vector2 &a = cell.corners[i], &b = cell.corners[j];
    const Vector2 outward{b[1] - a[1], a[0] - b[0]};
    const Vector2 ua = system.displacement(cell.first + i), ub = system.displacement(cell.first + j);
    const double ux = 0.5 * (ua[0] + ub[0]), uy = 0.5 * (ua[1] + ub[1]);
    strain +=
        Eigen::Vector3d{ux * outward[0], uy * outward[1], ux * outward[1] + uy * outward[0]} / cell.area;
  }
  return strain;
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

void add_all(MPI_Comm comm, Eigen::Matrix3d& sum) {
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 9, MPI_DOUBLE, MPI_SUM, comm);
}

/// What a displacement under load case k contributes: column k of every mean.
void measure(const Mesh& mesh, const std::vector<Material>& materials, const CellSystem& system, int k,
             CellSolution& solution, std::vector<Eigen::Matrix<double, 8, load_cases>>& displacements) {
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const CellGeometryView geometry = view(mesh, cell);
    const Eigen::Vector3d strain = mean_strain(geometry, system);
    solution.localisation[cell].col(k) = strain;
    for (std::size_t c = 0; c < geometry.corners.size(); ++c) {
      const Vector2 u = system.displacement(geometry.first + static_cast<int>(c));
      displacements[cell](2 * static_cast<int>(c), k) = u[0];
      displacements[cell](2 * static_cast<int>(c) + 1, k) = u[1];
    }
    if (!mesh.cells.owned[cell]) continue;
    solution.mean_localisation.col(k) += geometry.area * strain;
    solution.stiffness.col(k) += geometry.area * (materials[mesh.cells.region[cell]].stiffness * strain);
  }
}

Eigen::Matrix3d energy(const Mesh& mesh, const std::vector<Material>& materials,
                       const std::vector<Eigen::Matrix<double, 8, load_cases>>& displacements) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    if (!mesh.cells.owned[cell]) continue;
    const CellGeometryView geometry = view(mesh, cell);
    const auto rows = 2 * static_cast<Eigen::Index>(geometry.corners.size());
    const auto u = displacements[cell].topRows(rows);
    sum +=
        u.transpose() * element_stiffness(geometry.corners, materials[mesh.cells.region[cell]].stiffness) * u;
  }
  return sum;
}

/// Under unit stresses the means give the compliance; what was found per unit stress becomes per unit strain.
void per_unit_strain(CellSolution& solution) {
  const Eigen::Matrix3d per_strain = solution.mean_localisation.inverse();
  for (Eigen::Matrix3d& a : solution.localisation) a = (a * per_strain).eval();
  solution.stiffness = (solution.stiffness * per_strain).eval();
  solution.energy_stiffness = (per_strain.transpose() * solution.energy_stiffness * per_strain).eval();
  solution.mean_localisation = (solution.mean_localisation * per_strain).eval();
}

}  // namespace

std::vector<Eigen::Matrix3d> phase_means(MPI_Comm comm, const Mesh& mesh, const CellSolution& solution) {
  std::vector<Eigen::Matrix3d> means(mesh.regions.size(), Eigen::Matrix3d::Zero());
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    if (mesh.cells.owned[cell])
      means[mesh.cells.region[cell]] += view(mesh, cell).area * solution.localisation[cell];
  for (std::size_t k = 0; k < means.size(); ++k) {
    add_all(comm, means[k]);
    means[k] /= mesh.regions[k].area;
  }
  return means;
}

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
  const std::vector<OuterEdge> outer = outer_edges(mesh);
  refuse_unfit(comm, mesh, boundary, outer);
  CellSystem system(comm, mesh, materials);
  hold_supports(comm, mesh, boundary, outer, system);
  CellSolver solver(comm, system, force_size(mesh, materials, boundary));
  CellSolution solution;
  solution.boundary = boundary;
  solution.set_up_seconds = solver.set_up_seconds();
  solution.solver = solver.description();
  solution.unknowns = 2 * mesh.nodes.total;
  solution.localisation.resize(static_cast<std::size_t>(mesh.cells.size()));
  std::vector<Eigen::Matrix<double, 8, load_cases>> displacements(
      static_cast<std::size_t>(mesh.cells.size()));
  for (int k = 0; k < load_cases; ++k) {
    apply(k, mesh, boundary, outer, system);
    solution.cost[k] = solver.solve(k);
    measure(mesh, materials, system, k, solution, displacements);
  }
  solution.energy_stiffness = energy(mesh, materials, displacements);
  const double area = mesh.area();
  for (Eigen::Matrix3d* mean :
       {&solution.stiffness, &solution.energy_stiffness, &solution.mean_localisation}) {
    add_all(comm, *mean);
    *mean /= area;
  }
  if (boundary == CellBoundary::subc) per_unit_strain(solution);
  return solution;
}

}  // namespace slipscale
