#include "slipscale/morphology/recipe.hpp"

namespace slipscale {
namespace {

const Range shapes = range::one_of({"disc", "ellipse", "rectangle"});
const Range below_45{"at least 0 and below 45", [](double x) { return x >= 0 && x < 45; }};
const Range below_one{"above 0 and below 1", [](double x) { return x > 0 && x < 1; }};
const Range count{"from 1 to 2147483647", [](double x) { return x >= 1; }};
const Range natural{"from 0 to 2147483647", [](double x) { return x >= 0; }};
const Range reach{"from 0 to 20", [](double x) { return x >= 0 && x <= 20; }};
const Range grey{"above 0 and at most 1", [](double x) { return x > 0 && x <= 1; }};

Schema block_schema() {
  return {
      {"block_width", Kind::real, "m", required, range::positive, "extent along x; a picture brings its own"},
      {"block_height", Kind::real, "m", required, range::positive,
       "extent along y; a picture brings its own"},
      {"periodic", Kind::text, "", "none", range::one_of({"none", "x", "xy"}),
       "sides with matching nodes, across which inclusions are wrapped"},
  };
}

Schema family_schema() {
  return {
      {"shape", Kind::text, "", required,
       range::one_of({"none", "disc", "ellipse", "rectangle", "laminate", "image"}),
       "what is drawn in the matrix; the rectangles have rounded corners; 'none' is a homogeneous block"},
      {"fraction", Kind::real, "1", required, below_one, "area of the inclusions over that of the block"},
      {"diameter", Kind::real, "m", required, range::positive, "mean length of the long axis"},
      {"diameter_deviation", Kind::real, "1", "0", range::non_negative,
       "standard deviation of the diameter over its mean"},
      {"diameter_distribution", Kind::text, "", "normal", range::one_of({"normal", "lognormal", "uniform"}),
       "how diameters are distributed; 'normal' is cut off at three deviations"},
      {"aspect", Kind::real, "1", required, range::at_least_one,
       "long axis over short axis of ellipses and rectangles"},
      {"rounding", Kind::real, "1", "0.3", range::unit,
       "radius of a rectangle's corners over half its short axis"},
      {"angle", Kind::real, "degree", "0", range::any, "of long axes, or of layers, from x"},
      {"angle_deviation", Kind::text, "degree", "0", range::one_of_or_number({"any"}, range::non_negative),
       "standard deviation of the angle, or 'any' for no preferred direction"},
      {"families_<family>_shape", Kind::text, "", required, shapes,
       "one of several kinds of inclusion; its region is named after it"},
      {"families_<family>_fraction", Kind::real, "1", required, below_one, "as without families"},
      {"families_<family>_diameter", Kind::real, "m", required, range::positive, "as without families"},
      {"families_<family>_diameter_deviation", Kind::real, "1", "0", range::non_negative,
       "as without families"},
      {"families_<family>_diameter_distribution", Kind::text, "", "normal",
       range::one_of({"normal", "lognormal", "uniform"}), "as without families"},
      {"families_<family>_aspect", Kind::real, "1", required, range::at_least_one, "as without families"},
      {"families_<family>_rounding", Kind::real, "1", "0.3", range::unit, "as without families"},
      {"families_<family>_angle", Kind::real, "degree", "0", range::any, "as without families"},
      {"families_<family>_angle_deviation", Kind::text, "degree", "0",
       range::one_of_or_number({"any"}, range::non_negative), "as without families"},
  };
}

Schema placement_schema() {
  return {
      {"arrangement", Kind::text, "", "random", range::one_of({"random", "square", "hexagonal"}),
       "where inclusions lie; an array takes columns, rows, and the fraction or the diameter"},
      {"columns", Kind::integer, "1", required, count, "of an array, along x"},
      {"rows", Kind::integer, "1", required, count, "of an array, along y"},
      {"seed", Kind::integer, "1", "1", natural, "of random placement: another seed, another morphology"},
      {"gap", Kind::text, "m", "auto", range::one_of_or_number({"auto"}, range::non_negative),
       "smallest distance between inclusions; auto: the edge length at interfaces"},
      {"clearance", Kind::text, "m", "auto", range::one_of_or_number({"auto"}, range::non_negative),
       "an outline that comes nearer to a side or corner of the block is cut by it at least as deep; auto: "
       "the "
       "edge length at interfaces, or .06 of half the short axis when that is more; half the edge length in "
       "an "
       "array"},
      {"edge", Kind::text, "", "cut", range::one_of({"cut", "inside"}),
       "inclusions at sides that are not periodic"},
      {"keep_out", Kind::real, "m", "0", range::non_negative,
       "thickness of a layer of matrix at the bottom, the contact surface"},
      {"microstructure_height", Kind::text, "m", "none", range::one_of_or_number({"none"}, range::positive),
       "inclusions only up to about this height above the contact, and above it one homogeneous region "
       "'homogenized'; what the end would cut stays whole where its centre is below, and is left out "
       "otherwise, or always with -edge inside"},
      {"repair", Kind::text, "m", "auto", range::one_of_or_number({"auto"}, range::non_negative),
       "an inclusion is moved by less than this, or else dropped, to mend a bad cell; auto: the edge length "
       "at interfaces"},
      {"layer_period", Kind::real, "m", required, range::positive,
       "thickness of one layer of matrix and one of inclusion, for the shape laminate"},
      {"image_file",
       Kind::text,
       "",
       required,
       {},
       "PNG or PGM whose pixels become quadrilaterals, or, with -cell grid, whose contour at -image_levels "
       "bounds the regions; colours count by their luma .299 R + .587 G + .114 B"},
      {"image_levels", Kind::reals, "1", required, grey,
       "ascending grey levels, 0 black to 1 white, at which the next region begins"},
      {"image_regions",
       Kind::text,
       "",
       absent,
       {},
       "names from dark to bright, with commas; matrix and inclusion when there is one level"},
      {"image_pixel", Kind::real, "m", required, range::positive, "side of a pixel"},
      {"image_median", Kind::integer, "1", "0", reach,
       "each grey level becomes the median of those at most so many pixels away along both axes"},
      {"image_despeckle", Kind::integer, "1", "0", natural,
       "islands of one region with fewer pixels than this go to the region around them"},
  };
}

Schema mesh_choice_schema() {
  return {
      {"size", Kind::real, "m", required, range::positive,
       "edge length of the mesh; two pixels, unless given, of a grid fitted to a picture"},
      {"size_interface", Kind::text, "m", "auto", range::one_of_or_number({"auto"}, range::positive),
       "edge length at interfaces; auto: size"},
      {"size_surface", Kind::text, "m", "auto", range::one_of_or_number({"auto"}, range::positive),
       "edge length at the bottom, the contact surface; auto: size"},
      {"size_growth", Kind::real, "1", "0.2", range::positive,
       "growth of the edge length per metre of distance from interface or surface"},
      {"cell", Kind::text, "", "triangle", range::one_of({"triangle", "quadrilateral", "grid"}),
       "'grid' is rows of squares fitted to the interfaces, those of a picture with one level too, those on "
       "them split in two triangles: the "
       "longest "
       "time step; quadrilaterals come from pairs of triangles, a few of which stay (a fifth of the cells "
       "where the "
       "triangles are more than 200 000)"},
      {"structured", Kind::flag, "", "false", {}, "rows and columns of equal cells; for the shape none"},
      {"worst_angle", Kind::real, "degree", "15", below_45,
       "cells with a smaller angle (or one as near to 180) are mended, or the mesh is refused"},
  };
}

}  // namespace

Schema recipe_schema() {
  return block_schema() + family_schema() + placement_schema() + mesh_choice_schema() +
         Schema{{"output_folder",
                 Kind::text,
                 "",
                 required,
                 {},
                 "gets mesh.msh, morphology.yaml and morphology.png"},
                {"run_<entry>", Kind::text, "", absent, range::any,
                 "what morphology.yaml tells about a mesh; read by nobody"}};
}

}  // namespace slipscale
