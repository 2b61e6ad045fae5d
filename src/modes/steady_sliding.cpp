#include "slipscale/modes/steady_sliding.hpp"

#include <algorithm>
#include <cmath>

#include "inner.hpp"
#include "opened_contact.hpp"
#include "sliding_loads.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr int most_rounds = 60;          ///< of the active set
constexpr int most_steps = 300;          ///< of GMRES
constexpr double rough = 1e-6;           ///< of its residual, while nodes open and close
constexpr double fine = 1e-8;            ///< of what the rough solution leaves
constexpr double tolerable = 1e-8;       ///< of the whole, where rounding allows no better
constexpr double rounding_unit = 1e-10;  ///< of reactions and gaps, over their largest

/// One equilibrium for a set of closed nodes.
class Equilibrium {
 public:
  Equilibrium(MPI_Comm comm, const Model& model, const Scene& scene, const SlidingLoads& loads,
              const std::vector<char>& is_closed)
      : comm_(comm), loads_(loads), friction_(reference_coefficient(scene)), place_(loads.place) {
    std::vector<char> held = loads.held;
    std::vector<ClosedNode> closed;
    for (std::size_t k = 0; k < loads.nodes.size(); ++k) {
      if (!is_closed[k]) continue;
      const SurfaceNode& at = loads.nodes[k];
      closed.push_back({at.node, at.length, friction_ > 0 ? at.friction.value / friction_ : 1});
      held[2 * static_cast<std::size_t>(at.node) + 1] = 1;
      place_[at.node][1] = -at.clearance;
    }
    body = std::make_shared<SlidingOperator>(comm, model, FreeComponents(comm, model, held, loads.sides),
                                             std::move(closed), scene.surface->speed > 0 ? 1 : -1);
    // What is free is counted from where it starts: that moves the body as a whole, when it does.
  }

  /// (K − μG) w = Cᵀ(1 − μE)(F − K̄ u_p), where u_p holds the prescribed values: `displacement`, which a call
  /// after the first one makes finer. `inverse`: K⁻¹.
  void solve(const OpenedContact& inverse, double tolerance) {
    if (right_.size() == 0) prepare();
    const auto precondition = [&](const Column& r) -> Column { return inverse.solve(r); };
    const auto operate = [&](const Column& w) { return multiply(w); };
    Column more;
    gmres(comm_, operate, precondition, Column(right_ - multiply(w_)), tolerance, most_steps, more);
    w_ += more;
    displacement.resize(place_.size());
    body->free().expand(w_.data(), displacement.data());
    for (std::size_t i = 0; i < place_.size(); ++i)
      for (int axis = 0; axis < 2; ++axis) displacement[i][axis] += place_[i][axis];
    internal_.resize(place_.size());
    body->internal_force(displacement.data(), internal_.data());
  }

  /// Throws UserError where the solution is none. Collective.
  void refuse_unsolved() const {
    const double size_of_right = sum_of(comm_, right_.squaredNorm()),
                 size_of_rest = sum_of(comm_, (right_ - multiply(w_)).squaredNorm());
    if (!(size_of_rest <= tolerable * tolerable * size_of_right))
      throw UserError(
          "the equilibrium of steady sliding cannot be solved: the friction jams the body or a part of it "
          "hangs loose; look for parts that hang by one node, or give a smaller -friction_coefficient");
  }

  /// (K̄ u − F)_y.
  double reaction(int node) const { return internal_[node][1] - loads_.force[node][1]; }

  std::shared_ptr<SlidingOperator> body;
  std::vector<Vector2> displacement;

 private:
  void prepare() {
    std::vector<Vector2> force(place_.size());
    body->internal_force(place_.data(), force.data());
    for (std::size_t i = 0; i < place_.size(); ++i)
      for (int axis = 0; axis < 2; ++axis) force[i][axis] = loads_.force[i][axis] - force[i][axis];
    right_.resize(body->free().size());
    body->free().restrict_to(force.data(), right_.data());
    add_plate_forces(right_);
    Column reaction(static_cast<Eigen::Index>(body->closed().size()));
    for (std::size_t k = 0; k < body->closed().size(); ++k)
      reaction[static_cast<Eigen::Index>(k)] = force[body->closed()[k].node][1];
    body->add_friction(-friction_, reaction, right_);
    w_ = Column::Zero(right_.size());
  }

  /// (K − μG) w.
  Column multiply(const Column& w) const {
    Column kw(w.size()), reaction(static_cast<Eigen::Index>(body->closed().size()));
    body->multiply(w.data(), kw.data(), reaction.data());
    body->add_friction(-friction_, reaction, kw);
    return kw;
  }

  void add_plate_forces(Column& right) const {
    int rank = 0;
    MPI_Comm_rank(comm_, &rank);
    if (rank != 0) return;
    Eigen::Index at = right.size();
    for (auto side = loads_.sides.rbegin(); side != loads_.sides.rend(); ++side) {
      if (side->tilts) right[--at] += side->force * side->middle;
      right[--at] += side->force;
    }
  }

  MPI_Comm comm_;
  const SlidingLoads& loads_;
  double friction_;
  std::vector<Vector2> place_, internal_;
  Column right_, w_;
};

double largest(MPI_Comm comm, double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, comm);
  return value;
}

/// Opens nodes that are pulled and closes those that went through; how many changed, of all ranks.
long change_set(MPI_Comm comm, const SlidingLoads& loads, const Equilibrium& found,
                std::vector<char>& is_closed) {
  double most_force = 0, most_gap = 0;
  const auto gap = [&](const SurfaceNode& at) { return at.clearance + found.displacement[at.node][1]; };
  for (std::size_t k = 0; k < loads.nodes.size(); ++k) {
    most_force = std::max(most_force, std::abs(found.reaction(loads.nodes[k].node)) * is_closed[k]);
    most_gap = std::max({most_gap, std::abs(gap(loads.nodes[k])), std::abs(loads.nodes[k].clearance)});
  }
  most_force = largest(comm, most_force);
  most_gap = largest(comm, most_gap);
  long changed = 0;
  for (std::size_t k = 0; k < loads.nodes.size(); ++k) {
    const SurfaceNode& at = loads.nodes[k];
    const bool change = is_closed[k] ? found.reaction(at.node) < -rounding_unit * most_force
                                     : gap(at) < -rounding_unit * most_gap;
    if (!change) continue;
    is_closed[k] = !is_closed[k];
    ++changed;
  }
  MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_LONG, MPI_SUM, comm);
  return changed;
}

long count_closed(MPI_Comm comm, const std::vector<char>& is_closed) {
  long count = std::ranges::count_if(is_closed, [](char closed) { return closed != 0; });
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_LONG, MPI_SUM, comm);
  return count;
}

SteadySliding result(MPI_Comm comm, const SlidingLoads& loads, const Scene& scene, Equilibrium& found,
                     const std::vector<char>& is_closed, int rounds) {
  SteadySliding state;
  state.displacement = std::move(found.displacement);
  state.nodes = loads.nodes;
  state.is_closed = is_closed;
  state.rounds = rounds;
  state.notes = loads.notes;
  double normal = 0, tangential = 0;
  for (std::size_t k = 0; k < loads.nodes.size(); ++k) {
    const SteadyCoefficient& friction = loads.nodes[k].friction;
    state.reaction.push_back(is_closed[k] ? std::max(0.0, found.reaction(loads.nodes[k].node)) : 0);
    normal += state.reaction.back();
    tangential += friction.value * state.reaction.back();
    if (is_closed[k] && scene.friction.law == FrictionChoice::Law::exponential)
      found.body->slip_slope.push_back(friction.slope * state.reaction.back());
  }
  state.normal_force = sum_of(comm, normal);
  state.tangential_force =
      found.body->direction() * (scene.friction.varies() ? sum_of(comm, tangential)
                                                         : reference_coefficient(scene) * state.normal_force);
  state.in_contact = static_cast<PetscInt>(count_closed(comm, is_closed));
  auto all = static_cast<PetscInt>(loads.nodes.size());
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPIU_INT, MPI_SUM, comm);
  state.open = all - state.in_contact;
  state.body = found.body;
  return state;
}

void refuse_untouched(MPI_Comm comm, const Scene& scene, const std::vector<char>& is_closed) {
  if (count_closed(comm, is_closed) > 0) return;
  throw UserError("nothing of boundary '" + scene.surface->boundary +
                  "' touches the surface in the steady state; press the body on it through "
                  "-boundary_<boundary>_y, _pressure or _force, or raise -surface_height");
}

/// One memory serves all nodes of a mode.
void refuse_different_memories(const Mesh& mesh, const Scene& scene) {
  const FrictionChoice& friction = scene.friction;
  if (!friction.remembers()) return;
  for (std::size_t r = 1; r < friction.phases.size(); ++r)
    if (const FrictionConstants& one = friction.phases[0], &other = friction.phases[r];
        friction.by_slip_rate ? one.length != other.length : one.time != other.time)
      throw UserError("friction does not remember as long in region '" + mesh.regions[r].name + "' as in '" +
                      mesh.regions[0].name +
                      "', which modes do not know; give both the same -friction_time or -friction_length");
}

}  // namespace

Scene read_sliding_scene(const Options& options, const Mesh& mesh) {
  if (!has_surface(options))
    throw UserError(
        "modes are those of a body that slides, and no surface is given; name the boundary that meets it "
        "with -surface_boundary");
  const Scene scene = read_scene(options, mesh);
  refuse_different_memories(mesh, scene);
  std::vector<std::string> names = unsteady_formulas(scene);
  if (!scene.friction.of_time())  // a coefficient may vary along the contact
    std::erase_if(names, [](const std::string& name) { return name.starts_with("friction_"); });
  if (!names.empty())
    throw UserError("-" + names.front() +
                    " is a formula, but modes are those of a body that slides steadily and uniformly, where "
                    "only pressure, shear and the coefficient of friction may vary, along their boundaries; "
                    "give a number");
  for (const BoundaryCondition& condition : scene.conditions)
    if (condition.absorbing)
      throw UserError(
          "-boundary_" + condition.boundary +
          "_absorbing takes from a mode as its frequency says, which modes do not know; remove it, "
          "or hold the boundary");
  if (scene.surface->speed == 0)
    throw UserError("-surface_speed is 0, so that nothing slides; give the surface a speed");
  if (scene.friction.law == FrictionChoice::Law::none)
    throw UserError(
        "-friction_law none leaves nothing that could feed a mode; give coulomb or regularized, with "
        "-friction_coefficient 0 for the modes without friction");
  // The damping acts on the nodes alone, and the mass that vibrates would be another than the damped one.
  if (scene.damping.mass != 0)
    for (const BoundaryCondition& condition : scene.conditions)
      if (condition.plate_mass != 0)
        throw UserError("-boundary_" + condition.boundary +
                        "_mass gives the plate a mass that -damping_mass does not damp, which modes cannot "
                        "take into account; leave out one of them, or damp with -damping_stiffness");
  return scene;
}

SteadySliding steady_sliding(MPI_Comm comm, const Model& model, const Scene& scene) {
  const SlidingLoads loads = sliding_loads(comm, model, scene);
  std::vector<char> is_closed(loads.nodes.size(), 1);
  refuse_untouched(comm, scene, is_closed);
  std::unique_ptr<OpenedContact> inverse;
  for (int round = 1; round <= most_rounds; ++round) {
    refuse_unsupported(comm, model, loads, is_closed);
    Equilibrium found(comm, model, scene, loads, is_closed);
    if (!inverse || !inverse->follow(*found.body)) {
      inverse = std::make_unique<OpenedContact>(found.body);
      (void)inverse->follow(*found.body);
    }
    found.solve(*inverse, rough);
    long changed = change_set(comm, loads, found, is_closed);
    if (changed == 0) {
      found.solve(*inverse, fine);
      found.refuse_unsolved();
      changed = change_set(comm, loads, found, is_closed);
    }
    if (changed == 0) return result(comm, loads, scene, found, is_closed, round);
    refuse_untouched(comm, scene, is_closed);
  }
  throw UserError(
      format("the contact of steady sliding does not settle: nodes open and close in turn after {} rounds; "
             "give a smaller -friction_coefficient or another load",
             most_rounds));
}

bool keeps_contact(MPI_Comm comm, const Model& model, const Scene& scene, const SteadySliding& state) {
  const SlidingLoads loads = sliding_loads(comm, model, scene);
  Equilibrium found(comm, model, scene, loads, state.is_closed);
  OpenedContact inverse(state.body);
  std::vector<char> is_closed = state.is_closed;
  if (!inverse.follow(*found.body)) return false;
  found.solve(inverse, rough);
  return change_set(comm, loads, found, is_closed) == 0;
}

}  // namespace slipscale
