#pragma once

#include <memory>
#include <vector>

#include "slipscale/modes/sliding_operator.hpp"

namespace slipscale {

/// K⁻¹ of a body some of whose closed nodes have opened since its stiffness K_A was factorised. By block
/// elimination with the columns K_A⁻¹ K_AO of the opened components O, each of which costs one solve, once:
/// far less than another factorisation for every round of an active set.
class OpenedContact {
 public:
  explicit OpenedContact(std::shared_ptr<const SlidingOperator> base) : base_(std::move(base)) {}

  /// Makes `solve` that of `now`, on whose free components it works from then on. False, and nothing done,
  /// where nodes have closed that the base has open, or more have opened than columns pay for. Collective.
  bool follow(const SlidingOperator& now);
  Column solve(const Column& right) const;

 private:
  /// A component that was held in the base.
  struct Opened {
    int node = -1;           ///< local; −1 on ranks that do not own it
    Eigen::Index row = -1;   ///< among the closed nodes of the base
    Eigen::Index free = -1;  ///< among what is free now
  };
  void add_columns(const std::vector<Opened>& fresh);

  std::shared_ptr<const SlidingOperator> base_;
  std::vector<Opened> known_;  ///< all that have a column, the same number on every rank
  Columns column_;             ///< K_A⁻¹ K_AO, [free of the base, known]
  Eigen::MatrixXd reaction_;   ///< of the unit displacement less its column, [closed of the base, known]
  std::vector<Eigen::Index> active_;  ///< those that are open now
  Columns active_column_;             ///< their columns
  Eigen::PartialPivLU<Eigen::MatrixXd> schur_;
  std::vector<Eigen::Index> in_base_;  ///< of what is free now; −1: opened
};

}  // namespace slipscale
