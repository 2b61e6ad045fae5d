#include "cell_means.hpp"

#include "slipscale/mesh/shape_functions.hpp"

namespace slipscale {
namespace {

/// ∫ ε dA of what an edge with outward normal n (times its length) bounds, of the edge's mean displacement.
Eigen::Vector3d from_edge(double ux, double uy, const Vector2& n) {
  return {ux * n[0], uy * n[1], ux * n[1] + uy * n[0]};
}

/// ∫ ε dA of an element: by Gauss's theorem from its edges, on which the displacement is linear.
Eigen::Vector3d strain_integral(const CellCorners& x, const CellSystem::Displacements& u) {
  Eigen::Vector3d strain = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < x.count; ++i) {
    const std::size_t j = (i + 1) % x.count;
    const auto a = static_cast<Eigen::Index>(2 * i), b = static_cast<Eigen::Index>(2 * j);
    strain += from_edge(0.5 * (u[a] + u[b]), 0.5 * (u[a + 1] + u[b + 1]),
                        {x.x[j][1] - x.x[i][1], x.x[i][0] - x.x[j][0]});
  }
  return strain;
}

/// Whether this rank counts the edge, which others may have as well.
bool is_mine(const Mesh& mesh, const OuterEdge& edge) {
  const auto [a, b] = edge.nodes;
  return (mesh.nodes.number[a] < mesh.nodes.number[b] ? a : b) < mesh.nodes.owned;
}

void add_all(MPI_Comm comm, Eigen::Matrix3d& sum) {
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 9, MPI_DOUBLE, MPI_SUM, comm);
}

}  // namespace

CellMeans::CellMeans(MPI_Comm comm, const CellSystem& system, const CellOutline& outline)
    : comm_(comm),
      system_(system),
      outline_(outline),
      localisation_(static_cast<std::size_t>(system.mesh().cells.size())),
      displacements_(localisation_.size()) {}

void CellMeans::add(int k) {
  const Mesh& mesh = system_.mesh();
  for (int element = 0; element < mesh.cells.size(); ++element) {
    const CellCorners corners = system_.corners(element);
    const CellSystem::Displacements u = system_.displacements(element);
    const Eigen::Vector3d integral = strain_integral(corners, u);
    localisation_[element].col(k) = integral / cell_area(corners);
    displacements_[element].col(k).head(u.size()) = u;
    if (!mesh.cells.owned[element]) continue;
    strain_.col(k) += integral;
    stress_.col(k) += system_.material(element).stiffness * integral;
  }
  // The homogeneous strain and, as the hole's normal is opposite to the solid's, less what the edges say of
  // the rest: that is periodic, so a hole may lie across the seam.
  Eigen::Vector3d rest = Eigen::Vector3d::Zero();
  for (const OuterEdge& edge : outline_.holes)
    if (is_mine(mesh, edge)) {
      const Vector2 &a = system_.unknown(edge.nodes[0]), &b = system_.unknown(edge.nodes[1]);
      rest += from_edge(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), edge.outward);
    }
  MPI_Allreduce(MPI_IN_PLACE, rest.data(), 3, MPI_DOUBLE, MPI_SUM, comm_);
  hole_strain_.col(k) = outline_.hole_area * system_.strain() - rest;
}

void CellMeans::finish(CellSolution& solution) {
  const Mesh& mesh = system_.mesh();
  Eigen::Matrix3d energy = Eigen::Matrix3d::Zero();
  for (int element = 0; element < mesh.cells.size(); ++element) {
    if (!mesh.cells.owned[element]) continue;
    const auto u = displacements_[element].topRows(2 * mesh.cells.corner_count(element));
    energy += u.transpose() * system_.stiffness(element) * u;
  }
  for (Eigen::Matrix3d* sum : {&stress_, &strain_, &energy}) add_all(comm_, *sum);
  solution.area = mesh.area() + outline_.hole_area;
  solution.holes = {outline_.hole_count, outline_.hole_area, Eigen::Matrix3d::Zero()};
  if (outline_.hole_count > 0) solution.holes.localisation = hole_strain_ / outline_.hole_area;
  solution.localisation = std::move(localisation_);
  solution.stiffness = stress_ / solution.area;
  solution.energy_stiffness = energy / solution.area;
  solution.mean_localisation = (strain_ + hole_strain_) / solution.area;
}

void per_unit_strain(CellSolution& solution) {
  const Eigen::Matrix3d per_strain = solution.mean_localisation.inverse();
  for (Eigen::Matrix3d& a : solution.localisation) a = (a * per_strain).eval();
  solution.stiffness = (solution.stiffness * per_strain).eval();
  solution.energy_stiffness = (per_strain.transpose() * solution.energy_stiffness * per_strain).eval();
  solution.mean_localisation = (solution.mean_localisation * per_strain).eval();
  solution.holes.localisation = (solution.holes.localisation * per_strain).eval();
}

std::vector<Eigen::Matrix3d> phase_means(MPI_Comm comm, const Mesh& mesh, const CellSolution& solution) {
  std::vector<Eigen::Matrix3d> means(mesh.regions.size(), Eigen::Matrix3d::Zero());
  for (int element = 0; element < mesh.cells.size(); ++element)
    if (mesh.cells.owned[element])
      means[mesh.cells.region[element]] +=
          cell_area(seen_corners(mesh, element)) * solution.localisation[element];
  for (std::size_t k = 0; k < means.size(); ++k) {
    add_all(comm, means[k]);
    means[k] /= mesh.regions[k].area;
  }
  return means;
}

}  // namespace slipscale
