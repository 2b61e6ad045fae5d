#include "dense_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/solid/element.hpp"

namespace slipscale::testing_support {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Whole {
  MatrixXd stiffness;
  VectorXd mass;
};

Whole assemble(const Mesh& mesh, const std::vector<Material>& materials) {
  const Index n = 2 * mesh.nodes.total;
  Whole whole{MatrixXd::Zero(n, n), VectorXd::Zero(n)};
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    if (!mesh.cells.owned[cell]) continue;
    const auto corners = mesh.cells.corners_of(cell);
    const auto nodes = mesh.cells.nodes_of(cell);
    const Material& material = materials[mesh.cells.region[cell]];
    const auto k = element_stiffness(corners, material.stiffness);
    const auto areas = corner_areas(corners);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (Index i = 0; i < 2; ++i) {
        const Index row = 2 * mesh.nodes.number[nodes[a]] + i;
        whole.mass[row] += material.density * areas[a];
        for (std::size_t b = 0; b < nodes.size(); ++b)
          for (Index j = 0; j < 2; ++j)
            whole.stiffness(row, 2 * mesh.nodes.number[nodes[b]] + j) +=
                k(2 * static_cast<Index>(a) + i, 2 * static_cast<Index>(b) + j);
      }
  }
  MPI_Allreduce(MPI_IN_PLACE, whole.stiffness.data(), static_cast<int>(n * n), MPI_DOUBLE, MPI_SUM,
                PETSC_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, whole.mass.data(), static_cast<int>(n), MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return whole;
}

/// Whole-mesh numbers of a boundary's nodes, on every rank.
std::vector<PetscInt> numbers_of(const Mesh& mesh, const std::string& boundary) {
  std::vector<Vector2> mark(static_cast<std::size_t>(mesh.nodes.owned), {0, 0});
  for (const int i : mesh.find_boundary(boundary)->nodes) mark[i][0] = 1;
  const auto whole = whole_field(PETSC_COMM_WORLD, mesh, mark.data());
  std::vector<PetscInt> found;
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (whole[i][0] != 0) found.push_back(static_cast<PetscInt>(i));
  return found;
}

/// Computed on rank 0 for all.
std::vector<std::complex<double>> eigenvalues(const MatrixXd& system) {
  Eigen::VectorXcd found(system.rows());
  if (is_root(PETSC_COMM_WORLD)) found = system.eigenvalues();
  MPI_Bcast(found.data(), static_cast<int>(found.size()), MPI_CXX_DOUBLE_COMPLEX, 0, PETSC_COMM_WORLD);
  return {found.begin(), found.end()};
}

}  // namespace

DenseBody dense_body(const Mesh& mesh, const std::vector<Material>& materials, const Scene& scene,
                     const std::vector<PetscInt>& closed, const std::vector<double>& reactions) {
  const Whole whole = assemble(mesh, materials);
  const auto place = whole_field(PETSC_COMM_WORLD, mesh, mesh.nodes.position.data());
  const Index n = whole.mass.size();
  std::vector<char> held(static_cast<std::size_t>(n), 0);
  for (const PetscInt i : closed) held[2 * i + 1] = 1;
  MatrixXd free(n, 0);
  MatrixXd plates = MatrixXd::Zero(0, 0);
  std::vector<VectorXd> columns;
  std::vector<std::pair<Index, double>> plate_masses;  // of a column
  for (const BoundaryCondition& condition : scene.conditions) {
    const auto nodes = numbers_of(mesh, condition.boundary);
    for (const PetscInt i : nodes)
      for (int axis = 0; axis < 2; ++axis)
        if (condition.displacement[axis]) held[2 * i + axis] = 1;
    if (!condition.is_straight()) continue;
    double left = 1e300, right = -1e300;
    for (const PetscInt i : nodes) left = std::min(left, place[i][0]), right = std::max(right, place[i][0]);
    VectorXd lift = VectorXd::Zero(n), tilt = VectorXd::Zero(n);
    for (const PetscInt i : nodes) {
      held[2 * i + 1] = 1;
      lift[2 * i + 1] = 1;
      tilt[2 * i + 1] = place[i][0] - 0.5 * (left + right);
    }
    plate_masses.push_back({static_cast<Index>(columns.size()), condition.plate_mass});
    columns.push_back(lift);
    if (condition.straight == BoundaryCondition::Straight::tilting) {
      plate_masses.push_back(
          {static_cast<Index>(columns.size()), condition.plate_mass * (right - left) * (right - left) / 12});
      columns.push_back(tilt);
    }
  }
  for (Index k = 0; k < n; ++k)
    if (!held[static_cast<std::size_t>(k)]) columns.push_back(VectorXd::Unit(n, k));
  free.resize(n, static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) free.col(static_cast<Index>(k)) = columns[k];

  DenseBody body;
  body.stiffness = free.transpose() * whole.stiffness * free;
  body.damped = free.transpose() * whole.mass.asDiagonal() * free;
  body.mass = body.damped;
  for (const auto& [column, mass] : plate_masses) body.mass(column, column) += mass;
  const auto count = static_cast<Index>(closed.size());
  body.reaction.resize(count, free.cols());
  body.push.resize(free.cols(), count);
  body.coefficient.resize(count);
  body.slope.resize(count);
  const FrictionChoice& law = scene.friction;
  for (Index k = 0; k < count; ++k) {
    const PetscInt node = closed[static_cast<std::size_t>(k)];
    body.reaction.row(k) = whole.stiffness.row(2 * node + 1) * free;
    const double x = place[node][0], still = law.mu().at({x, 0}, 0), kinetic = law.kinetic.at({x, 0}, 0);
    const bool falls = law.law == FrictionChoice::Law::exponential;
    const double part = falls ? std::exp(-std::abs(scene.surface->speed) / law.slip_rate) : 1;
    body.coefficient[k] = falls ? kinetic + (still - kinetic) * part : still;
    body.slope[k] =
        falls ? -(still - kinetic) / law.slip_rate * part * reactions[static_cast<std::size_t>(k)] : 0;
    body.push.col(k) = (scene.surface->speed > 0 ? 1 : -1) * free.row(2 * node).transpose();
  }
  return body;
}

std::vector<std::complex<double>> exponents_of(const DenseBody& body, const Scene& scene, double time) {
  const Index n = body.mass.rows(), c = body.reaction.rows(), memory = time > 0 ? c : 0;
  const double a = scene.damping.mass, b = scene.damping.stiffness;
  const auto mu = body.coefficient.asDiagonal();
  const MatrixXd inverse = body.mass.inverse();
  MatrixXd system = MatrixXd::Zero(2 * n + memory, 2 * n + memory);
  system.block(0, n, n, n).setIdentity();
  system.block(n, 0, n, n) = -inverse * body.stiffness;
  system.block(n, n, n, n) = -inverse * (a * body.damped + b * body.stiffness);
  if (time > 0) {
    system.block(n, 2 * n, n, c) = inverse * body.push;
    system.block(2 * n, 0, c, n) = mu * body.reaction / time;
    system.block(2 * n, n, c, n) = mu * body.reaction * (b / time);
    system.block(2 * n, n, c, n) -= body.slope.asDiagonal() * body.push.transpose() / time;
    system.block(2 * n, 2 * n, c, c).diagonal().setConstant(-1 / time);
  } else {
    system.block(n, 0, n, n) += inverse * body.push * (mu * body.reaction);
    system.block(n, n, n, n) += b * inverse * body.push * (mu * body.reaction);
  }
  std::vector<std::complex<double>> found;
  for (const auto& p : eigenvalues(system))
    if (p.imag() > 0) found.push_back(p);
  return found;
}

std::vector<std::complex<double>> scheme_exponents_of(const DenseBody& body, const Scene& scene, double time,
                                                      double step) {
  const Index n = body.mass.rows(), c = body.reaction.rows();
  const double a = scene.damping.mass, b = scene.damping.stiffness;
  const auto mu = body.coefficient.asDiagonal();
  const Relaxation memory = relaxation(time > 0 ? step / time : 1e300);
  const MatrixXd inverse = body.mass.inverse(), none = MatrixXd::Zero(n, n);
  // Rows of what the step makes of (u_n, w_n, u_{n−1}, s_{n−1}, λ_{n−1}).
  const Index size = 3 * n + 2 * c;
  MatrixXd reaction = MatrixXd::Zero(c, size), strength = MatrixXd::Zero(c, size);
  reaction.leftCols(n) = (1 + b / step) * body.reaction;
  reaction.middleCols(2 * n, n) = -b / step * body.reaction;
  strength = memory.now * (mu * reaction);
  strength.middleCols(n, n) -= (1 - memory.keep) * (body.slope.asDiagonal() * body.push.transpose());
  strength.middleCols(3 * n, c).diagonal().array() += memory.keep;
  strength.rightCols(c).diagonal() += memory.before * body.coefficient;
  MatrixXd acceleration = MatrixXd::Zero(n, size);
  acceleration.leftCols(n) = -(1 + b / step) * body.stiffness;
  acceleration.middleCols(n, n) = -a * body.damped;
  acceleration.middleCols(2 * n, n) = b / step * body.stiffness;
  acceleration += body.push * strength;
  acceleration = (inverse * acceleration).eval();
  MatrixXd next(size, size);
  next.setZero();
  next.topRows(n) = (scene.beta2 + 0.5) * step * step * acceleration;
  next.block(0, 0, n, n).diagonal().array() += 1;
  next.block(0, n, n, n).diagonal().array() += step;
  next.middleRows(n, n) = step * acceleration;
  next.block(n, n, n, n).diagonal().array() += 1;
  next.block(2 * n, 0, n, n).setIdentity();
  next.middleRows(3 * n, c) = strength;
  next.bottomRows(c) = reaction;
  std::vector<std::complex<double>> found;
  for (const auto& z : eigenvalues(next))
    if (z.imag() > 0) found.push_back(std::log(z) / step);
  return found;
}

}  // namespace slipscale::testing_support
