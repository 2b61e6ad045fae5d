#include "slipscale/dynamics/straight_sides.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "slipscale/base/cosine_ramp.hpp"
#include "slipscale/base/parallel.hpp"

namespace slipscale {
namespace {

/// Smallest and largest x of the boundary's nodes, all ranks. Collective.
std::array<double, 2> extent(MPI_Comm comm, const Boundary& boundary) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  double ends[2] = {nowhere, nowhere};  // of x and of −x
  for (const BoundaryEdge& edge : boundary.edges)
    for (const Vector2& x : edge.ends) ends[0] = std::min(ends[0], x[0]), ends[1] = std::min(ends[1], -x[0]);
  MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MIN, comm);
  return {ends[0], -ends[1]};
}

/// Inverse of the symmetric matrix (11, 12, 22); without the second row and column where `both` is not set.
std::array<double, 3> inverse(const std::array<double, 3>& m, bool both) {
  if (!both) return {1 / m[0], 0, 0};
  const double determinant = m[0] * m[2] - m[1] * m[1];
  return {m[2] / determinant, -m[1] / determinant, m[0] / determinant};
}

PlateMotion product(const std::array<double, 3>& m, const PlateMotion& x) {
  return {m[0] * x[0] + m[1] * x[1], m[1] * x[0] + m[2] * x[1]};
}

}  // namespace

StraightSide::StraightSide(MPI_Comm comm, const Mesh& mesh, const BoundaryCondition& condition,
                           const BoundaryNodes& nodes, const Vector2* displacement, Vector2* predictor)
    : boundary_(condition.boundary),
      force_(condition.plate_force),
      ramp_(condition.ramp),
      formula_(condition.force_formula),
      tilts_(condition.straight == BoundaryCondition::Straight::tilting) {
  const Boundary& boundary = *mesh.find_boundary(condition.boundary);
  const auto ends = extent(comm, boundary);
  const double middle = 0.5 * (ends[0] + ends[1]), length = ends[1] - ends[0];
  own_ = {condition.plate_mass, condition.plate_mass * length * length / 12};

  std::vector<PetscInt> numbers;
  for (int i : boundary.nodes) {
    numbers.push_back(mesh.nodes.number[i]);
    members_.push_back({nodes.slot_of(i), mesh.nodes.position[i][0] - middle, displacement[i][1]});
  }
  MPI_Comm_split(comm, members_.empty() ? MPI_UNDEFINED : 0, rank_of(comm), &comm_);
  if (comm_ == MPI_COMM_NULL) return;
  const int ranks = ranks_of(comm_);
  counts_ = is_root(comm_);

  const int own = static_cast<int>(members_.size());
  counts_of_.resize(static_cast<std::size_t>(ranks));
  starts_of_.assign(static_cast<std::size_t>(ranks), 0);
  MPI_Allgather(&own, 1, MPI_INT, counts_of_.data(), 1, MPI_INT, comm_);
  std::partial_sum(counts_of_.begin(), counts_of_.end() - 1, starts_of_.begin() + 1);
  const auto total = static_cast<std::size_t>(starts_of_.back() + counts_of_.back());
  std::vector<PetscInt> all_numbers(total);
  MPI_Allgatherv(numbers.data(), own, MPIU_INT, all_numbers.data(), counts_of_.data(), starts_of_.data(),
                 MPIU_INT, comm_);
  order_.resize(total);
  std::iota(order_.begin(), order_.end(), 0);
  std::ranges::sort(order_, {}, [&](int k) { return all_numbers[k]; });
  all_.resize(total);
  mine_.resize(members_.size());

  const auto collect = [&](auto&& value) {
    for (std::size_t k = 0; k < members_.size(); ++k) mine_[k] = value(members_[k]);
    MPI_Allgatherv(mine_.data(), own, MPI_DOUBLE, all_.data(), counts_of_.data(), starts_of_.data(),
                   MPI_DOUBLE, comm_);
  };
  collect([](const Member& m) { return m.arm; });
  arms_ = all_;
  collect([&](const Member& m) { return nodes.mass[m.slot]; });
  std::array<double, 3> mass{};
  for (const int k : order_) {
    mass[0] += all_[k];
    mass[1] += all_[k] * arms_[k];
    mass[2] += all_[k] * arms_[k] * arms_[k];
  }
  const auto of_nodes = inverse(mass, tilts_);
  inverse_ = inverse({mass[0] + own_[0], mass[1], mass[2] + own_[1]}, tilts_);
  for (std::size_t k = 0; k < members_.size(); ++k)
    mine_[k] = nodes.mass[members_[k].slot] * predictor[nodes.node[members_[k].slot]][1];
  motion_.moves = product(of_nodes, gather(mine_));
  for (const Member& m : members_)
    predictor[nodes.node[m.slot]][1] = motion_.moves[0] + motion_.moves[1] * m.arm;
}

StraightSide::~StraightSide() {
  if (comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
}

/// Σ x_i and Σ x_i s_i in the order of the nodes' numbers.
PlateMotion StraightSide::gather(const std::vector<double>& mine) {
  MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, all_.data(), counts_of_.data(),
                 starts_of_.data(), MPI_DOUBLE, comm_);
  PlateMotion sum{};
  for (const int k : order_) {
    sum[0] += all_[k];
    sum[1] += all_[k] * arms_[k];
  }
  return sum;
}

void StraightSide::apply(double time, const StepCoefficients& step, const Damping& damping,
                         const BodyAcceleration& gravity, const Vector2* force, BoundaryNodes& nodes,
                         const NodalState& state) {
  if (comm_ == MPI_COMM_NULL) return;
  const double lag = damping.stiffness / step.time_step;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const int slot = members_[k].slot;
    const double internal = force[nodes.node[slot]][1], mass = nodes.mass[slot];
    mine_[k] = nodes.load[slot][1] +
               mass * (gravity.at(nodes.node[slot])[1] - damping.mass * nodes.predictor[slot][1]) - internal -
               lag * (internal - nodes.internal[slot][1]);
  }
  PlateMotion acting = gather(mine_);
  double level = cosine_ramp(time, ramp_);
  if (formula_) level *= (*formula_)(time);
  acting[0] += force_ * level;
  const PlateMotion a = product(inverse_, acting), old_a = motion_.acceleration, past = motion_.increment;
  motion_.before = motion_.place;
  for (std::size_t q = 0; q < a.size(); ++q) {
    motion_.velocity[q] = motion_.moves[q] + step.velocity * a[q];
    motion_.increment[q] = displacement_increment(step, motion_.moves[q], a[q]);
    motion_.place[q] += motion_.increment[q];
    motion_.moves[q] = next_predictor(step, motion_.moves[q], a[q]);
  }
  motion_.acceleration = a;
  for (const Member& m : members_) {
    const int i = nodes.node[m.slot];
    const double target = m.initial + (motion_.place[0] + motion_.place[1] * m.arm);
    const double missing = (target - state.displacement[i][1]) / step.displacement;
    accelerate(state, step, i, 1, missing);
    state.displacement[i][1] = target;
    nodes.load[m.slot][1] += missing * nodes.mass[m.slot];
  }
  inertia_ = {};
  for (std::size_t q = 0; counts_ && q < a.size(); ++q) {
    inertia_.past += own_[q] * a[q] * past[q];
    inertia_.next += own_[q] * a[q] * motion_.increment[q];
    if (motion_.started != 0) inertia_.change += own_[q] * (a[q] - old_a[q]) * (a[q] - old_a[q]);
  }
  motion_.started = 1;
}

StateGroup StraightSide::state() {
  StateGroup group{"plate_" + boundary_, {}, 0, counts_, {}};
  if (comm_ != MPI_COMM_NULL) group.keys = {0};
  static_assert(sizeof(Motion) == 13 * sizeof(double));
  group.arrays = {
      {"motion", "1",
       "place after and before the last step, increment, predictor, velocity and acceleration, each "
       "of the middle (m) and the tilt (rad); 1 when a step was made",
       13, motion_.place.data()}};
  return group;
}

std::array<double, 2> StraightSide::energies() const {
  std::array<double, 2> energies{};
  for (std::size_t q = 0; counts_ && q < own_.size(); ++q) {
    energies[0] += 0.5 * own_[q] * motion_.velocity[q] * motion_.velocity[q];
    energies[1] += 0.5 * own_[q] * motion_.acceleration[q] * motion_.acceleration[q];
  }
  return energies;
}

StraightSides::StraightSides(MPI_Comm comm, const Mesh& mesh,
                             const std::vector<BoundaryCondition>& conditions, const BoundaryNodes& nodes,
                             const Supports& supports, const Vector2* displacement, Vector2* predictor)
    : held_(static_cast<std::size_t>(nodes.size()), 0) {
  std::string fault;
  for (const BoundaryCondition& condition : conditions) {
    if (!condition.is_straight()) continue;
    for (int i : mesh.find_boundary(condition.boundary)->nodes) {
      const int slot = nodes.slot_of(i);
      if (held_[slot] || supports.prescribes(slot, 1))
        fault = "-boundary_" + condition.boundary + "_y keeps boundary '" + condition.boundary +
                "' straight, but another boundary that shares a node with it " +
                (held_[slot] ? "is kept straight as well" : "prescribes the motion along y") +
                "; make the other one free along y";
      held_[slot] = 1;
    }
  }
  throw_together(comm, fault);
  for (const BoundaryCondition& condition : conditions)
    if (condition.is_straight())
      sides_.push_back(std::make_unique<StraightSide>(comm, mesh, condition, nodes, displacement, predictor));
}

bool StraightSides::holds(int slot) const { return held_[slot]; }

}  // namespace slipscale
