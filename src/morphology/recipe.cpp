#include "slipscale/morphology/recipe.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "recipe_checks.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr double degree = std::numbers::pi / 180;

template <class Value>
Value chosen(const std::string& word, const std::map<std::string, Value>& values) {
  return values.at(word);
}

/// The given length, or `otherwise` for `auto`.
double length_or(const Options& options, const std::string& name, double otherwise) {
  const std::string text = options.text(name);
  return text == "auto" ? otherwise : std::strtod(text.c_str(), nullptr);
}

/// Reads one kind of inclusion from the options that begin with `prefix`. An array has one size and one
/// angle, and takes either the fraction or the diameter.
Family read_family(const Options& options, const std::string& prefix, const std::string& region,
                   bool in_array) {
  Family family;
  family.region = region;
  family.shape =
      chosen<Shape>(options.text(prefix + "shape"),
                    {{"disc", Shape::disc}, {"ellipse", Shape::ellipse}, {"rectangle", Shape::rectangle}});
  morphology::refuse_idle_inclusion(options, prefix, family.shape, in_array);
  if (!in_array || options.given(prefix + "fraction")) family.fraction = options.real(prefix + "fraction");
  if (!in_array || !options.given(prefix + "fraction")) family.diameter = options.real(prefix + "diameter");
  if (family.shape != Shape::disc) {
    family.aspect = options.real(prefix + "aspect");
    if (in_array || options.text(prefix + "angle_deviation") != "any")
      family.angle = options.real(prefix + "angle") * degree;
  }
  if (family.shape == Shape::rectangle) family.rounding = options.real(prefix + "rounding");
  if (in_array) return family;
  family.diameter_deviation = options.real(prefix + "diameter_deviation");
  if (family.diameter_deviation > 0)
    family.distribution = chosen<SizeDistribution>(options.text(prefix + "diameter_distribution"),
                                                   {{"normal", SizeDistribution::normal},
                                                    {"lognormal", SizeDistribution::lognormal},
                                                    {"uniform", SizeDistribution::uniform}});
  if (family.shape == Shape::disc) return family;
  const std::string deviation = options.text(prefix + "angle_deviation");
  family.angle_deviation = deviation == "any" ? std::numeric_limits<double>::infinity()
                                              : std::strtod(deviation.c_str(), nullptr) * degree;
  return family;
}

void read_families(const Options& options, const std::set<std::string>& names, Recipe& recipe) {
  const bool in_array = recipe.composite == Composite::array;
  if (names.empty()) recipe.families = {read_family(options, "", "inclusion", in_array)};
  if (in_array && !names.empty())
    throw UserError("-arrangement " + options.text("arrangement") + " places one kind of inclusion, but " +
                    "families are given; remove them, or place them with -arrangement random");
  for (const std::string& name : names)
    recipe.families.push_back(read_family(options, "families_" + name + "_", name, false));
}

MeshSize read_size(const Options& options, bool has_interface) {
  MeshSize size;
  size.bulk = options.real("size");
  size.interface = has_interface ? length_or(options, "size_interface", size.bulk) : size.bulk;
  size.surface = length_or(options, "size_surface", size.bulk);
  std::vector<std::string> causes{"size", "size_interface", "size_surface"};
  if (!has_interface) causes.emplace_back("shape");  // has set -size_interface aside
  if (size.interface < size.bulk || size.surface < size.bulk)
    size.growth = options.real("size_growth");
  else
    options.refuse_idle({"size_growth"}, {"with edges of one length",
                                          "give a smaller -size_interface or -size_surface", causes});
  return size;
}

void read_mesh_choice(const Options& options, Recipe& recipe) {
  MeshChoice& mesh = recipe.mesh;
  const bool homogeneous = recipe.composite == Composite::homogeneous;
  if (options.text("cell") == "grid")
    morphology::refuse_idle_with_grid(options);
  else if (homogeneous)
    mesh.structured = options.flag("structured");
  mesh.cell = chosen<CellShape>(options.text("cell"), {{"triangle", CellShape::triangle},
                                                       {"quadrilateral", CellShape::quadrilateral},
                                                       {"grid", CellShape::grid}});
  if (mesh.structured || mesh.cell == CellShape::grid)
    mesh.size.bulk = mesh.size.interface = mesh.size.surface = options.real("size");
  else
    mesh.size = read_size(options, !homogeneous);
  if (!mesh.structured) mesh.worst_angle = options.real("worst_angle") * degree;
}

/// Where a side cuts a disc by less than this part of its radius, the two meet at less than 20 degrees, and
/// no mesh has a better angle there.
constexpr double shallow = 0.06;

/// In an array, half of the gap to the next inclusion lies before a side.
double usual_clearance(const Recipe& recipe) {
  const double length = recipe.mesh.size.interface;
  if (recipe.composite == Composite::array) return 0.5 * length;
  double widest = 0;
  for (const Family& family : recipe.families) widest = std::max(widest, family.diameter / family.aspect);
  return std::max(length, 0.5 * shallow * widest);
}

void read_microstructure_height(const Options& options, Recipe& recipe) {
  const std::string text = options.text("microstructure_height");
  if (text == "none") return;
  const double height = std::strtod(text.c_str(), nullptr), block = recipe.room.block.height(),
               size = recipe.mesh.size.bulk;
  const std::string fault =
      format("-microstructure_height {:g} leaves less than a cell ({:g} m) ", height, size);
  if (height < size) throw UserError(fault + "below it; give more, or a smaller -size");
  if (height > block - size)
    throw UserError(fault + format("above it in a block of {:g} m; give at most {:.3g}, or leave it out",
                                   block, block - size));
  recipe.microstructure_height = height;
}

void read_room(const Options& options, Recipe& recipe) {
  Room& room = recipe.room;
  const MeshSize& size = recipe.mesh.size;
  room.gap = length_or(options, "gap", size.interface);
  room.clearance = length_or(options, "clearance", usual_clearance(recipe));
  if (!room.periodic[0] || !room.periodic[1])
    room.edge = chosen<Edge>(options.text("edge"), {{"cut", Edge::cut}, {"inside", Edge::inside}});
  if (!room.periodic[1]) {
    room.keep_out = options.real("keep_out");
    read_microstructure_height(options, recipe);
  }
  recipe.repair = length_or(options, "repair", size.interface);
}

void read_laminate(const Options& options, Recipe& recipe) {
  recipe.laminate = {options.real("fraction"), options.real("layer_period"), options.real("angle") * degree};
}

void read_image(const Options& options, Recipe& recipe) {
  GreyImage& image = recipe.image;
  image = {options.text("image_file"),
           options.reals("image_levels"),
           {},
           options.real("image_pixel"),
           static_cast<int>(options.integer("image_median")),
           options.integer("image_despeckle")};
  for (std::size_t k = 1; k < image.levels.size(); ++k)
    if (image.levels[k] <= image.levels[k - 1])
      throw UserError("-image_levels must ascend, but " + format("{:g}", image.levels[k]) + " follows " +
                      format("{:g}", image.levels[k - 1]) + "; sort them");
  std::istringstream names(options.find_text("image_regions").value_or("matrix,inclusion"));
  for (std::string name; std::getline(names, name, ',');) image.regions.push_back(name);
  if (image.regions.size() != image.levels.size() + 1)
    throw UserError(
        format("-image_regions names {} regions, but {} grey levels part {}; give one name for each",
               image.regions.size(), image.levels.size(), image.levels.size() + 1));
  std::set<std::string> taken;
  for (const std::string& name : image.regions)
    morphology::refuse_region_name(name, "the region of -image_regions", taken);
}

/// Pixels, or squares of two pixels fitted to the contour between two regions.
void read_image_mesh(const Options& options, Recipe& recipe) {
  if (!morphology::fits_image(options)) return;
  const GreyImage& image = recipe.image;
  if (image.levels.size() != 1)
    throw UserError(
        format("-image_levels gives {} levels, and -cell grid fits its squares to the contour of "
               "one; give one, or leave out -cell grid",
               image.levels.size()));
  recipe.mesh.cell = CellShape::grid;
  constexpr double usual = 2;  // in pixels
  const double size = options.given("size") ? options.real("size") : usual * image.pixel;
  recipe.mesh.size.bulk = recipe.mesh.size.interface = recipe.mesh.size.surface = size;
  recipe.mesh.worst_angle = options.real("worst_angle") * degree;
}

Composite composite_of(const Options& options, bool has_families, Arrangement& arrangement) {
  const std::string shape = has_families ? "families" : options.text("shape");
  if (shape == "none") return Composite::homogeneous;
  if (shape == "laminate") return Composite::laminate;
  if (shape == "image") return Composite::image;
  arrangement = chosen<Arrangement>(options.text("arrangement"), {{"random", Arrangement::random},
                                                                  {"square", Arrangement::square},
                                                                  {"hexagonal", Arrangement::hexagonal}});
  return arrangement == Arrangement::random ? Composite::random : Composite::array;
}

void read_inclusions(const Options& options, const std::set<std::string>& families, Recipe& recipe) {
  if (recipe.composite == Composite::array) {
    recipe.array.columns = static_cast<int>(options.integer("columns"));
    recipe.array.rows = static_cast<int>(options.integer("rows"));
  } else {
    recipe.seed = static_cast<std::uint64_t>(options.integer("seed"));
  }
  read_families(options, families, recipe);
  read_room(options, recipe);
  recipe.array.repair = recipe.repair;
}

}  // namespace

Recipe read_recipe(Options& options) {
  Recipe recipe;
  const std::set<std::string> families = morphology::read_family_names(options);
  recipe.composite = composite_of(options, !families.empty(), recipe.array.arrangement);
  morphology::refuse_idle_with(options, recipe.composite, families);
  const std::string periodic = options.text("periodic");
  recipe.room.periodic = {periodic != "none", periodic == "xy"};
  if (recipe.composite == Composite::image) {
    read_image(options, recipe);
    read_image_mesh(options, recipe);
    return recipe;
  }
  recipe.room.block.upper = {options.real("block_width"), options.real("block_height")};
  read_mesh_choice(options, recipe);
  if (recipe.composite == Composite::laminate) read_laminate(options, recipe);
  if (recipe.composite == Composite::random || recipe.composite == Composite::array)
    read_inclusions(options, families, recipe);
  morphology::refuse_coarse(options, recipe);
  return recipe;
}

}  // namespace slipscale
