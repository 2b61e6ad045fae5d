#pragma once

#include <vector>

#include "slipscale/dynamics/sliding_body.hpp"
#include "slipscale/mesh/ordered_gather.hpp"

namespace slipscale {

/// State at one point of the body, on rank 0.
struct ProbeReading {
  Vector2 u{}, v{};                ///< m, m/s
  std::array<double, 3> stress{};  ///< (xx, yy, xy), Pa
};

/// Points at which the state is followed. A point within 1e-6 of the block's size of a node is that node (its
/// stress the area-weighted mean of the cells around it); elsewhere the shape functions of its cell are used.
class Probes {
 public:
  /// Throws UserError for a point outside the body. Collective.
  Probes(MPI_Comm comm, const Model& model, const std::vector<Vector2>& points);

  const std::vector<Vector2>& positions() const { return positions_; }  ///< used, m; all ranks

  /// The state at t_n of an observed step, on rank 0 in the order of the points. Collective.
  std::vector<ProbeReading> read(const SlidingBody& body) const;

 private:
  struct Corner {
    int point;
    PetscInt number;  ///< whole-mesh number of the node
    double weight;
  };
  struct CellShare {
    int cell;  ///< local cell
    double weight;
  };
  void place_on_nodes(MPI_Comm comm, const Mesh& mesh, std::vector<char>& placed);
  void place_in_cells(MPI_Comm comm, const Mesh& mesh, std::vector<char>& placed);

  std::vector<Vector2> positions_;
  std::vector<Corner> corners_;                 ///< of all points, the same on every rank
  std::vector<int> own_corner_, own_node_;      ///< this rank's corners and their local nodes
  std::vector<std::vector<CellShare>> shares_;  ///< by point: cells whose stress counts; on the point's rank
  std::vector<int> own_point_;                  ///< points whose stress this rank provides
  OrderedGather corner_gather_, stress_gather_;
};

}  // namespace slipscale
