#include "sliding_loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipscale/base/print.hpp"
#include "slipscale/dynamics/contact_places.hpp"
#include "slipscale/dynamics/remarks.hpp"

namespace slipscale {
namespace {

/// A time at which every ramp is over, s.
constexpr double at_last = std::numeric_limits<double>::infinity();

/// Tractions as nodal forces: those that the step of `slide` would apply.
void add_tractions(const Model& model, const Scene& scene, const SlidingBody& body, SlidingLoads& loads) {
  BoundaryNodes nodes = body.boundary_nodes();
  std::vector<Vector2> scratch(model.mesh.nodes.number.size(), {0, 0}), moves(scratch);
  const NodalState state{scratch.data(), moves.data(), nullptr};
  Loads(model.mesh, scene.conditions, nodes).apply(at_last, {}, nodes, state);
  for (int k = 0; k < nodes.size(); ++k)
    for (int axis = 0; axis < 2; ++axis) loads.force[nodes.node[k]][axis] += nodes.load[k][axis];
}

/// Mass, place of the mass centre and smallest and largest x of a boundary's nodes. Collective.
struct Bar {
  double mass = 0, moment = 0, inertia = 0, left = 0, right = 0;
};

Bar bar_of(MPI_Comm comm, const Model& model, const Boundary& boundary) {
  double sums[3] = {0, 0, 0}, ends[2] = {at_last, at_last};
  for (const int i : boundary.nodes) {
    const double x = model.mesh.nodes.position[i][0], m = model.mass[i];
    sums[0] += m;
    sums[1] += m * x;
    sums[2] += m * x * x;
  }
  for (const BoundaryEdge& edge : boundary.edges)
    for (const Vector2& x : edge.ends) ends[0] = std::min(ends[0], x[0]), ends[1] = std::min(ends[1], -x[0]);
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MIN, comm);
  return {sums[0], sums[1], sums[2], ends[0], -ends[1]};
}

PlateSide plate_side(MPI_Comm comm, const Model& model, const BoundaryCondition& condition) {
  const Boundary& boundary = *model.mesh.find_boundary(condition.boundary);
  const Bar bar = bar_of(comm, model, boundary);
  const double plate = condition.plate_mass, middle = 0.5 * (bar.left + bar.right),
               length = bar.right - bar.left, mass = bar.mass + plate,
               centre = (bar.moment + plate * middle) / mass;
  PlateSide side;
  side.boundary = condition.boundary;
  side.tilts = condition.straight == BoundaryCondition::Straight::tilting;
  side.middle = middle - centre;
  side.force = condition.plate_force;
  side.mass = mass;
  side.inertia = bar.inertia + plate * (middle * middle + length * length / 12) - mass * centre * centre;
  for (const int i : boundary.nodes) {
    side.node.push_back(i);
    side.arm.push_back(model.mesh.nodes.position[i][0] - centre);
  }
  return side;
}

void prescribe(const Model& model, const Scene& scene, SlidingLoads& loads) {
  for (const BoundaryCondition& condition : scene.conditions)
    for (int axis = 0; axis < 2; ++axis) {
      if (!condition.displacement[axis]) continue;
      for (const int i : model.mesh.find_boundary(condition.boundary)->nodes) {
        char& held = loads.held[2 * static_cast<std::size_t>(i) + axis];
        if (!held) loads.place[i][axis] += *condition.displacement[axis];
        held = 1;
      }
    }
}

}  // namespace

SlidingLoads sliding_loads(MPI_Comm comm, const Model& model, const Scene& scene) {
  const Mesh& mesh = model.mesh;
  const auto owned = static_cast<std::size_t>(mesh.nodes.owned);
  const SlidingBody body(comm, model, scene, 1e-30);  // its checks; it makes no step
  SlidingLoads loads;
  loads.notes = remarks_at_start(body);
  loads.held.assign(2 * owned, 0);
  loads.place.assign(body.next_displacement(), body.next_displacement() + owned);
  for (std::size_t i = 0; i < owned; ++i)
    loads.force.push_back(
        {model.mass[i] * scene.body_acceleration[0], model.mass[i] * scene.body_acceleration[1]});
  add_tractions(model, scene, body, loads);
  prescribe(model, scene, loads);
  for (const BoundaryCondition& condition : scene.conditions)
    if (condition.is_straight()) loads.sides.push_back(plate_side(comm, model, condition));
  const ContactNodes& contact = body.contact();
  const auto places = contact_places(mesh, *mesh.find_boundary(scene.surface->boundary));
  for (int k = 0; k < contact.size(); ++k)
    loads.nodes.push_back({contact.node[k], contact.tributary_length[k], contact.clearance[k],
                           steady_coefficient(scene, places[contact.node[k]])});
  return loads;
}

void refuse_unsupported(MPI_Comm comm, const Model& model, const SlidingLoads& loads,
                        const std::vector<char>& is_closed) {
  const Mesh& mesh = model.mesh;
  const double size = std::max(mesh.upper[0] - mesh.lower[0], mesh.upper[1] - mesh.lower[1]);
  const Vector2 middle{0.5 * (mesh.lower[0] + mesh.upper[0]), 0.5 * (mesh.lower[1] + mesh.upper[1])};
  // Along x, along y, turning about the middle: what each does to the components that are held.
  const auto motion = [&](int node, int axis) {
    const Vector2& x = mesh.nodes.position[node];
    return Eigen::Vector3d(axis == 0, axis == 1,
                           axis == 0 ? -(x[1] - middle[1]) / size : (x[0] - middle[0]) / size);
  };
  Eigen::Matrix3d hold = Eigen::Matrix3d::Zero();
  const auto add = [&](const Eigen::Vector3d& m) { hold += m * m.transpose(); };
  for (int i = 0; i < mesh.nodes.owned; ++i)
    for (int axis = 0; axis < 2; ++axis)
      if (loads.held[2 * static_cast<std::size_t>(i) + axis]) add(motion(i, axis));
  for (std::size_t k = 0; k < loads.nodes.size(); ++k)
    if (is_closed[k]) add(motion(loads.nodes[k].node, 1));
  for (const PlateSide& side : loads.sides)
    if (!side.tilts && !side.node.empty()) hold(2, 2) += 1;  // a level side does not turn
  if (mesh.periodic[0] || mesh.periodic[1]) hold(2, 2) += static_cast<double>(mesh.nodes.total);
  MPI_Allreduce(MPI_IN_PLACE, hold.data(), 9, MPI_DOUBLE, MPI_SUM, comm);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(hold);
  constexpr double nothing = 1e-12;
  if (solver.eigenvalues()[0] > nothing * std::max(1.0, solver.eigenvalues()[2])) return;
  Eigen::Index which = 0;
  solver.eigenvectors().col(0).cwiseAbs().maxCoeff(&which);
  const char* motions[] = {
      "along x, where friction in slip holds nothing, so that the surface would carry "
      "it away; hold it with -boundary_<boundary>_x fixed",
      "along y; hold it with -boundary_<boundary>_y fixed, or press it on the surface",
      "by turning; hold it with -boundary_<boundary>_x fixed on a second place"};
  throw UserError(std::string("the body slides with no steady state: nothing keeps it from moving ") +
                  motions[which]);
}

}  // namespace slipscale
