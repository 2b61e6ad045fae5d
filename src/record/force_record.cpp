#include "slipscale/record/force_record.hpp"

#include <algorithm>
#include <limits>

#include "slipscale/base/parallel.hpp"
#include "slipscale/record/observation.hpp"

namespace slipscale {
namespace {

constexpr long most_steps = 1L << 17;
constexpr long largest_key = 1L << 30;  ///< far more than the steps that are recorded, and a PetscInt

}  // namespace

ForceRecord::ForceRecord(const SlidingBody& body, int boundary, long last_step) : body_(body) {
  if (boundary < 0) {
    first_ = std::numeric_limits<long>::max();
    return;
  }
  first_ = std::max(last_step / 2, last_step + 1 - most_steps);
  sums_.assign(static_cast<std::size_t>(last_step + 1 - first_), 0);
  const Boundary& found = *body.model().mesh.find_boundary(body.boundary_names()[boundary]);
  for (const int node : found.nodes) slots_.push_back(body.boundary_nodes().slot_of(node));
  tangent_ = directions_of(found).tangent;
}

void ForceRecord::record(long n) {
  double sum = 0;
  for (const int slot : slots_) {
    const Vector2 force = body_.force_on_support(slot);
    sum += force[0] * tangent_[0] + force[1] * tangent_[1];
  }
  sums_[static_cast<std::size_t>(n - first_)] = sum;
}

StateGroup ForceRecord::state(long n) {
  carried_ = gather();
  if (n < first_) carried_.clear();
  carried_.resize(std::min(carried_.size(), static_cast<std::size_t>(std::max(0L, n + 1 - first_))));
  StateGroup group{"force_record",
                   {},
                   0,
                   true,
                   {{"force", "N/m", "tangential, at the measured boundary", 1, carried_.data()}}};
  for (std::size_t k = 0; k < carried_.size(); ++k)
    group.keys.push_back(static_cast<PetscInt>((first_ + static_cast<long>(k)) % largest_key));
  return group;
}

void ForceRecord::resume() { std::copy(carried_.begin(), carried_.end(), sums_.begin()); }

std::vector<double> ForceRecord::gather() const {
  std::vector<double> all(is_root(body_.comm()) ? sums_.size() : 0);
  MPI_Reduce(sums_.data(), all.data(), static_cast<int>(sums_.size()), MPI_DOUBLE, MPI_SUM, 0, body_.comm());
  return all;
}

}  // namespace slipscale
