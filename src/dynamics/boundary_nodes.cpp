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
    if (condition.pressure == 0 && condition.shear == 0 && !condition.is_straight()) continue;
    const Boundary& boundary = *mesh.find_boundary(condition.boundary);
    std::vector<Entry> own;
    for (int i : boundary.nodes) own.push_back({nodes.slot_of(i), c, {0, 0}});
    for (const BoundaryEdge& edge : boundary.edges) {
      const double length = std::hypot(edge.outward[0], edge.outward[1]);
      const Vector2 half{0.5 * (condition.shear * length - condition.pressure * edge.outward[0]),
                         -0.5 * condition.pressure * edge.outward[1]};
      for (int end : edge.nodes) {
        if (end >= mesh.nodes.owned) continue;
        Vector2& force =
            own[std::lower_bound(boundary.nodes.begin(), boundary.nodes.end(), end) - boundary.nodes.begin()]
                .force;
        force = {force[0] + half[0], force[1] + half[1]};
      }
    }
    entries_.insert(entries_.end(), own.begin(), own.end());
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
}

Supports::Supports(MPI_Comm comm, const Mesh& mesh, const std::vector<BoundaryCondition>& conditions,
                   const BoundaryNodes& nodes, const Vector2* initial_displacement) {
  std::string fault;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const BoundaryCondition& condition = conditions[c];
    ramps_.push_back(condition.ramp);
    for (int axis = 0; axis < 2; ++axis) {
      if (!condition.displacement[axis]) continue;
      for (int i : mesh.find_boundary(condition.boundary)->nodes) {
        const Entry entry{nodes.slot_of(i), axis, c, initial_displacement[i][axis],
                          *condition.displacement[axis]};
        const auto same = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& other) {
          return other.slot == entry.slot && other.axis == axis;
        });
        if (same == entries_.end()) {
          entries_.push_back(entry);
        } else if (same->change != entry.change ||
                   (entry.change != 0 && ramps_[same->condition] != condition.ramp)) {
          const char* name = axis == 0 ? "x" : "y";
          fault = "boundaries '" + conditions[same->condition].boundary + "' and '" + condition.boundary +
                  "' prescribe different displacements along " + name +
                  " at the node they share; make -boundary_" + condition.boundary + "_" + name +
                  " equal to the other, or free";
        }
      }
    }
  }
  throw_together(comm, fault);
}

bool Supports::prescribes(int slot, int axis) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& entry) { return entry.slot == slot && entry.axis == axis; });
}

void Supports::start(const BoundaryNodes& nodes, Vector2* velocity) const {
  for (const Entry& entry : entries_) velocity[nodes.node[entry.slot]][entry.axis] = 0;
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
}

}  // namespace slipscale
