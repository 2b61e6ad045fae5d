#include "slipscale/contact/contact_nodes.hpp"

namespace slipscale {

void ContactNodes::add(int local_node, int place, double nodal_mass, double length, double height,
                       bool is_held) {
  node.push_back(local_node);
  slot.push_back(place);
  mass.push_back(nodal_mass);
  normal_mass.push_back(nodal_mass);
  tributary_length.push_back(length);
  clearance.push_back(height);
  rise.push_back(0);
  past_rise.push_back(0);
  held.push_back(is_held);
  memory.push_back({});
  force.push_back({0, 0});
  traction.push_back(0);
  pressure.push_back(0);
  status.push_back(ContactStatus::open);
}

void ContactNodes::start_memory(double tangential, double normal) {
  for (FrictionMemory& m : memory) m = {tangential, normal};
}

}  // namespace slipscale
