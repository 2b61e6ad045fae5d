#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/files/file_order.hpp"
#include "slipscale/mesh/mesh.hpp"
#include "slipscale/mesh/plane_grid.hpp"

namespace slipscale {

/// The local cells whose centre (the mean of the corners) lies in the box or on its edge, [cells] 1 or 0.
std::vector<char> cells_in(const Cells& cells, const Box& box);

/// The mesh as files for ParaView show it: points, cells and their order, independent of the number of ranks.
///
/// Points are the nodes by whole-mesh number. On a periodic mesh a node on the seam is drawn at more than one
/// place: the further ones are extra points behind the nodes, in the order of (node number, position), so
/// that no cell is drawn across the whole block.
///
/// With a box the image is that of the cells whose centres lie in it and of their corners, in the same order.
class MeshImage {
 public:
  enum class Topology { triangles, quadrilaterals, mixed };

  /// Collective.
  MeshImage(MPI_Comm comm, const Mesh& mesh, const std::optional<Box>& box = std::nullopt);
  /// Of a mesh that every rank holds whole, of which this rank provides the cells [begin, end): these are its
  /// local cells, and nodes are points. Collective.
  MeshImage(MPI_Comm comm, const PlaneGrid& grid, std::size_t begin, std::size_t end);

  Topology topology() const { return topology_; }
  std::uint64_t checksum() const { return checksum_; }  ///< of the mesh file; 0: there is none
  const Box& block() const { return block_; }           ///< of the whole mesh, m, where a box shows a part
  const FileOrder& points() const { return points_; }
  const FileOrder& cells() const { return cells_; }
  const std::vector<int>& point_nodes() const {
    return point_nodes_;
  }  ///< local node of each point this rank holds
  const std::vector<int>& cell_places() const {
    return cell_places_;
  }  ///< local number of each cell this rank owns and draws, ascending

  const std::vector<std::string>& region_names() const { return region_names_; }

  /// This rank's slices of the file; collective.
  std::vector<double> coordinates() const;  ///< [points, 2] m
  std::vector<PetscInt> regions() const;    ///< [cells] index into region_names
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
  /// Rows of the file; -1 for what is not drawn (of nodes: not at their own position).
  struct Rows {
    std::vector<PetscInt> node, cell;         ///< of the local ones
    PetscInt node_count = 0, cell_count = 0;  ///< of the whole mesh
  };
  static Rows rows_in(MPI_Comm comm, const Mesh& mesh, const Box& box);
  static std::vector<Extra> gather(MPI_Comm comm, const std::vector<Extra>& mine);
  static std::vector<Extra> extra_points(MPI_Comm comm, const Mesh& mesh, const Rows& rows);
  void set_points(MPI_Comm comm, const Mesh& mesh, const Rows& rows, const std::vector<Extra>& extras);
  void set_cells(MPI_Comm comm, const Mesh& mesh, const Rows& rows, const std::vector<Extra>& extras);
  void add_cell(int place, int region, const std::vector<PetscInt>& points);
  void agree_on_topology(MPI_Comm comm);

  std::uint64_t checksum_ = 0;
  Box block_;
  Topology topology_ = Topology::triangles;
  FileOrder points_, cells_;
  std::vector<int> point_nodes_, cell_places_;
  std::vector<Vector2> positions_;     ///< of the points this rank holds
  std::vector<PetscInt> region_rows_;  ///< [owned cells]
  std::vector<std::string> region_names_;
  std::vector<PetscInt> corner_rows_;  ///< [owned cells, 5] code, points, -1 as filling
};

}  // namespace slipscale
