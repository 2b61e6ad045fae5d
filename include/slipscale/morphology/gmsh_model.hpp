#pragma once

#include <array>
#include <string>

#include "slipscale/morphology/composite_mesh.hpp"
#include "slipscale/morphology/drawing.hpp"
#include "slipscale/morphology/grey_image.hpp"

namespace slipscale {

/// gmsh, which keeps its model for itself: one object at a time. Its failures are thrown as LibraryError.
class GmshModel {
 public:
  GmshModel();
  ~GmshModel();
  GmshModel(const GmshModel&) = delete;
  GmshModel& operator=(const GmshModel&) = delete;

  /// Replaces the model by the drawing and meshes it. `regions` are the names of the regions, 0 the matrix.
  void mesh(const Drawing& drawing, const std::vector<std::string>& regions, const Room& room,
            const MeshChoice& choice);

  /// Replaces the model by a rectangle of columns × rows equal cells, triangles by diagonals that alternate.
  /// `region(column, row)` tells where each quadrilateral belongs.
  void mesh_grid(const Box& block, const std::array<bool, 2>& periodic, int columns, int rows, CellShape cell,
                 const std::vector<std::string>& regions, const std::vector<int>& region);

  CompositeMesh read();

  /// Gives nodes of the mesh that was read their new places.
  void move(const CompositeMesh& mesh, const std::vector<int>& nodes);

  /// MSH 4.1, with the regions as physical surfaces and bottom, right, top and left as physical curves.
  void write(const std::string& path) const;

  static std::string version();

 private:
  std::vector<std::string> regions_;
  std::vector<int> region_of_, inclusion_of_;  ///< by the tag of the surface
  std::vector<std::size_t> node_tags_;         ///< of the nodes as read
};

}  // namespace slipscale
