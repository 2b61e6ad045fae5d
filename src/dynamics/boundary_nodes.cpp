#include "slipscale/dynamics/boundary_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/cosine_ramp.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {

BoundaryNodes::BoundaryNodes(const Model& model, const std::vector<std::string>& boundaries) {
  for (const std::string& name : boundaries) {
    const auto& nodes = model.mesh.find_boundary(name)->nodes;
    node.insert(node.end(), nodes.begin(), nodes.end());
  }
  std::sort(node.begin(), node.end());
  node.erase(std::unique(node.begin(), node.end()), node.end());
  for (int i : node) mass.push_back(model.mass[i]);
  for (auto* field : {&displacement, &past_increment, &predictor, &acceleration, &internal, &load, &support})
    field->assign(node.size(), {0, 0});
}

int BoundaryNodes::slot_of(int local_node) const {
  const auto found = std::lower_bound(node.begin(), node.end(), local_node);
  return found != node.end() && *found == local_node ? static_cast<int>(found - node.begin()) : -1;
}

void BoundaryNodes::remember(const NodalState& state, const Vector2* previous_force) {
  for (int k = 0; k < size(); ++k) {
    const int i = node[k];
    const Vector2 u = state.displacement[i];
    past_increment[k] = {u[0] - displacement[k][0], u[1] - displacement[k][1]};
    displacement[k] = u;
    predictor[k] = state.predictor[i];
    if (state.acceleration) acceleration[k] = state.acceleration[i];
    internal[k] = previous_force[i];
  }
}

Loads::Loads(const Mesh& mesh, const std::vector<BoundaryCondition>& conditions, const BoundaryNodes& nodes) {
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const BoundaryCondition& condition = conditions[c];
    ramps_.push_back(condition.ramp);
    if (condition.pressure == 0 && condition.shear == 0 && !condition.is_straight() && !condition.absorbing)
      continue;
    const Boundary& boundary = *mesh.find_boundary(condition.boundary);
    const double pressure = condition.pressure_formula ? 0 : condition.pressure,
                 shear = condition.shear_formula ? 0 : condition.shear;
    std::vector<Entry> own;
    for (int i : boundary.nodes) own.push_back({nodes.slot_of(i), c, {0, 0}});
    for (const BoundaryEdge& edge : boundary.edges) {
      const double length = std::hypot(edge.outward[0], edge.outward[1]);
      const Vector2 half{0.5 * (shear * length - pressure * edge.outward[0]),
                         -0.5 * pressure * edge.outward[1]};
      for (int end : edge.nodes) {
        if (end >= mesh.nodes.owned) continue;
        Vector2& force =
            own[std::lower_bound(boundary.nodes.begin(), boundary.nodes.end(), end) - boundary.nodes.begin()]
                .force;
        force = {force[0] + half[0], force[1] + half[1]};
      }
    }
    if (condition.pressure_formula)
      add_formula(mesh, boundary, c, {condition.pressure, condition.pressure_formula}, true, own, nodes);
    if (condition.shear_formula)
      add_formula(mesh, boundary, c, {condition.shear, condition.shear_formula}, false, own, nodes);
    entries_.insert(entries_.end(), own.begin(), own.end());
  }
}

/// The traction between the ends of an edge is taken as linear: ∫ N_i N_j of an edge is a third of its
/// length, and a sixth for two ends.
void Loads::add_formula(const Mesh& mesh, const Boundary& boundary, std::size_t condition,
                        const Quantity& traction, bool normal, std::vector<Entry>& own,
                        const BoundaryNodes& nodes) {
  Varying varying{condition, traction.formula, {}, {}, {}};
  const bool of_place = traction.formula->of_place();
  if (!of_place) varying.places.push_back({0, 0});
  for (const BoundaryEdge& edge : boundary.edges) {
    const double length = std::hypot(edge.outward[0], edge.outward[1]);
    const Vector2 whole = normal ? Vector2{-edge.outward[0], -edge.outward[1]} : Vector2{length, 0};
    for (int k = 0; k < 2; ++k) {
      if (edge.nodes[k] >= mesh.nodes.owned) continue;
      for (int from = 0; from < 2; ++from) {
        const double part = traction.number / (from == k ? 3 : 6);
        varying.shares.push_back({nodes.slot_of(edge.nodes[k]),
                                  of_place ? static_cast<int>(varying.places.size()) + from : 0,
                                  {part * whole[0], part * whole[1]}});
      }
    }
    if (of_place) varying.places.insert(varying.places.end(), edge.ends.begin(), edge.ends.end());
  }
  varying.values.resize(varying.places.size());
  if (traction.formula->of_time()) {
    varying_.push_back(std::move(varying));
    return;
  }
  for (const Varying::Share& share : varying.shares) {
    const double value = (*traction.formula)(varying.places[share.place], 0);
    Entry& entry = *std::ranges::lower_bound(own, share.slot, {}, &Entry::slot);
    for (int axis = 0; axis < 2; ++axis) entry.force[axis] += value * share.force[axis];
  }
}

void Loads::apply_varying(double time, const StepCoefficients& step, BoundaryNodes& nodes,
                          const NodalState& state) const {
  for (const Varying& varying : varying_) {
    const double level = cosine_ramp(time, ramps_[varying.condition]);
    for (std::size_t p = 0; p < varying.places.size(); ++p) {
      varying.values[p] = level * (*varying.formula)(varying.places[p], time);
      sound_ = sound_ && std::isfinite(varying.values[p]);
    }
    for (const Varying::Share& share : varying.shares)
      for (int axis = 0; axis < 2; ++axis) {
        const double force = share.force[axis] * varying.values[share.place];
        nodes.load[share.slot][axis] += force;
        accelerate(state, step, nodes.node[share.slot], axis, force / nodes.mass[share.slot]);
      }
  }
}

void Loads::apply(double time, const StepCoefficients& step, BoundaryNodes& nodes,
                  const NodalState& state) const {
  for (const Entry& entry : entries_) nodes.load[entry.slot] = {0, 0};
  std::size_t known = ramps_.size();
  double level = 0;
  for (const Entry& entry : entries_) {
    if (entry.condition != known) level = cosine_ramp(time, ramps_[known = entry.condition]);
    for (int axis = 0; axis < 2; ++axis) {
      const double force = entry.force[axis] * level;
      nodes.load[entry.slot][axis] += force;
      accelerate(state, step, nodes.node[entry.slot], axis, force / nodes.mass[entry.slot]);
    }
  }
  apply_varying(time, step, nodes, state);
}

namespace {

/// What two boundaries prescribe along an axis where they share a node.
bool alike(const BoundaryCondition& one, const BoundaryCondition& other, int axis) {
  const Quantity a = one.imposed(axis), b = other.imposed(axis);
  if (!a.formula != !b.formula || (a.formula && a.formula->text() != b.formula->text())) return false;
  return a.number == b.number && (a.is_zero() || one.ramp == other.ramp);
}

}  // namespace

Supports::Supports(MPI_Comm comm, const Mesh& mesh, const std::vector<BoundaryCondition>& conditions,
                   const BoundaryNodes& nodes, const Vector2* initial_displacement) {
  std::string fault;
  std::vector<std::array<int, 2>> by(static_cast<std::size_t>(nodes.size()), {-1, -1});
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const BoundaryCondition& condition = conditions[c];
    ramps_.push_back(condition.ramp);
    for (int axis = 0; axis < 2; ++axis) {
      if (!condition.displacement[axis]) continue;
      const Quantity imposed = condition.imposed(axis);
      Varying varying{c, axis, imposed.formula, {}};
      for (int i : mesh.find_boundary(condition.boundary)->nodes) {
        const int slot = nodes.slot_of(i);
        if (by[slot][axis] < 0) {
          by[slot][axis] = static_cast<int>(c);
          const Vector2& place = mesh.nodes.position[i];
          if (imposed.of_time())
            varying.members.push_back({slot, initial_displacement[i][axis], place});
          else
            entries_.push_back({slot, axis, c, initial_displacement[i][axis], imposed.at(place, 0)});
        } else if (const BoundaryCondition& other = conditions[by[slot][axis]];
                   !alike(other, condition, axis)) {
          const char* name = axis == 0 ? "x" : "y";
          fault = "boundaries '" + other.boundary + "' and '" + condition.boundary +
                  "' prescribe different displacements along " + name +
                  " at the node they share; make -boundary_" + condition.boundary + "_" + name +
                  " equal to the other, or free";
        }
      }
      if (!varying.members.empty()) varying_.push_back(std::move(varying));
    }
  }
  throw_together(comm, fault);
}

bool Supports::prescribes(int slot, int axis) const {
  return std::ranges::any_of(entries_,
                             [&](const Entry& entry) { return entry.slot == slot && entry.axis == axis; }) ||
         std::ranges::any_of(varying_, [&](const Varying& varying) {
           return varying.axis == axis &&
                  std::ranges::any_of(varying.members, [&](const auto& m) { return m.slot == slot; });
         });
}

void Supports::start(const BoundaryNodes& nodes, double time_step, Vector2* velocity) const {
  for (const Entry& entry : entries_) velocity[nodes.node[entry.slot]][entry.axis] = 0;
  start_formulas(nodes, time_step, velocity);
}

/// From values at t ≥ 0 alone, where formulas mean something; second order in the step, as the scheme is.
void Supports::start_formulas(const BoundaryNodes& nodes, double time_step, Vector2* velocity) const {
  for (const Varying& varying : varying_) {
    const auto value = [&](const Vector2& place, int steps) {
      const double time = steps * time_step;
      return cosine_ramp(time, ramps_[varying.condition]) * (*varying.formula)(place, time);
    };
    for (const auto& m : varying.members)
      velocity[nodes.node[m.slot]][varying.axis] =
          (-3 * value(m.place, 0) + 4 * value(m.place, 1) - value(m.place, 2)) / (2 * time_step);
  }
}

void Supports::apply(double next_time, const StepCoefficients& step, BoundaryNodes& nodes,
                     const NodalState& state) const {
  std::size_t known = ramps_.size();
  double level = 0;
  for (const Entry& entry : entries_) {
    if (entry.condition != known) level = cosine_ramp(next_time, ramps_[known = entry.condition]);
    const int i = nodes.node[entry.slot];
    const double target = entry.initial + entry.change * level;
    const double acceleration = (target - state.displacement[i][entry.axis]) / step.displacement;
    accelerate(state, step, i, entry.axis, acceleration);
    state.displacement[i][entry.axis] = target;
    nodes.support[entry.slot][entry.axis] = acceleration * nodes.mass[entry.slot];
  }
  for (const Varying& varying : varying_) {
    const double ramp = cosine_ramp(next_time, ramps_[varying.condition]);
    const bool of_place = varying.formula->of_place();
    double value = of_place ? 0 : (*varying.formula)(next_time);
    for (const auto& m : varying.members) {
      if (of_place) value = (*varying.formula)(m.place, next_time);
      const int i = nodes.node[m.slot];
      const double target = m.initial + value * ramp;
      const double acceleration = (target - state.displacement[i][varying.axis]) / step.displacement;
      accelerate(state, step, i, varying.axis, acceleration);
      state.displacement[i][varying.axis] = target;
      nodes.support[m.slot][varying.axis] = acceleration * nodes.mass[m.slot];
      sound_ = sound_ && std::isfinite(target);
    }
  }
}

}  // namespace slipscale
