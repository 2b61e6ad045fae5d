#include "slipscale/record/probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipscale/base/box.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/mesh/shape_functions.hpp"
#include "slipscale/solid/element.hpp"
#include "slipscale/solid/stress.hpp"

namespace slipscale {
namespace {

constexpr long nobody = std::numeric_limits<long>::max();
constexpr double nothing = -std::numeric_limits<double>::infinity();

/// The lowest number that any rank names for a point, and the rank that named it.
struct Claim {
  long number = nobody;
  int rank = 0;
};
std::vector<Claim> lowest_claims(MPI_Comm comm, std::vector<Claim> mine) {
  for (Claim& claim : mine) claim.rank = rank_of(comm);
  MPI_Allreduce(MPI_IN_PLACE, mine.data(), static_cast<int>(mine.size()), MPI_LONG_INT, MPI_MINLOC, comm);
  return mine;
}

/// What the one rank that knows it says, on all; the others have `nothing`.
void share(MPI_Comm comm, std::vector<double>& values) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, comm);
}

/// The points sorted into a uniform grid of as many buckets, so that nodes and cells need not look at all of
/// them.
class PointBuckets {
 public:
  PointBuckets(const std::vector<Vector2>& points, const Box& box)
      : box_(box),
        side_(std::max(1, static_cast<int>(std::sqrt(static_cast<double>(points.size()))))),
        members_(static_cast<std::size_t>(side_) * side_) {
    for (int p = 0; p < static_cast<int>(points.size()); ++p)
      members_[static_cast<std::size_t>(bucket(points[p][1], 1)) * side_ + bucket(points[p][0], 0)].push_back(
          p);
  }

  /// Calls `visit(point)` for each point that may lie in the rectangle.
  template <class Visit>
  void visit_in(const Box& part, Visit visit) const {
    for (int j = bucket(part.lower[1], 1); j <= bucket(part.upper[1], 1); ++j)
      for (int i = bucket(part.lower[0], 0); i <= bucket(part.upper[0], 0); ++i)
        for (const int point : members_[static_cast<std::size_t>(j) * side_ + i]) visit(point);
  }

 private:
  /// Of what lies outside: the nearest.
  int bucket(double x, int axis) const {
    const double place = std::floor((x - box_.lower[axis]) / (box_.upper[axis] - box_.lower[axis]) * side_);
    return place > 0 ? static_cast<int>(std::min(place, side_ - 1.0)) : 0;
  }

  Box box_;
  int side_;
  std::vector<std::vector<int>> members_;
};

Box block_of(const Mesh& mesh) { return {mesh.lower, mesh.upper}; }

double size_of(const Mesh& mesh) {
  return std::hypot(mesh.upper[0] - mesh.lower[0], mesh.upper[1] - mesh.lower[1]);
}

/// The rectangle around some positions, a little enlarged.
Box reach(std::span<const Vector2> corners, double little) {
  Box box{corners[0], corners[0]};
  for (const Vector2& x : corners)
    for (int d = 0; d < 2; ++d) {
      box.lower[d] = std::min(box.lower[d], x[d] - little);
      box.upper[d] = std::max(box.upper[d], x[d] + little);
    }
  return box;
}

}  // namespace

Probes::Probes(MPI_Comm comm, const Model& model, const std::vector<Vector2>& points)
    : positions_(points), shares_(points.size()) {
  const Mesh& mesh = model.mesh;
  std::vector<char> placed(points.size(), 0);
  if (!points.empty()) {
    place_on_nodes(comm, mesh, placed);
    place_in_cells(comm, mesh, placed);
  }
  for (std::size_t p = 0; p < points.size(); ++p)
    if (!placed[p])
      throw UserError(format(
          "-history_points: ({:g}, {:g}) m lies outside the body, which spans x {:g} to {:g} m and y {:g} to "
          "{:g} m; move the point",
          points[p][0], points[p][1], mesh.lower[0], mesh.upper[0], mesh.lower[1], mesh.upper[1]));
  const auto begin = mesh.nodes.number.begin(), end = begin + mesh.nodes.owned;  // ascending
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const auto found = std::lower_bound(begin, end, corners_[c].number);
    if (found == end || *found != corners_[c].number) continue;
    own_corner_.push_back(static_cast<int>(c));
    own_node_.push_back(static_cast<int>(found - begin));
  }
  std::sort(own_point_.begin(), own_point_.end());
  corner_gather_ = OrderedGather(comm, {own_corner_.begin(), own_corner_.end()});
  stress_gather_ = OrderedGather(comm, {own_point_.begin(), own_point_.end()});
}

void Probes::place_on_nodes(MPI_Comm comm, const Mesh& mesh, std::vector<char>& placed) {
  const PointBuckets buckets(positions_, block_of(mesh));
  const double tolerance = 1e-6 * size_of(mesh);
  std::vector<int> node(positions_.size(), -1);
  std::vector<Claim> mine(positions_.size());
  for (int i = 0; i < mesh.nodes.owned; ++i) {
    const Vector2& x = mesh.nodes.position[i];
    buckets.visit_in(reach({&x, 1}, tolerance), [&](int p) {
      if (node[p] >= 0 || std::hypot(x[0] - positions_[p][0], x[1] - positions_[p][1]) > tolerance) return;
      node[p] = i;
      mine[p].number = static_cast<long>(mesh.nodes.number[i]);
    });
  }
  const std::vector<Claim> claims = lowest_claims(comm, mine);
  std::vector<double> places(2 * positions_.size(), nothing);
  std::vector<std::vector<int>> points_on(static_cast<std::size_t>(mesh.nodes.owned));
  for (std::size_t p = 0; p < positions_.size(); ++p) {
    if (claims[p].number == nobody) continue;
    placed[p] = 1;
    corners_.push_back({static_cast<int>(p), static_cast<PetscInt>(claims[p].number), 1.0});
    if (claims[p].rank != rank_of(comm)) continue;
    own_point_.push_back(static_cast<int>(p));
    points_on[node[p]].push_back(static_cast<int>(p));
    for (int d = 0; d < 2; ++d) places[2 * p + d] = mesh.nodes.position[node[p]][d];
  }
  share(comm, places);
  for (std::size_t p = 0; p < positions_.size(); ++p)
    if (placed[p]) positions_[p] = {places[2 * p], places[2 * p + 1]};

  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const int first = mesh.cells.first[cell];
    for (int k = 0; k < mesh.cells.corner_count(cell); ++k) {
      const int i = mesh.cells.corner_nodes[first + k];
      if (i >= mesh.nodes.owned || points_on[i].empty()) continue;
      const double area = corner_areas(mesh.cells.corners_of(cell))[k];
      for (const int p : points_on[i]) shares_[p].push_back({cell, area});
    }
  }
  for (const int p : own_point_) {
    double area = 0;
    for (const CellShare& share : shares_[p]) area += share.weight;
    for (CellShare& share : shares_[p]) share.weight /= area;
  }
}

void Probes::place_in_cells(MPI_Comm comm, const Mesh& mesh, std::vector<char>& placed) {
  const PointBuckets buckets(positions_, block_of(mesh));
  std::vector<int> found(positions_.size(), -1);
  std::vector<std::array<double, 4>> weights(positions_.size());
  std::vector<Claim> mine(positions_.size());
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    if (!mesh.cells.owned[cell]) continue;
    const auto corners = mesh.cells.corners_of(cell);
    buckets.visit_in(reach(corners, 1e-6 * size_of(mesh)), [&](int p) {
      if (placed[p] || found[p] >= 0 || !shape_values_at(corners, positions_[p], weights[p])) return;
      found[p] = cell;
      mine[p].number = static_cast<long>(mesh.cells.number[cell]);
    });
  }
  const std::vector<Claim> claims = lowest_claims(comm, mine);
  // By point its four corners: whole-mesh number and weight; `nothing` where a triangle has none.
  std::vector<double> told(8 * positions_.size(), nothing);
  for (std::size_t p = 0; p < positions_.size(); ++p) {
    if (claims[p].number == nobody || claims[p].rank != rank_of(comm)) continue;
    own_point_.push_back(static_cast<int>(p));
    shares_[p].push_back({found[p], 1.0});
    for (int k = 0; k < mesh.cells.corner_count(found[p]); ++k) {
      const int node = mesh.cells.corner_nodes[mesh.cells.first[found[p]] + k];
      told[8 * p + 2 * k] = static_cast<double>(mesh.nodes.number[node]);
      told[8 * p + 2 * k + 1] = weights[p][k];
    }
  }
  share(comm, told);
  for (std::size_t p = 0; p < positions_.size(); ++p) {
    if (claims[p].number == nobody) continue;
    placed[p] = 1;
    for (std::size_t k = 0; k < 4; ++k)
      if (told[8 * p + 2 * k] >= 0)
        corners_.push_back(
            {static_cast<int>(p), static_cast<PetscInt>(told[8 * p + 2 * k]), told[8 * p + 2 * k + 1]});
  }
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
