// Options without effect, each with the reason.
#include "recipe_checks.hpp"

namespace slipscale::morphology {
namespace {

using Names = std::vector<std::string>;

const Names of_inclusions{"diameter", "diameter_deviation", "diameter_distribution",
                          "aspect",   "rounding",           "angle_deviation"},
    of_placement{"arrangement", "columns", "rows",     "seed",   "gap",
                 "clearance",   "edge",    "keep_out", "repair", "microstructure_height"},
    of_laminate{"layer_period"},
    of_image{"image_file", "image_levels", "image_regions", "image_pixel", "image_median", "image_despeckle"},
    of_inclusions_and_layers{"fraction", "angle"}, of_interfaces{"size_interface"},
    of_free_mesh{"size_surface", "size_growth", "worst_angle"}, of_block{"block_width", "block_height"},
    of_size{"size", "cell"}, of_rows{"structured"};

void refuse(const Options& options, const std::vector<Names>& groups, const Idle& idle) {
  for (const Names& names : groups) options.refuse_idle(names, idle);
}

/// The options that say what is drawn: a shape, or families.
Names saying_what(const std::set<std::string>& families) {
  Names names{"shape"};
  for (const std::string& family : families)
    for (const char* key : {"_shape", "_fraction"}) names.push_back("families_" + family + key);
  return names;
}

void refuse_idle_with_image(const Options& options) {
  refuse(options, {of_block},
         {"with -shape image, whose pixels make the block", "give -image_pixel", {"shape"}});
  if (fits_image(options)) return refuse_idle_with_grid(options);
  refuse(options, {of_size, of_free_mesh, of_rows},
         {"with -shape image, whose pixels are the cells",
          "give -cell grid, which is fitted to their contours, or another -shape",
          {"shape", "cell"}});
}

/// With a picture, a laminate or a homogeneous block.
void refuse_idle_with_shape(const Options& options, Composite composite) {
  const std::string shape = options.text("shape");
  const Idle idle{"with -shape " + shape, "give another -shape", {"shape"}};
  refuse(options, {of_inclusions, of_placement}, idle);
  if (composite != Composite::laminate) refuse(options, {of_laminate, of_inclusions_and_layers}, idle);
  if (composite != Composite::image) refuse(options, {of_image}, idle);
  if (composite != Composite::laminate) refuse(options, {of_interfaces}, idle);
  if (composite == Composite::image) refuse_idle_with_image(options);
  // Beside -cell grid, -structured is itself without effect: asking for it would put it into the results.
  if (composite == Composite::homogeneous && options.text("cell") != "grid" && options.flag("structured"))
    refuse(options, {of_free_mesh},
           {"with -structured, whose cells are all equal", "leave out -structured", {"structured"}});
}

}  // namespace

bool fits_image(const Options& options) { return options.given("cell") && options.text("cell") == "grid"; }

void refuse_idle_with(const Options& options, Composite composite, const std::set<std::string>& families) {
  if (composite != Composite::homogeneous && composite != Composite::image)
    refuse(options, {of_rows},
           {"with interfaces inside the block", "give -shape none", saying_what(families)});
  if (composite != Composite::random && composite != Composite::array)
    return refuse_idle_with_shape(options, composite);
  for (const std::string& name : families)
    refuse(options, {of_inclusions, of_inclusions_and_layers},
           {"beside families, each of which has its own",
            "give it as -families_" + name + "_<key>",
            {"families_" + name + "_shape", "families_" + name + "_fraction"}});
  refuse(options, {of_laminate, of_image},
         {"with inclusions", "give -shape laminate or -shape image", saying_what(families)});
  if (composite == Composite::random)
    options.refuse_idle({"columns", "rows"},
                        {"with -arrangement random", "give -arrangement square", {"arrangement"}});
  else
    options.refuse_idle(
        {"seed"},
        {"with -arrangement " + options.text("arrangement"), "give -arrangement random", {"arrangement"}});
  if (options.text("periodic") == "xy")
    options.refuse_idle({"edge", "keep_out", "microstructure_height"},
                        {"with -periodic xy, which leaves no side", "give -periodic x", {"periodic"}});
}

void refuse_idle_with_grid(const Options& options) {
  options.refuse_idle({"size_interface", "size_surface", "size_growth", "structured"},
                      {"with -cell grid, whose squares are equal", "give -cell triangle", {"cell"}});
}

void refuse_idle_inclusion(const Options& options, const std::string& prefix, Shape shape, bool in_array) {
  const auto idle = [&](const Names& names, const Idle& why) {
    Names full;
    for (const std::string& name : names) full.push_back(prefix + name);
    options.refuse_idle(full, why);
  };
  const std::string given = "-" + prefix + "shape";
  if (shape == Shape::disc)
    idle({"aspect", "rounding", "angle", "angle_deviation"},
         {"with " + given + " disc", "give " + given + " ellipse or rectangle", {prefix + "shape"}});
  if (shape == Shape::ellipse)
    idle({"rounding"}, {"with " + given + " ellipse", "give " + given + " rectangle", {prefix + "shape"}});
  if (in_array) {
    options.refuse_both("fraction", "diameter");
    idle({"diameter_deviation", "diameter_distribution", "angle_deviation"},
         {"in an array, whose inclusions are all equal", "give -arrangement random", {"arrangement"}});
    return;
  }
  if (options.real(prefix + "diameter_deviation") == 0)
    idle({"diameter_distribution"},
         {"with equal diameters", "give -" + prefix + "diameter_deviation", {prefix + "diameter_deviation"}});
  if (shape != Shape::disc && options.text(prefix + "angle_deviation") == "any")
    idle({"angle"}, {"with -" + prefix + "angle_deviation any",
                     "give degrees instead of any",
                     {prefix + "angle_deviation"}});
}

}  // namespace slipscale::morphology
