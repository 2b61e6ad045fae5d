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
  sums_.assign(static_cast<std::size_t>(last_step + 1 - first_), {0, 0});
  const Boundary& found = *body.model().mesh.find_boundary(body.boundary_names()[boundary]);
  for (const int node : found.nodes) slots_.push_back(body.boundary_nodes().slot_of(node));
  tangent_ = directions_of(found).tangent;
}

/// What the rounding of a sum loses is found exactly (D. E. Knuth, The Art of Computer Programming 2, 4.2.2).
void ForceRecord::add_term(Sum& sum, double term) {
  const double total = sum[0] + term, share = total - sum[0];
  sum[1] += (sum[0] - (total - share)) + (term - share);
  sum[0] = total;
}

void ForceRecord::add_sums(void* from, void* to, int* count, MPI_Datatype*) {
  for (int k = 0; k < *count; ++k)
    for (const double part : static_cast<const Sum*>(from)[k]) add_term(static_cast<Sum*>(to)[k], part);
}

void ForceRecord::record(long n) {
  Sum& sum = sums_[static_cast<std::size_t>(n - first_)];
  for (const int slot : slots_) {
    const Vector2 force = body_.force_on_support(slot);
    add_term(sum, force[0] * tangent_[0] + force[1] * tangent_[1]);
  }
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

void ForceRecord::resume() {
  std::ranges::transform(carried_, sums_.begin(), [](double sum) { return Sum{sum, 0}; });
}

std::vector<double> ForceRecord::gather() const {
  std::vector<Sum> all(is_root(body_.comm()) ? sums_.size() : 0);
  MPI_Datatype pair = MPI_DATATYPE_NULL;
  MPI_Op add = MPI_OP_NULL;
  MPI_Type_contiguous(2, MPI_DOUBLE, &pair);
  MPI_Type_commit(&pair);
  MPI_Op_create(add_sums, 1, &add);
  MPI_Reduce(sums_.data(), all.data(), static_cast<int>(sums_.size()), pair, add, 0, body_.comm());
  MPI_Op_free(&add);
  MPI_Type_free(&pair);
  std::vector<double> forces;
  for (const Sum& sum : all) forces.push_back(sum[0] + sum[1]);
  return forces;
}

}  // namespace slipscale
