#include "slipscale/dynamics/absorbing_sides.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/mesh/boundary_cells.hpp"

namespace slipscale {
namespace {

constexpr double aslant = 1e-6;  // rounding tilts an upright side by far less

/// The axis along which an edge faces; −1 for none.
int faces(const BoundaryEdge& edge) {
  const double length = std::hypot(edge.outward[0], edge.outward[1]);
  if (std::abs(edge.outward[1]) <= aslant * length) return 0;
  return std::abs(edge.outward[0]) <= aslant * length ? 1 : -1;
}

/// σ of the uniform initial state at a place, (xx, yy, xy), Pa.
std::array<double, 3> initial_stress(const InitialState& initial, const Solid& material, const Vector2& at) {
  const double p = initial.pressure_at_start().at(at, 0), shear = initial.shear_at_start().at(at, 0);
  return {-p * material.stiffness(0, 1) / material.stiffness(1, 1), -p, -shear};
}

}  // namespace

AbsorbingSides::AbsorbingSides(MPI_Comm comm, const Model& model,
                               const std::vector<BoundaryCondition>& conditions, const InitialState& initial,
                               const BoundaryNodes& nodes, const Supports& supports,
                               const StraightSides& straight) {
  const Mesh& mesh = model.mesh;
  std::vector<Entry> all(static_cast<std::size_t>(nodes.size()));
  std::string fault;
  for (const BoundaryCondition& condition : conditions) {
    if (!condition.absorbing) continue;
    any_ = true;
    const Boundary& boundary = *mesh.find_boundary(condition.boundary);
    const auto cells = boundary_cells(mesh, boundary);
    for (std::size_t e = 0; e < boundary.edges.size(); ++e) {
      const BoundaryEdge& edge = boundary.edges[e];
      const int axis = faces(edge);
      if (axis < 0) {
        fault = "-boundary_" + condition.boundary + "_absorbing: boundary '" + condition.boundary +
                "' does not face along x or y everywhere, which its dampers need; cut the body along an axis";
        continue;
      }
      const Solid material = model.materials[mesh.cells.region[cells[e]]].at(cells[e]);
      const double length = std::hypot(edge.outward[0], edge.outward[1]);
      const WaveSpeeds speeds = wave_speeds(material, axis == 0 ? 1 : 0, axis == 0 ? 0 : 1);
      Vector2 damper{}, force{};
      damper[axis] = 0.5 * length * material.density * speeds.fast;
      damper[1 - axis] = 0.5 * length * material.density * speeds.slow;
      const Vector2 middle{0.5 * (edge.ends[0][0] + edge.ends[1][0]),
                           0.5 * (edge.ends[0][1] + edge.ends[1][1])};
      const auto stress = initial_stress(initial, material, middle);
      if (condition.pressure == 0) force[axis] = 0.5 * stress[axis] * edge.outward[axis];
      if (condition.shear == 0) force[1 - axis] = 0.5 * stress[2] * edge.outward[axis];
      for (const int end : edge.nodes) {
        if (end >= mesh.nodes.owned) continue;
        Entry& entry = all[nodes.slot_of(end)];
        for (int q = 0; q < 2; ++q) entry.damper[q] += damper[q], entry.force[q] += force[q];
      }
    }
  }
  throw_together(comm, fault);
  for (int slot = 0; slot < nodes.size(); ++slot) {
    Entry& entry = all[slot];
    if (entry.damper == Vector2{}) continue;
    entry.slot = slot;
    for (int axis = 0; axis < 2; ++axis)
      if (supports.prescribes(slot, axis)) entry.damper[axis] = entry.force[axis] = 0;
    if (straight.holds(slot)) entry.damper[1] = entry.force[1] = 0;
    entries_.push_back(entry);
  }
}

void AbsorbingSides::apply(const StepCoefficients& step, BoundaryNodes& nodes,
                           const NodalState& state) const {
  for (const Entry& entry : entries_) {
    const int i = nodes.node[entry.slot];
    const double mass = nodes.mass[entry.slot];
    for (int axis = 0; axis < 2; ++axis) {
      nodes.load[entry.slot][axis] += entry.force[axis];
      accelerate(state, step, i, axis, entry.force[axis] / mass);
      const double velocity = nodes.velocity(entry.slot, axis, step, state), damper = entry.damper[axis];
      accelerate(state, step, i, axis, -damper * velocity / (mass + step.velocity * damper));
    }
  }
}

void AbsorbingSides::resist(const StepCoefficients& step, const BoundaryNodes& nodes,
                            ContactNodes& contact) const {
  for (const Entry& entry : entries_) {
    const auto found = std::ranges::lower_bound(contact.slot, entry.slot);
    if (found == contact.slot.end() || *found != entry.slot) continue;
    const auto k = static_cast<std::size_t>(found - contact.slot.begin());
    const double mass = nodes.mass[entry.slot];
    contact.mass[k] = mass + step.velocity * entry.damper[0];
    contact.normal_mass[k] = mass + step.velocity * entry.damper[1];
  }
}

void AbsorbingSides::measure(const StepCoefficients& step, BoundaryNodes& nodes,
                             const NodalState& state) const {
  for (const Entry& entry : entries_)
    for (int axis = 0; axis < 2; ++axis)
      nodes.absorbed[entry.slot][axis] =
          entry.damper[axis] == 0 ? 0 : -entry.damper[axis] * nodes.velocity(entry.slot, axis, step, state);
}

}  // namespace slipscale
