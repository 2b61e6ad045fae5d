#include "slipscale/record/probes.hpp"

#include <cmath>
#include <limits>

#include "slipscale/base/print.hpp"
#include "slipscale/mesh/shape_functions.hpp"
#include "slipscale/solid/element.hpp"
#include "slipscale/solid/stress.hpp"

namespace slipscale {
namespace {

int rank_in(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

/// The lowest number that any rank names, and the rank that named it.
struct Claim {
  long number;
  int rank;
};
Claim lowest_claim(MPI_Comm comm, long mine) {
  Claim claim{mine, rank_in(comm)};
  MPI_Allreduce(MPI_IN_PLACE, &claim, 1, MPI_LONG_INT, MPI_MINLOC, comm);
  return claim;
}

constexpr long nobody = std::numeric_limits<long>::max();

}  // namespace

Probes::Probes(MPI_Comm comm, const Model& model, const std::vector<Vector2>& points)
    : positions_(points), shares_(points.size()) {
  const Mesh& mesh = model.mesh;
  for (int p = 0; p < static_cast<int>(points.size()); ++p)
    if (!place_on_node(comm, mesh, p) && !place_in_cell(comm, mesh, p))
      throw UserError(format(
          "-history_points: ({:g}, {:g}) m lies outside the body, which spans x {:g} to {:g} m and y {:g} to "
          "{:g} m; move the point",
          points[p][0], points[p][1], mesh.lower[0], mesh.upper[0], mesh.lower[1], mesh.upper[1]));
  for (std::size_t c = 0; c < corners_.size(); ++c)
    for (int i = 0; i < mesh.nodes.owned; ++i)
      if (mesh.nodes.number[i] == corners_[c].number) {
        own_corner_.push_back(static_cast<int>(c));
        own_node_.push_back(i);
      }
  corner_gather_ = OrderedGather(comm, {own_corner_.begin(), own_corner_.end()});
  stress_gather_ = OrderedGather(comm, {own_point_.begin(), own_point_.end()});
}

bool Probes::place_on_node(MPI_Comm comm, const Mesh& mesh, int point) {
  const double size = std::hypot(mesh.upper[0] - mesh.lower[0], mesh.upper[1] - mesh.lower[1]);
  const Vector2 x = positions_[point];
  int node = -1;
  for (int i = 0; i < mesh.nodes.owned && node < 0; ++i)
    if (std::hypot(mesh.nodes.position[i][0] - x[0], mesh.nodes.position[i][1] - x[1]) <= 1e-6 * size)
      node = i;
  const Claim claim = lowest_claim(comm, node < 0 ? nobody : static_cast<long>(mesh.nodes.number[node]));
  if (claim.number == nobody) return false;
  corners_.push_back({point, static_cast<PetscInt>(claim.number), 1.0});
  if (claim.rank == rank_in(comm)) {
    positions_[point] = mesh.nodes.position[node];
    own_point_.push_back(point);
    double area = 0;
    for (int cell = 0; cell < mesh.cells.size(); ++cell) {
      const auto areas = corner_areas(mesh.cells.corners_of(cell));
      const auto nodes = mesh.cells.nodes_of(cell);
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (nodes[k] == node) {
          shares_[point].push_back({cell, areas[k]});
          area += areas[k];
        }
    }
    for (CellShare& share : shares_[point]) share.weight /= area;
  }
  MPI_Bcast(positions_[point].data(), 2, MPI_DOUBLE, claim.rank, comm);
  return true;
}

bool Probes::place_in_cell(MPI_Comm comm, const Mesh& mesh, int point) {
  int found = -1;
  std::array<double, 4> weights{};
  for (int cell = 0; cell < mesh.cells.size() && found < 0; ++cell)
    if (mesh.cells.owned[cell] && shape_values_at(mesh.cells.corners_of(cell), positions_[point], weights))
      found = cell;
  const Claim claim = lowest_claim(comm, found < 0 ? nobody : static_cast<long>(mesh.cells.number[found]));
  if (claim.number == nobody) return false;
  struct {
    long numbers[4];
    double weights[4];
  } told{{-1, -1, -1, -1}, {}};
  if (claim.rank == rank_in(comm)) {
    own_point_.push_back(point);
    shares_[point].push_back({found, 1.0});
    const auto nodes = mesh.cells.nodes_of(found);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      told.numbers[k] = mesh.nodes.number[nodes[k]];
      told.weights[k] = weights[k];
    }
  }
  MPI_Bcast(&told, sizeof told, MPI_BYTE, claim.rank, comm);
  for (int k = 0; k < 4; ++k)
    if (told.numbers[k] >= 0)
      corners_.push_back({point, static_cast<PetscInt>(told.numbers[k]), told.weights[k]});
  return true;
}

std::vector<ProbeReading> Probes::read(const SlidingBody& body) const {
  std::vector<double> states, stresses;
  for (int node : own_node_) {
    const Vector2 &u = body.displacement_n()[node], &v = body.velocity_n()[node];
    states.insert(states.end(), {u[0], u[1], v[0], v[1]});
  }
  const Model& model = body.model();
  for (int point : own_point_) {
    std::array<double, 3> sum{};
    for (const CellShare& share : shares_[point]) {
      const auto stress = stress_of_cell(model.mesh, model.materials, body.displacement_n(), share.cell);
      for (int k = 0; k < 3; ++k) sum[k] += share.weight * stress[k];
    }
    stresses.insert(stresses.end(), sum.begin(), sum.end());
  }
  const auto all_states = corner_gather_(states, 4);
  const auto all_stresses = stress_gather_(stresses, 3);
  std::vector<ProbeReading> readings(all_states.empty() ? 0 : positions_.size());
  for (std::size_t c = 0; !readings.empty() && c < corners_.size(); ++c) {
    ProbeReading& reading = readings[corners_[c].point];
    for (int axis = 0; axis < 2; ++axis) {
      reading.u[axis] += corners_[c].weight * all_states[4 * c + axis];
      reading.v[axis] += corners_[c].weight * all_states[4 * c + 2 + axis];
    }
  }
  for (std::size_t p = 0; p < readings.size(); ++p)
    for (int k = 0; k < 3; ++k) readings[p].stress[k] = all_stresses[3 * p + k];
  return readings;
}

}  // namespace slipscale
