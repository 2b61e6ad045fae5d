// The part of SlidingBody that a checkpoint keeps.
#include "slipscale/base/parallel.hpp"
#include "slipscale/dynamics/sliding_body.hpp"

namespace slipscale {
namespace {

StateGroup at_nodes(const std::string& name, const Nodes& nodes, const std::vector<int>& local) {
  StateGroup group{name, {}, 0, true, {}};
  for (const int node : local) group.keys.push_back(nodes.number[node]);
  return group;
}

template <class Rows>
double* numbers(Rows& rows) {
  return rows.empty() ? nullptr : rows[0].data();
}

}  // namespace

std::vector<StateGroup> SlidingBody::state() {
  const Nodes& mesh = model_.mesh.nodes;
  StateGroup nodes{"nodes", {mesh.number.begin(), mesh.number.begin() + mesh.owned}, mesh.total, true, {}};
  nodes.arrays = {{"displacement", "m", "u at the end of the step", 2, u_.data()->data()},
                  {"predictor", "m/s", "w at the end of the step", 2, w_.data()->data()}};
  if (physics_.keeps_acceleration)
    nodes.arrays.push_back({"acceleration", "m/s^2", "at the beginning of the step", 2, a_.data()->data()});
  StateGroup boundary = at_nodes("boundary_nodes", mesh, boundary_.node);
  boundary.arrays = {
      {"displacement", "m", "u at the beginning of the step", 2, numbers(boundary_.displacement)}};
  carried_force_.clear();
  for (const int node : boundary_.node) carried_force_.push_back(force_[node]);
  StateGroup& of_force = physics_.keeps_force() ? nodes : boundary;
  of_force.arrays.push_back({"internal_force", "N/m", "K u at the beginning of the step", 2,
                             physics_.keeps_force() ? numbers(force_) : numbers(carried_force_)});
  StateGroup contact = at_nodes("contact_nodes", mesh, contact_.node);
  static_assert(sizeof(FrictionMemory) == 2 * sizeof(double));
  if (contact_.size() > 0)
    contact.arrays = {{"memory", "Pa", "what the friction law remembers: traction or strength, and pressure",
                       2, &contact_.memory[0].traction}};
  else
    contact.arrays = {{"memory", "Pa", "", 2, nullptr}};
  ledger_.add_state(nodes, boundary, contact);
  sums_.add_state(contact);
  if (cell_damping_) cell_damping_->add_state(nodes);
  body_acceleration_.add_state(nodes);

  carried_ = {static_cast<double>(step_), surface_travel_, start_gravity_, start_energy_,
              has_touched() ? 1.0 : 0.0};
  static_assert(sizeof(Carried) == 5 * sizeof(double));
  StateGroup run{"body", {0}, 0, is_root(comm_), {}};
  run.arrays = {
      {"carried", "1",
       "steps made, path of the surface over the last (m), work of gravity (J/m) and energy (J/m) at "
       "the start, 1 when the body has touched the surface",
       5, &carried_.steps}};

  std::vector<StateGroup> groups{std::move(nodes), std::move(boundary), std::move(contact), std::move(run)};
  if (cell_damping_) groups.push_back(cell_damping_->cells_state());
  for (const auto& side : *straight_) groups.push_back(side->state());
  for (StateGroup& plate : ledger_.plates_state(*straight_)) groups.push_back(std::move(plate));
  return groups;
}

void SlidingBody::resume() {
  step_ = static_cast<long>(carried_.steps);
  surface_travel_ = carried_.surface_travel;
  start_gravity_ = carried_.start_gravity;
  start_energy_ = carried_.start_energy;
  contact_.touched = carried_.touched != 0;
  if (!physics_.keeps_force())
    for (int k = 0; k < boundary_.size(); ++k) force_[boundary_.node[k]] = carried_force_[k];
  ledger_.resume(surface_travel_);
  if (cell_damping_) cell_damping_->resume();
  if (lifts())
    for (const long n : {step_ - 1, step_})
      for (int k = 0; k < contact_.size(); ++k)
        contact_.lift(k, clearance(k, static_cast<double>(n) * time_step_));
  u_.begin_update();
}

}  // namespace slipscale
