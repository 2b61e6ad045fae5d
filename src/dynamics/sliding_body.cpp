#include "slipscale/dynamics/sliding_body.hpp"

#include <algorithm>

#include "slipscale/base/log.hpp"
#include "slipscale/base/order_free_sum.hpp"

namespace slipscale {
namespace {

std::vector<std::string> boundaries_in_use(const Scene& scene) {
  std::vector<std::string> names;
  if (!scene.measured.empty()) names.push_back(scene.measured);
  for (const auto& condition : scene.conditions) names.push_back(condition.boundary);
  if (scene.surface) names.push_back(scene.surface->boundary);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

BulkPhysics bulk_physics(const Scene& scene) {
  const bool dissipates = scene.beta2 > 0.5;
  return {scene.damping.mass > 0, scene.damping.stiffness > 0, dissipates,
          dissipates || scene.friction.asks_slip_rate(), scene.acceleration().of_place()};
}

}  // namespace

SlidingBody::SlidingBody(MPI_Comm comm, const Model& model, const Scene& scene, double time_step)
    : comm_(comm),
      model_(model),
      scene_(scene),
      time_step_(time_step),
      u_(comm, model.mesh.nodes, true),
      w_(comm, model.mesh.nodes, false),
      v_(comm, model.mesh.nodes, false),
      a_(comm, model.mesh.nodes, false),
      force_(model.mesh.nodes.number.size(), {0, 0}),
      kept_(model.mesh.nodes.number.size(), {0, 0}),
      boundary_names_(boundaries_in_use(scene)),
      boundary_(model, boundary_names_),
      loads_(model.mesh, scene.conditions, boundary_),
      body_acceleration_(scene.acceleration(), model.mesh, scene.beta2, time_step),
      formulas_of_time_(!unsteady_formulas(scene).empty()),
      physics_(bulk_physics(scene)),
      ledger_(scene.beta2, time_step) {
  set_initial(scene.initial, model.mesh, model.materials, u_.data(), w_.data());
  supports_ = std::make_unique<Supports>(comm, model.mesh, scene.conditions, boundary_, u_.data());
  straight_ = std::make_unique<StraightSides>(comm, model.mesh, scene.conditions, boundary_, *supports_,
                                              u_.data(), w_.data());
  absorbing_ = std::make_unique<AbsorbingSides>(comm, model, scene.conditions, scene.initial, boundary_,
                                                *supports_, *straight_);
  if (!absorbing_->empty()) boundary_.absorbed.assign(boundary_.node.size(), {0, 0});
  supports_->start_formulas(boundary_, time_step, w_.data());
  inverse_mass_.reserve(model.mass.size());
  for (const double m : model.mass) inverse_mass_.push_back(1 / m);
  if (physics_.keeps_force())
    previous_force_.assign(force_.size(), {0, 0});
  else
    passing_.resize(std::visit([](const auto& each) { return each.passing_size(); }, model.stiffness));
  if (scene_.surface) set_contact_nodes();
  law_ = friction_laws(scene.friction, time_step, contact_places_);
  start_law_ = friction_laws(scene.friction, 0, contact_places_);
  const std::size_t owned = model.mass.size();
  terms_.resize(2 * moving_things() + owned + (scene_.body_acceleration != Vector2{} ? owned : 0));
  ledger_.start(physics_, model.mesh.nodes.owned, boundary_.size(), contact_.size(),
                static_cast<int>(straight_->size()), lifts(), !absorbing_->empty());
  start_force();
  for (int k = 0; k < boundary_.size(); ++k) boundary_.displacement[k] = u_.data()[boundary_.node[k]];
  std::vector<double> work(scene.body_acceleration != Vector2{} ? model.mass.size() : 0);
  for (std::size_t i = 0; i < work.size(); ++i) work[i] = gravity_work(static_cast<int>(i), u_.data()[i]);
  start_gravity_ = order_free_sums(comm, {work}, largest_count())[0];
}

/// Where the body was at t = −Δt with the velocity that it starts with, and supports with theirs.
void SlidingBody::set_past(NodalVector& past) const {
  std::copy_n(w_.data(), model_.mesh.nodes.owned, past.data());
  supports_->start(boundary_, time_step_, past.data());
  for (int i = 0; i < model_.mesh.nodes.owned; ++i)
    for (int axis = 0; axis < 2; ++axis)
      past.data()[i][axis] = u_.data()[i][axis] - time_step_ * past.data()[i][axis];
  past.begin_update();
  past.end_update();
}

/// The stiffness damping of the first step lags like that of every other one: K u at t = −Δt.
void SlidingBody::start_force() {
  if (!physics_.stiffness_damping) return model_.multiply(u_.data(), force_.data());
  NodalVector past(comm_, model_.mesh.nodes, true);
  set_past(past);
  model_.multiply(past.data(), force_.data());
}

void SlidingBody::keep_cell_damping() {
  if (!physics_.mass_damping && !physics_.stiffness_damping) return;
  NodalVector past(comm_, model_.mesh.nodes, true);
  set_past(past);
  cell_damping_ = std::make_unique<CellDamping>(comm_, model_, scene_.damping, scene_.beta2, time_step_,
                                                u_.data(), past.data(), w_.data());
}

NodalState SlidingBody::state(bool with_acceleration) const {
  return {u_.data(), w_.data(), with_acceleration ? a_.data() : nullptr};
}

/// What the step must not lose of the one before.
void SlidingBody::remember(Observed observed, const NodalState& moving) {
  static const LogEvent event("BoundaryMemory");
  const LogEvent::Scope scope(event);
  boundary_.remember(moving, force_.data());
  if (observed == Observed::boundary)
    for (int k = 0; k < boundary_.size(); ++k) kept_[boundary_.node[k]] = boundary_.displacement[k];
  if (physics_.keeps_force()) std::swap(force_, previous_force_);
}

void SlidingBody::touch_surface(bool first, const StepCoefficients& step, const NodalState& moving) {
  static const LogEvent event("Contact");
  const LogEvent::Scope scope(event);
  const double now = static_cast<double>(step_) * time_step_,
               next = static_cast<double>(step_ + 1) * time_step_;
  surface_travel_ = scene_.surface->travel(now, next);
  if (lifts())
    for (int k = 0; k < contact_.size(); ++k) contact_.lift(k, clearance(k, next));
  if (!absorbing_->empty()) absorbing_->resist(step, boundary_, contact_);
  if (scene_.friction.of_time())
    sound_ = follow(scene_.friction, now, contact_places_, first ? start_law_ : law_) && sound_;
  const ContactStep contact{step, surface_travel_, scene_.surface->velocity(now)};
  std::visit(
      [&](const auto& law) {
        contact_.enforce(law, contact, boundary_.displacement.data(), boundary_.support.data(), moving);
      },
      first ? start_law_ : law_);
}

void SlidingBody::add_to_ledger(bool first, const StepCoefficients& step, const NodalState& moving) {
  static const LogEvent event("Ledger");
  const LogEvent::Scope scope(event);
  ledger_.add(boundary_, contact_, moving, surface_travel_);
  sums_.add(contact_, surface_travel_, boundary_.displacement.data(), u_.data());
  if (lifts()) ledger_.add_lift(contact_);
  if (!absorbing_->empty()) {
    absorbing_->measure(step, boundary_, moving);
    ledger_.add_absorbed(boundary_, moving);
  }
  if (!straight_->empty()) ledger_.add_plates(*straight_);
  if (physics_.keeps_force())
    ledger_.correct_bulk(physics_, scene_.damping, step, boundary_, contact_, moving, force_.data(), first);
}

void SlidingBody::advance(Observed observed) {
  const double now = static_cast<double>(step_) * time_step_,
               next = static_cast<double>(step_ + 1) * time_step_;
  const bool first = step_ == 0;
  if (first) observed = Observed::everything;  // the energy at the start is what the ledger counts from
  const StepCoefficients step =
      first ? first_step(time_step_, scene_.beta2) : beta2_step(time_step_, scene_.beta2);
  const NodalState moving = state(observed != Observed::nothing || physics_.keeps_acceleration);

  remember(observed, moving);
  if (body_acceleration_.of_time()) sound_ = body_acceleration_.follow(now) && sound_;
  {
    static const LogEvent event("HaloEnd");
    const LogEvent::Scope scope(event);
    u_.end_update();
  }
  if (cell_damping_ && !first) {
    static const LogEvent event("CellDamping");
    const LogEvent::Scope scope(event);
    cell_damping_->close_step(u_.data(), w_.data());
  }
  {
    static const LogEvent event("StiffnessMotion");
    const LogEvent::Scope scope(event);
    free_motion(step, observed);
  }
  {
    static const LogEvent event("LoadsSupports");
    const LogEvent::Scope scope(event);
    if (!loads_.empty()) loads_.apply(now, step, boundary_, moving);
    if (!absorbing_->empty()) absorbing_->apply(step, boundary_, moving);
    if (!supports_->empty()) supports_->apply(next, step, boundary_, moving);
    for (const auto& side : *straight_)
      side->apply(now, step, scene_.damping, body_acceleration_, force_.data(), boundary_, moving);
  }
  if (scene_.surface) touch_surface(first, step, moving);
  {
    static const LogEvent event("HaloBegin");
    const LogEvent::Scope scope(event);
    u_.begin_update();
  }
  add_to_ledger(first, step, moving);
  if (body_acceleration_.of_time()) body_acceleration_.add_work(moving, next);
  if (observed != Observed::nothing) observe_boundary(step, observed);
  ++step_;
  if (first) {
    const Energy start = energy();
    start_energy_ = start.kinetic + start.strain;
  }
}

double SlidingBody::surface_velocity() const { return scene_.surface ? scene_.surface->velocity(time()) : 0; }

bool SlidingBody::lifts() const {
  return scene_.surface && scene_.surface->height_formula && scene_.surface->height_formula->of_time();
}

double SlidingBody::clearance(int k, double time) const {
  return contact_places_[k].place[1] - scene_.surface->height_at(contact_places_[k].place[0], time);
}

/// Collective.
bool SlidingBody::formulas_sound() const {
  if (!formulas_of_time_) return true;
  int sound = sound_ && loads_.sound() && supports_->sound();
  MPI_Allreduce(MPI_IN_PLACE, &sound, 1, MPI_INT, MPI_MIN, comm_);
  return sound != 0;
}

bool SlidingBody::has_touched() const {
  int touched = contact_.touched;
  MPI_Allreduce(MPI_IN_PLACE, &touched, 1, MPI_INT, MPI_MAX, comm_);
  return touched != 0;
}

}  // namespace slipscale
