#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/morphology/inclusion.hpp"

namespace slipscale {

enum class Arrangement { random, square, hexagonal };
enum class Edge { cut, inside };
enum class SizeDistribution { normal, lognormal, uniform };

/// Inclusions that are drawn from one distribution and form one region of the mesh.
struct Family {
  std::string region;
  Shape shape = Shape::disc;
  double fraction = 0;            ///< of the block's area
  double diameter = 0;            ///< mean of the long axis, m
  double diameter_deviation = 0;  ///< standard deviation over the mean
  SizeDistribution distribution = SizeDistribution::normal;
  double aspect = 1;           ///< long axis over short axis
  double rounding = 1;         ///< corner radius over half the short axis
  double angle = 0;            ///< mean angle of the long axis from x, radian
  double angle_deviation = 0;  ///< radian; infinite: any angle
};

/// Where inclusions may lie.
struct Room {
  Box block;
  std::array<bool, 2> periodic{};  ///< along x, y
  Edge edge = Edge::cut;           ///< at the sides that are not periodic
  double keep_out = 0;             ///< thickness of the layer at the bottom without inclusions, m
  double gap = 0;                  ///< smallest distance between two inclusions, m
  /// An outline touches no side and passes no corner of the block closer than this, unless it is cut by it
  /// properly: a thin lens or a thin bridge of matrix would make slivers, m.
  double clearance = 0;
};

/// A regular array fills the block with columns × rows inclusions.
struct Array {
  Arrangement arrangement = Arrangement::random;
  int columns = 0, rows = 0;
  double repair = 0;  ///< an inclusion may be moved by less than this to keep the clearance, m
};

/// Layers of matrix and inclusion in turn.
struct Laminate {
  double fraction = 0;  ///< of the inclusion
  double period = 0;    ///< thickness of one layer of each, m
  double angle = 0;     ///< of the layers from x, radian
};

/// A picture whose grey levels are regions: level[k-1] <= grey < level[k] is region k.
struct GreyImage {
  std::string file;
  std::vector<double> levels;        ///< ascending, 0 to 1
  std::vector<std::string> regions;  ///< one more than levels, from dark to bright
  double pixel = 0;                  ///< side of a pixel, m
  int median = 0;                    ///< half-width of the median filter's square, pixels; 0 is none
  long despeckle = 0;                ///< pixels of the smallest island that stays
};

/// Edge lengths of the mesh: the smallest of `bulk`, and those at interfaces and at the contact surface
/// growing with the distance from them.
struct MeshSize {
  double bulk = 0, interface = 0, surface = 0;  ///< m
  double growth = 0;                            ///< per metre of distance
};

/// `grid` is squares fitted to the interfaces.
enum class CellShape { triangle, quadrilateral, grid };

struct MeshChoice {
  MeshSize size;
  CellShape cell = CellShape::triangle;
  bool structured = false;
  double worst_angle = 0;  ///< every angle of a cell lies between this and π minus this, radian
};

/// What is drawn.
enum class Composite { homogeneous, random, array, laminate, image };

/// A composite and its mesh, as the user described them.
struct Recipe {
  Composite composite = Composite::homogeneous;
  Room room;
  std::vector<Family> families;
  Array array;
  Laminate laminate;
  GreyImage image;
  MeshChoice mesh;
  double repair = 0;       ///< inclusions may be moved by less than this to mend bad cells, m
  std::uint64_t seed = 0;  ///< of random placement
  std::optional<double> microstructure_height;  ///< above it the block is one homogeneous region, m
};

Schema recipe_schema();

/// Reads and checks the recipe; lets `options` know the names of the families. Throws UserError.
Recipe read_recipe(Options& options);

}  // namespace slipscale
