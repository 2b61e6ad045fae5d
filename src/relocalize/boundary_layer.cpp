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
  std::unique_ptr<StripSystem> system;
  /// By contact node: how all of them move under 1 N/m along y there, where that was needed already; none
  /// elsewhere. By reciprocity also how far that node moves along y under forces at the others.
  std::vector<std::vector<Vector2>> response;
  std::vector<char> closed;                ///< [contact nodes]
  std::vector<int> held;                   ///< the closed ones
  Eigen::LLT<Eigen::MatrixXd> compliance;  ///< [held, held] m per N/m along y
  std::vector<double> borne;               ///< [contact nodes] pressure found over that of the run, lately
  int factorisations = 0;

  Layer(MPI_Comm on, const PlaneGrid& mesh, std::span<const Eigen::Matrix3d> c, RankShare share, double depth)
      : comm(on),
        grid(mesh),
        stiffness(c.begin(), c.end()),
        mine(share),
        inside(cells_below(mesh, bounding_box(mesh).lower[1] + depth)),
        kept(cells_below(mesh, bounding_box(mesh).lower[1] + 0.5 * depth)),
        points(mesh, inside),
        response(points.contact_count()),
        borne(points.contact_count(), 1.0) {
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

  /// The strip, its contact nodes free.
  void factorise() {
    if (system) return;
    system = std::make_unique<StripSystem>(comm, grid, points);
    for_cells(inside, [&](int cell, std::size_t) {
      system->add_cell(cell, element_stiffness(grid.corners_of(cell), stiffness[grid.region[cell]]));
    });
    system->factorise();
    ++factorisations;
  }

  /// Closes these contact nodes: what they do to one another is known from one solution for each of them.
  void hold(const std::vector<char>& now) {
    if (now == closed) return;
    closed = now;
    held.clear();
    std::vector<int> missing;
    for (std::size_t n = 0; n < closed.size(); ++n) {
      if (!closed[n]) continue;
      held.push_back(static_cast<int>(n));
      if (response[n].empty()) missing.push_back(static_cast<int>(n));
    }
    auto found = system->responses(missing);
    for (std::size_t k = 0; k < missing.size(); ++k) response[missing[k]] = std::move(found[k]);
    const auto count = static_cast<Eigen::Index>(held.size());
    Eigen::MatrixXd among(count, count);
    for (Eigen::Index k = 0; k < count; ++k)
      for (Eigen::Index m = 0; m < count; ++m) among(k, m) = response[held[k]][held[m]][1];
    compliance.compute(0.5 * (among + among.transpose()));
  }

  /// Reactions along y that keep the held nodes where they are, N/m, when `moved` [contact nodes] is how far
  /// the forces of the run alone move them and `added` acts besides.
  std::vector<double> reactions(const std::vector<Vector2>& moved, const std::vector<Vector2>& added) const {
    Eigen::VectorXd way(static_cast<Eigen::Index>(held.size()));
    for (std::size_t k = 0; k < held.size(); ++k) {
      const std::vector<Vector2>& of = response[held[k]];
      double sum = moved[held[k]][1];
      for (std::size_t m = 0; m < added.size(); ++m) sum += of[m][0] * added[m][0] + of[m][1] * added[m][1];
      way[static_cast<Eigen::Index>(k)] = -sum;
    }
    std::vector<double> push(added.size(), 0.0);
    if (held.empty()) return push;
    const Eigen::VectorXd found = compliance.solve(way);
    for (std::size_t k = 0; k < held.size(); ++k) push[held[k]] = found[static_cast<Eigen::Index>(k)];
    return push;
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
  }

  /// The friction of the pressure that is found, until both agree; open nodes bear nothing. `added` becomes
  /// what acts at the contact nodes beyond the run's forces, reactions included. Returns all that acts there.
  std::vector<Vector2> rub(const std::vector<Vector2>& moved, const std::vector<Vector2>& run,
                           std::vector<Vector2>& added) {
    constexpr double tolerance = 1e-10;
    constexpr int most = 200;
    double size = 0;
    for (const Vector2& f : run) size += std::abs(f[0]) + std::abs(f[1]);
    added.assign(run.size(), Vector2{});
    for (std::size_t n = 0; n < run.size(); ++n) {
      if (!closed[n])
        added[n] = {-run[n][0], -run[n][1]};
      else if (in_proportion(run[n]))
        added[n][0] = (borne[n] - 1) * run[n][0];
    }
    for (int k = 0; k < most; ++k) {
      const std::vector<double> push = reactions(moved, added);
      std::vector<Vector2> force(run.size()), next = added;
      double change = 0;
      for (std::size_t n = 0; n < run.size(); ++n) {
        force[n] = {run[n][0] + added[n][0], run[n][1] + added[n][1] + push[n]};
        if (!closed[n] || !in_proportion(run[n])) continue;
        next[n][0] = run[n][0] / run[n][1] * force[n][1] - run[n][0];
        change += std::abs(next[n][0] - added[n][0]);
        borne[n] = force[n][1] / run[n][1];
      }
      if (change <= tolerance * size) {
        for (std::size_t n = 0; n < run.size(); ++n) added[n][1] += push[n];
        return force;
      }
      added = std::move(next);
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
  layer.factorise();
  std::vector<Vector2> added(run.size(), Vector2{});
  layer.solve(macroscopic_strain, macroscopic_stress, added);
  const std::vector<Vector2> moved = layer.system->contact_displacement();
  std::vector<char> closed = pressed(run);
  do {
    layer.hold(closed);
  } while (open_what_pulls(layer.rub(moved, run, added), closed));
  layer.solve(macroscopic_strain, macroscopic_stress, added);
  layer.for_cells(layer.kept, [&](int cell, std::size_t place) {
    const Eigen::Vector3d total = vector(macroscopic_strain[place]) + layer.corrector(cell);
    vector(strain[place]) = total;
    vector(stress[place]) = layer.stiffness[layer.grid.region[cell]] * total;
  });
}

long BoundaryLayer::unknowns() const { return layer_->system ? layer_->system->unknowns() : 0; }
long BoundaryLayer::cells() const { return static_cast<long>(std::ranges::count(layer_->inside, 1)); }
int BoundaryLayer::factorisations() const { return layer_->factorisations; }

}  // namespace slipscale
