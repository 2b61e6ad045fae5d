#pragma once

#include <variant>
#include <vector>

#include "slipscale/base/large_array.hpp"
#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/eigenvalue_bound.hpp"
#include "slipscale/solid/material.hpp"
#include "slipscale/solid/pair_stiffness.hpp"

namespace slipscale {

/// The discrete body: mesh, materials, row-sum mass and stiffness. The mesh must outlive it.
class Model {
 public:
  enum class Storage { full, single };
  Model(const Mesh& mesh, std::vector<Material> materials, Storage storage,
        const StiffnessKernel& kernel = {});

  const Mesh& mesh;
  const StiffnessKernel kernel;
  const std::vector<Material> materials;  ///< [regions]
  const std::vector<double> mass;         ///< [owned nodes], kg/m
  const std::variant<PairStiffness<double>, PairStiffness<float>> stiffness;

  void multiply(Vector2* displacement, Vector2* force) const {
    std::visit([&](const auto& each) { each.multiply(displacement, force); }, stiffness);
  }
  /// Part of the whole mesh's nodes whose rows of the stiffness repeat from node to node. Collective.
  double repeating(MPI_Comm comm) const;
};

/// A Vec of blocks of two, one a node: the owned nodes, and behind them in the same array the ghosts if it
/// has any.
class NodalVector {
 public:
  NodalVector(MPI_Comm comm, const Nodes& nodes, bool with_ghosts);
  ~NodalVector();
  NodalVector(const NodalVector&) = delete;
  NodalVector& operator=(const NodalVector&) = delete;

  Vector2* data() const { return const_cast<Vector2*>(array_.data()); }
  Vec vec() const { return vec_; }
  /// The halo exchange: sends the owned values to the ranks that hold them as ghosts. `end` without `begin`
  /// does nothing.
  void begin_update();
  void end_update();

 private:
  LargeArray<Vector2> array_;
  OwnedVec vec_;
  Vec local_ = nullptr;
  bool updating_ = false;
};

struct FrequencyBounds {
  double sharp = 0;  ///< 1/s, by Lanczos on M⁻¹K, with the residual as margin, rounded up to 4 digits
  double safe = 0;   ///< 1/s, from the largest element eigenvalue
  CriticalCell critical = {};
};

/// The largest frequency of the undamped free body, two ways. Does not depend on the number of ranks.
/// Infinite where the stiffness or the mass of a cell is beyond double precision. Collective.
FrequencyBounds largest_frequency(MPI_Comm comm, const Model& model);

}  // namespace slipscale
