#pragma once

#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/record/file_order.hpp"

namespace slipscale {

/// The mesh as files for ParaView show it: points, cells and their order, independent of the number of ranks.
///
/// Points are the nodes by whole-mesh number. On a periodic mesh a node on the seam is drawn at more than one
/// place: the further ones are extra points behind the nodes, in the order of (node number, position), so
/// that no cell is drawn across the whole block.
class MeshImage {
 public:
  enum class Topology { triangles, quadrilaterals, mixed };

  /// Collective.
  MeshImage(MPI_Comm comm, const Mesh& mesh);

  Topology topology() const { return topology_; }
  const FileOrder& points() const { return points_; }
  const FileOrder& cells() const { return cells_; }
  const std::vector<int>& point_nodes() const {
    return point_nodes_;
  }  ///< local node of each point this rank holds
  const std::vector<int>& cell_places() const {
    return cell_places_;
  }  ///< local number of each cell this rank owns

  /// This rank's slices of the file; collective.
  std::vector<double> coordinates() const;                ///< [points, 2] m
  std::vector<PetscInt> regions(const Mesh& mesh) const;  ///< [cells] index into Mesh::regions
  /// [cells, 3] or [cells, 4] point numbers; mixed: XDMF's stream, each cell's code (4 triangle,
  /// 5 quadrilateral) before its points.
  std::vector<PetscInt> connectivity() const;

 private:
  struct Extra {
    PetscInt node;            ///< whole-mesh number
    std::array<int, 2> side;  ///< -1, 0, 1: below, at or above the node's position along x and y
    PetscInt cell;            ///< the lowest cell that draws it there
    Vector2 position;         ///< m
  };
  static std::vector<Extra> gather(MPI_Comm comm, const std::vector<Extra>& mine);
  std::vector<Extra> extra_points(MPI_Comm comm, const Mesh& mesh) const;
  void set_points(MPI_Comm comm, const Mesh& mesh, const std::vector<Extra>& extras);
  void set_cells(MPI_Comm comm, const Mesh& mesh, const std::vector<Extra>& extras);

  Topology topology_ = Topology::triangles;
  FileOrder points_, cells_;
  std::vector<int> point_nodes_, cell_places_;
  std::vector<Vector2> positions_;     ///< of the points this rank holds
  std::vector<PetscInt> corner_rows_;  ///< [owned cells, 5] code, points, -1 as filling
};

}  // namespace slipscale
