#include "opened_contact.hpp"

#include <algorithm>

#include "inner.hpp"
#include "slipscale/base/parallel.hpp"

namespace slipscale {
namespace {

constexpr long most_columns = 100;  ///< a factorisation costs some thirty solves, and memory is scarce

long sum(MPI_Comm comm, long value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_LONG, MPI_SUM, comm);
  return value;
}

}  // namespace

bool OpenedContact::follow(const SlidingOperator& now) {
  const MPI_Comm comm = base_->comm();
  const FreeComponents &before = base_->free(), &free = now.free();
  // Components that are free now, where the base has them.
  in_base_.assign(static_cast<std::size_t>(free.size()), -1);
  for (Eigen::Index k = free.side_begin(); k < free.size(); ++k)
    in_base_[static_cast<std::size_t>(k)] = before.side_begin() + k - free.side_begin();
  const int owned = base_->model().mesh.nodes.owned;
  for (int i = 0; i < owned; ++i)
    for (int axis = 0; axis < 2; ++axis)
      if (const int k = free.place_of(i, axis); k >= 0)
        in_base_[static_cast<std::size_t>(k)] = before.place_of(i, axis);

  std::vector<Opened> open;
  const auto& closed = base_->closed();
  for (std::size_t row = 0; row < closed.size(); ++row)
    if (const int k = free.place_of(closed[row].node, 1); k >= 0)
      open.push_back({closed[row].node, static_cast<Eigen::Index>(row), k});
  const bool closes = free.size() != before.size() + static_cast<Eigen::Index>(open.size());
  if (sum(comm, closes) > 0) return false;
  std::vector<Opened> fresh;
  for (const Opened& each : open)
    if (std::ranges::none_of(known_, [&](const Opened& other) { return other.node == each.node; }))
      fresh.push_back(each);
  const long added = sum(comm, static_cast<long>(fresh.size()));
  if (static_cast<long>(known_.size()) + added > most_columns) return false;
  if (added > 0) add_columns(fresh);

  active_.clear();
  for (std::size_t k = 0; k < known_.size(); ++k) {
    const auto found = std::ranges::find(open, known_[k].node, &Opened::node);
    known_[k].free = known_[k].node >= 0 && found != open.end() ? found->free : -1;
    if (sum(comm, known_[k].free >= 0) > 0) active_.push_back(static_cast<Eigen::Index>(k));
  }
  const auto count = static_cast<Eigen::Index>(active_.size());
  active_column_.resize(before.size(), count);
  Eigen::MatrixXd schur = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Opened& each = known_[static_cast<std::size_t>(active_[static_cast<std::size_t>(k)])];
    active_column_.col(k) = column_.col(active_[static_cast<std::size_t>(k)]);
    if (each.free < 0) continue;
    for (Eigen::Index j = 0; j < count; ++j)
      schur(k, j) = reaction_(each.row, active_[static_cast<std::size_t>(j)]);
  }
  MPI_Allreduce(MPI_IN_PLACE, schur.data(), static_cast<int>(schur.size()), MPI_DOUBLE, MPI_SUM, comm);
  if (count > 0) schur_.compute(schur);
  return true;
}

void OpenedContact::add_columns(const std::vector<Opened>& fresh) {
  const MPI_Comm comm = base_->comm();
  const FreeComponents& free = base_->free();
  const auto old = static_cast<Eigen::Index>(known_.size());
  const int ranks = ranks_of(comm), rank = rank_of(comm);
  for (int owner = 0; owner < ranks; ++owner) {
    auto count = static_cast<int>(fresh.size());
    MPI_Bcast(&count, 1, MPI_INT, owner, comm);
    for (int k = 0; k < count; ++k)
      known_.push_back(rank == owner ? fresh[static_cast<std::size_t>(k)] : Opened{});
  }
  const auto size = static_cast<Eigen::Index>(known_.size());
  const auto nodes = static_cast<std::size_t>(base_->model().mesh.nodes.owned);
  std::vector<Vector2> u(nodes), force(nodes);
  Columns right(free.size(), size - old);
  for (Eigen::Index k = old; k < size; ++k) {
    const int node = known_[static_cast<std::size_t>(k)].node;
    std::ranges::fill(u, Vector2{0, 0});
    if (node >= 0) u[node][1] = 1;
    base_->internal_force(u.data(), force.data());
    free.restrict_to(force.data(), right.col(k - old).data());
  }
  column_.conservativeResize(free.size(), size);
  column_.rightCols(size - old) = base_->solve(right);
  const auto& closed = base_->closed();
  reaction_.conservativeResize(static_cast<Eigen::Index>(closed.size()), size);
  for (Eigen::Index k = old; k < size; ++k) {
    const int node = known_[static_cast<std::size_t>(k)].node;
    const Column minus = -column_.col(k);
    free.expand(minus.data(), u.data());
    if (node >= 0) u[node][1] = 1;
    base_->internal_force(u.data(), force.data());
    for (std::size_t row = 0; row < closed.size(); ++row)
      reaction_(static_cast<Eigen::Index>(row), k) = force[closed[row].node][1];
  }
}

Column OpenedContact::solve(const Column& right) const {
  Column in_base = Column::Zero(base_->free().size());
  for (std::size_t k = 0; k < in_base_.size(); ++k)
    if (in_base_[k] >= 0) in_base[in_base_[k]] = right[static_cast<Eigen::Index>(k)];
  Column found = base_->solve(in_base);
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(active_.size()));
  if (!active_.empty()) {
    const MPI_Comm comm = base_->comm();
    for (std::size_t k = 0; k < active_.size(); ++k)
      if (const Eigen::Index place = known_[static_cast<std::size_t>(active_[k])].free; place >= 0)
        moved[static_cast<Eigen::Index>(k)] = right[place];
    MPI_Allreduce(MPI_IN_PLACE, moved.data(), static_cast<int>(moved.size()), MPI_DOUBLE, MPI_SUM, comm);
    moved = schur_.solve(moved - inner(comm, active_column_, in_base)).eval();
    found -= active_column_ * moved;
  }
  Column all(right.size());
  for (std::size_t k = 0; k < in_base_.size(); ++k)
    if (in_base_[k] >= 0) all[static_cast<Eigen::Index>(k)] = found[in_base_[k]];
  for (std::size_t k = 0; k < active_.size(); ++k)
    if (const Eigen::Index place = known_[static_cast<std::size_t>(active_[k])].free; place >= 0)
      all[place] = moved[static_cast<Eigen::Index>(k)];
  return all;
}

}  // namespace slipscale
