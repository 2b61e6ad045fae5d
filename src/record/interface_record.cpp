#include "slipscale/record/interface_record.hpp"

#include <algorithm>

#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {

InterfaceRecord::InterfaceRecord(const SlidingBody& body, const InterfaceChoice& choice)
    : body_(body),
      choice_(choice),
      found_(find_inclusions(body.model().mesh,
                             inclusions_region(choice.region, body.model().mesh.region_names()))),
      at_nodes_(body.model().mesh, body.model().materials,
                inclusions_region(choice.region, body.model().mesh.region_names()), found_),
      gather_(body.comm(), std::vector<PetscInt>(at_nodes_.rows().begin(), at_nodes_.rows().end())),
      strained_(body.model().mesh.nodes.number.size()) {
  refuse_no_interface(choice.region, found_.inclusions);
  if (body.scene().damping.stiffness > 0)
    past_ = std::make_unique<NodalVector>(body.comm(), body.model().mesh.nodes, true);
}

void InterfaceRecord::keep_past() {
  std::copy_n(body_.displacement_n(), strained_.size(), past_->data());
  kept_ = static_cast<double>(body_.steps_done());
}

std::vector<Vector2> InterfaceRecord::forces() const {
  const Scene& scene = body_.scene();
  const bool first = body_.steps_done() == 1;
  const StepCoefficients step =
      first ? first_step(body_.time_step(), scene.beta2) : beta2_step(body_.time_step(), scene.beta2);
  const Vector2 *const u = body_.displacement_n(), *strained = u;
  if (past_ && kept_ > 0 && kept_ == static_cast<double>(body_.steps_done() - 1)) {
    const double lag = scene.damping.stiffness / body_.time_step();
    for (std::size_t i = 0; i < strained_.size(); ++i)
      for (int axis = 0; axis < 2; ++axis)
        strained_[i][axis] = u[i][axis] + lag * (u[i][axis] - past_->data()[i][axis]);
    strained = strained_.data();
  }
  std::vector<double> mine;
  mine.reserve(2 * at_nodes_.rows().size());
  for (std::size_t k = 0; k < at_nodes_.rows().size(); ++k) {
    const int i = at_nodes_.node(k);
    const Vector2 internal = at_nodes_.internal(k, strained), &a = body_.acceleration_n()[i],
                  &v = body_.velocity_n()[i], g = body_.body_acceleration(i);
    for (int axis = 0; axis < 2; ++axis) {
      const double w = v[axis] - step.velocity * a[axis];
      mine.push_back(internal[axis] + at_nodes_.mass(k) * (a[axis] + scene.damping.mass * w - g[axis]));
    }
  }
  const auto all = gather_(mine, 2);
  std::vector<Vector2> forces;
  for (std::size_t k = 0; k + 1 < all.size(); k += 2) forces.push_back({all[k], all[k + 1]});
  return forces;
}

std::string InterfaceRecord::describe() const {
  return format("interfaces of {} inclusions of region '{}', {} nodes", found_.inclusions.size(),
                choice_.region, found_.inclusions.interface.size());
}

std::vector<StateGroup> InterfaceRecord::state() {
  if (!past_) return {};
  const Nodes& nodes = body_.model().mesh.nodes;
  return {{"interface_nodes",
           {nodes.number.begin(), nodes.number.begin() + nodes.owned},
           nodes.total,
           true,
           {{"past_displacement", "m", "u of the step that was kept last for a row of interfaces.h5", 2,
             past_->data()->data()}}},
          {"interface_record",
           {0},
           0,
           is_root(body_.comm()),
           {{"kept", "1", "steps made when it was kept; 0: none was", 1, &kept_}}}};
}

void InterfaceRecord::resume() {
  if (!past_) return;
  past_->begin_update();
  past_->end_update();
}

}  // namespace slipscale
