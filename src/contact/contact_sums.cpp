#include "slipscale/contact/contact_sums.hpp"

#include <cmath>

namespace slipscale {

void ContactSums::add(const ContactNodes& contact, double path, const Vector2* before, const Vector2* after) {
  for (int k = 0; k < size(); ++k) {
    Sums &done = done_[k], &coming = coming_[k];
    const bool was_closed = coming.closed != 0;
    done.slip += coming.slip;
    done.pressure_slip += coming.pressure_slip;
    done.closed += coming.closed;
    done.force += coming.force;
    done.closures += coming.closures;
    if (contact.status[k] == ContactStatus::open) {
      coming = {};
      continue;
    }
    // A node whose motion is prescribed may slide although friction would hold it.
    const bool moves = contact.status[k] == ContactStatus::slip || contact.held[k];
    const double normal = contact.force[k][1],
                 slip = moves ? std::abs(path - (after[contact.node[k]][0] - before[contact.slot[k]][0])) : 0;
    coming = {slip, normal * slip, 1, normal, was_closed ? 0.0 : 1.0};
  }
}

void ContactSums::add_state(StateGroup& contact_nodes) {
  if (!kept_) return;
  static_assert(sizeof(Sums) == 5 * sizeof(double));
  const auto numbers = [](std::vector<Sums>& sums) { return sums.empty() ? nullptr : &sums[0].slip; };
  const char* text = "slip (m), pressure times slip (N), steps closed, sum of normal forces (N/m), closures";
  contact_nodes.arrays.push_back({"sums", "1", text, 5, numbers(done_)});
  contact_nodes.arrays.push_back(
      {"sums_coming", "1", std::string("of the coming step: ") + text, 5, numbers(coming_)});
}

}  // namespace slipscale
