#include "slipscale/relocalize/boundary_layer.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/solid/element.hpp"
#include "strip_system.hpp"

namespace slipscale {
namespace {

Eigen::Map<const Eigen::Vector3d> vector(const PlaneTensor& tensor) {
  return Eigen::Map<const Eigen::Vector3d>(tensor.data());
}
Eigen::Map<Eigen::Vector3d> vector(PlaneTensor& tensor) { return Eigen::Map<Eigen::Vector3d>(tensor.data()); }

std::vector<char> cells_below(const PlaneGrid& grid, double height) {
  std::vector<char> below(static_cast<std::size_t>(grid.cells()));
  for (int cell = 0; cell < grid.cells(); ++cell) below[cell] = centre(grid, cell)[1] < height;
  return below;
}

double largest_normal(const std::vector<Vector2>& force) {
  double largest = 0;
  for (const Vector2& f : force) largest = std::max(largest, std::abs(f[1]));
  return largest;
}

/// Where the run's contact is closed; less than a thousandth of the largest force does not say.
std::vector<char> pressed(const std::vector<Vector2>& force) {
  std::vector<char> closed;
  const double least = 1e-3 * largest_normal(force);
  for (const Vector2& f : force) closed.push_back(f[1] > least);
  return closed;
}

/// Friction that exceeds the pressure, since its memory lags behind a pressure that falls, says nothing about
/// another pressure: it stays as it is.
bool in_proportion(const Vector2& force) { return std::abs(force[0]) <= force[1]; }

/// Whether there was any.
bool open_what_pulls(const std::vector<Vector2>& force, std::vector<char>& closed) {
  bool any = false;
  const double rounding = 1e-9 * largest_normal(force);
  for (std::size_t n = 0; n < force.size(); ++n)
    if (closed[n] && force[n][1] < -rounding) {
      closed[n] = 0;
      any = true;
    }
  return any;
}

void refuse_depth(const PlaneGrid& grid, const std::vector<char>& inside, double depth) {
  const auto cells = std::ranges::count(inside, 1);
  if (cells == 0 || cells == grid.cells())
    throw UserError(
        format("-relocalize_strip of {:g} m holds {} of the mesh, which is {:g} m high; give the "
               "strip a few diameters of the inclusions, and leave something above it",
               depth, cells == 0 ? "no cell" : "all cells", bounding_box(grid).extent(1)));
}

}  // namespace

struct BoundaryLayer::Layer {
  MPI_Comm comm;
  const PlaneGrid& grid;
  std::vector<Eigen::Matrix3d> stiffness;
  RankShare mine;
  std::vector<char> inside, kept;  ///< [cells], of the strip and of its lower half
  StripPoints points;
  std::vector<char> closed;  ///< [contact nodes], of the system below
  std::unique_ptr<StripSystem> system;
  std::vector<double> borne;  ///< [contact nodes] pressure found over that of the run, lately
  int factorisations = 0;
  std::vector<PlaneTensor> sum;  ///< [share] stress with the corrector's, Pa

  Layer(MPI_Comm on, const PlaneGrid& mesh, std::span<const Eigen::Matrix3d> c, RankShare share, double depth)
      : comm(on),
        grid(mesh),
        stiffness(c.begin(), c.end()),
        mine(share),
        inside(cells_below(mesh, bounding_box(mesh).lower[1] + depth)),
        kept(cells_below(mesh, bounding_box(mesh).lower[1] + 0.5 * depth)),
        points(mesh, inside),
        borne(points.contact_count(), 1.0),
        sum(share.count()) {
    refuse_depth(mesh, inside, depth);
  }

  /// Calls `visit(cell, place)` for this rank's cells in `where`, `place` counted in its share.
  template <class Visit>
  void for_cells(const std::vector<char>& where, const Visit& visit) const {
    for (std::size_t cell = mine.begin; cell < mine.end; ++cell)
      if (where[cell]) visit(static_cast<int>(cell), cell - mine.begin);
  }

  /// ∫ ε(φ):σ at the contact nodes: the force of the surface on each of them, N/m. Known on every rank.
  std::vector<Vector2> contact_forces(std::span<const PlaneTensor> stress) const {
    std::vector<Vector2> force(points.contact_count(), Vector2{});
    for_cells(inside, [&](int cell, std::size_t place) {
      if (!points.touches_contact(cell)) return;
      const StrainDisplacement b = centre_strain_displacement(grid.corners_of(cell));
      const Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1> f =
          area(grid, cell) * b.transpose() * vector(stress[place]);
      for (int k = 0; k < grid.corner_count(cell); ++k)
        if (const int node = points.contact_node(cell, k); node >= 0)
          force[node] = {force[node][0] + f[2 * k], force[node][1] + f[2 * k + 1]};
    });
    MPI_Allreduce(MPI_IN_PLACE, force.data(), static_cast<int>(2 * force.size()), MPI_DOUBLE, MPI_SUM, comm);
    return force;
  }

  /// The strip with these contact nodes closed.
  void hold(const std::vector<char>& now) {
    if (system && now == closed) return;
    closed = now;
    system = std::make_unique<StripSystem>(comm, grid, points, closed);
    for_cells(inside, [&](int cell, std::size_t) {
      system->add_cell(cell, element_stiffness(grid.corners_of(cell), stiffness[grid.region[cell]]));
    });
    system->factorise();
    ++factorisations;
  }

  /// The strain that the corrector adds to a cell.
  Eigen::Vector3d corrector(int cell) const {
    return centre_strain_displacement(grid.corners_of(cell)) * system->displacement(cell);
  }

  /// The solution under the run's forces and those added at the contact nodes.
  void solve(std::span<const PlaneTensor> strain, std::span<const PlaneTensor> stress,
             const std::vector<Vector2>& added) {
    system->clear_force();
    for_cells(inside, [&](int cell, std::size_t place) {
      const StrainDisplacement b = centre_strain_displacement(grid.corners_of(cell));
      const Eigen::Vector3d excess =
          stiffness[grid.region[cell]] * vector(strain[place]) - vector(stress[place]);
      system->add_force(cell, -area(grid, cell) * b.transpose() * excess);
    });
    system->add_contact(added);
    system->solve();
    for_cells(inside, [&](int cell, std::size_t place) {
      vector(sum[place]) = stiffness[grid.region[cell]] * (vector(strain[place]) + corrector(cell));
    });
  }

  /// Solves with the friction of the pressure that is found, until both agree; open nodes bear nothing.
  /// Returns the contact forces.
  std::vector<Vector2> rub(std::span<const PlaneTensor> strain, std::span<const PlaneTensor> stress,
                           const std::vector<Vector2>& run) {
    constexpr double tolerance = 1e-10;
    constexpr int most = 200;
    double size = 0;
    for (const Vector2& f : run) size += std::abs(f[0]) + std::abs(f[1]);
    std::vector<Vector2> added(run.size(), Vector2{});
    for (std::size_t n = 0; n < run.size(); ++n) {
      if (!closed[n])
        added[n] = {-run[n][0], -run[n][1]};
      else if (in_proportion(run[n]))
        added[n][0] = (borne[n] - 1) * run[n][0];
    }
    for (int k = 0; k < most; ++k) {
      solve(strain, stress, added);
      const std::vector<Vector2> force = contact_forces(sum);
      double change = 0;
      for (std::size_t n = 0; n < run.size(); ++n) {
        if (!closed[n] || !in_proportion(run[n])) continue;
        const double wanted = run[n][0] / run[n][1] * force[n][1] - run[n][0];
        change += std::abs(wanted - added[n][0]);
        added[n][0] = wanted;
        borne[n] = force[n][1] / run[n][1];
      }
      if (change <= tolerance * size) return force;
    }
    throw UserError(
        "next to the contact, pressure and friction do not settle (-relocalize_correction strip); "
        "leave the correction out");
  }
};

BoundaryLayer::BoundaryLayer(MPI_Comm comm, const PlaneGrid& grid, std::span<const Eigen::Matrix3d> stiffness,
                             RankShare mine, double depth)
    : layer_(std::make_unique<Layer>(comm, grid, stiffness, mine, depth)) {}

BoundaryLayer::~BoundaryLayer() = default;

void BoundaryLayer::correct(std::span<const PlaneTensor> macroscopic_strain,
                            std::span<const PlaneTensor> macroscopic_stress, std::span<PlaneTensor> strain,
                            std::span<PlaneTensor> stress) {
  Layer& layer = *layer_;
  const std::vector<Vector2> run = layer.contact_forces(macroscopic_stress);
  std::vector<char> closed = pressed(run);
  do {
    layer.hold(closed);
  } while (open_what_pulls(layer.rub(macroscopic_strain, macroscopic_stress, run), closed));
  layer.for_cells(layer.kept, [&](int cell, std::size_t place) {
    vector(strain[place]) = vector(macroscopic_strain[place]) + layer.corrector(cell);
    stress[place] = layer.sum[place];
  });
}

long BoundaryLayer::unknowns() const { return layer_->system ? layer_->system->unknowns() : 0; }
long BoundaryLayer::cells() const { return static_cast<long>(std::ranges::count(layer_->inside, 1)); }
int BoundaryLayer::factorisations() const { return layer_->factorisations; }

}  // namespace slipscale
