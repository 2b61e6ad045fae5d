#pragma once

#include <optional>
#include <vector>

#include "slipscale/mesh/plane_grid.hpp"
#include "slipscale/mesh/point_location.hpp"

namespace slipscale {

/// In this room *cells* are those of meshes, and a *unit cell* is the piece of microstructure that a periodic
/// micro mesh draws.

/// How the mesh of the microstructure fills the block of a homogeneous run: repeated with a period, or once.
struct Tiling {
  Box unit;          ///< of the micro mesh, m: the unit cell where it repeats
  Vector2 origin{};  ///< lower left corner of one copy, m
  bool repeats = true;

  /// The point of the micro mesh that stands for `x`.
  Vector2 micro_point(const Vector2& x) const;
};

/// `block` is the box of the whole homogeneous block, also where its run saved a part of the mesh only.
///
/// A micro mesh whose box is that of the block (to 1e-6 of its size) fills it once, unless an origin is
/// given. Another one must be `periodic`, and repeats with its width and height from `origin` (by default
/// from where it lies). Throws UserError when tensors of a whole block (kubc, subc) belong to another block,
/// when a unit cell is not a rectangle (`hole_area`, m², is that of its holes), and when the block holds
/// so many copies that one of the two must be in another unit of length.
Tiling tiling(const PlaneGrid& micro, bool periodic, const Box& block,
              const std::optional<Vector2>& origin = std::nullopt, double hole_area = 0);

/// Where a point lies at both scales.
struct Site {
  CellPlace macro;      ///< on the mesh of the homogeneous run
  int micro_cell = -1;  ///< cell of the microstructure's mesh
};

/// The cells on which stresses are relocalised.
struct Targets {
  PlaneGrid grid;
  std::vector<Site> sites;       ///< [cells] of their centres
  std::vector<int> source_cell;  ///< [cells] its number in the mesh it comes from
};

/// Finds the cells of two meshes that hold a point. Both meshes must outlive this object.
class TwoScales {
 public:
  TwoScales(const PlaneGrid& macro, const PlaneGrid& micro, const Tiling& tiling);

  /// None where the point lies outside of the macro mesh, or in a hole of the micro mesh.
  std::optional<Site> site(const Vector2& x) const;

  /// All copies of the micro mesh that reach into the macro mesh, row by row from the lower left, without the
  /// cells whose centres lie outside; `source_cell` is the cell of the micro mesh. Copies share no points.
  /// Throws UserError when none is left.
  Targets tiles() const;

  /// The cells of another mesh, that of the heterogeneous run, whose centres lie in the macro mesh. Throws
  /// UserError when there is none.
  Targets cells_of(const PlaneGrid& mesh) const;

 private:
  const PlaneGrid &macro_, &micro_;
  Tiling tiling_;
  Box block_;
  PointLocation macro_location_, micro_location_;
};

/// Targets whose region is not, by name, that of the micro cell they are given: where the two meshes draw the
/// interface differently.
int count_of_other_regions(const Targets& targets, const PlaneGrid& micro);

}  // namespace slipscale
