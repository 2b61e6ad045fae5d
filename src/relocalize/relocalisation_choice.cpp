#include "slipscale/relocalize/relocalisation_choice.hpp"

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

std::vector<Vector2> read_points(const Options& options) {
  const auto numbers = options.reals("relocalize_points");
  if (numbers.size() % 2 != 0)
    throw UserError("-relocalize_points has an odd count of numbers; give x1,y1,x2,y2,... in m");
  std::vector<Vector2> points;
  for (std::size_t k = 0; k < numbers.size(); k += 2) points.push_back({numbers[k], numbers[k + 1]});
  return points;
}

std::optional<Vector2> read_origin(const Options& options) {
  const auto numbers = options.reals("relocalize_origin");
  if (numbers.empty()) return std::nullopt;
  if (numbers.size() != 2)
    throw UserError(format("-relocalize_origin has {} numbers; give x,y in m", numbers.size()));
  return Vector2{numbers[0], numbers[1]};
}

std::optional<StressComparison::Choice> read_reference(const Options& options) {
  const auto folder = options.find_text("relocalize_reference");
  if (!folder) {
    options.refuse_idle({"relocalize_layer", "relocalize_bulk"},
                        {"without -relocalize_reference", "give the folder of the heterogeneous run"});
    return std::nullopt;
  }
  return StressComparison::Choice{*folder, options.real("relocalize_layer"), options.real("relocalize_bulk")};
}

std::optional<double> read_strip(const Options& options) {
  if (options.text("relocalize_correction") == "strip") return options.real("relocalize_strip");
  options.refuse_idle(
      {"relocalize_strip"},
      {"with -relocalize_correction none", "give -relocalize_correction strip", {"relocalize_correction"}});
  return std::nullopt;
}

}  // namespace

Schema relocalisation_schema() {
  return interface_schema() +
         Schema{{"relocalize_run", Kind::text, "", required, range::any,
                 "folder of the homogeneous run of slide; its frames hold the strain (-fields_quantities "
                 "strain)"},
                {"relocalize_tensors", Kind::text, "", required, range::any,
                 "localization.h5 of homogenize, or its folder: of the whole block, or of a periodic cell "
                 "that tiles "
                 "it"},
                {"relocalize_reference", Kind::text, "", absent, range::any,
                 "folder of the heterogeneous run of slide to compare with, at the cells of its mesh"},
                {"relocalize_origin", Kind::reals, "m", absent, range::any,
                 "x,y of the lower left corner of one periodic cell; as drawn when absent"},
                {"relocalize_recovery", Kind::text, "", "nodal", range::one_of({"element", "nodal"}),
                 "strain of the homogeneous run between its cell centres: that of the cell, or continuous by "
                 "patch "
                 "recovery"},
                {"relocalize_points", Kind::reals, "m", absent, range::any,
                 "x1,y1,x2,y2,...: points whose cells' stress is kept over time"},
                {"relocalize_correction", Kind::text, "", "none", range::one_of({"none", "strip"}),
                 "next to the contact: none, or equilibrium restored in a strip above it"},
                {"relocalize_strip", Kind::real, "m", required, range::positive,
                 "depth of that strip: a few diameters of the inclusions"},
                {"relocalize_layer", Kind::real, "m", required, range::positive,
                 "depth of the layer next to the contact whose error is told apart"},
                {"relocalize_bulk", Kind::real, "m", required, range::non_negative,
                 "distance from the edges beyond which the error of the bulk is told apart"},
                {"output_folder", Kind::text, "", required, range::any,
                 "gets relocalized.h5 and .xdmf, relocalized_statistics.h5 and .xdmf, comparison.yaml, "
                 "interfaces.h5, .xdmf and "
                 ".yaml"},
                {"progress", Kind::text, "", "auto", range::one_of({"auto", "none"}),
                 "progress line on a terminal"},
                {"run_<entry>", Kind::text, "", absent, range::any,
                 "what a file tells about a run; read by nobody"}};
}

RelocalisationChoice read_relocalisation(const Options& options) {
  RelocalisationChoice choice;
  choice.run = options.text("relocalize_run");
  choice.tensors = options.text("relocalize_tensors");
  choice.reference = read_reference(options);
  choice.origin = read_origin(options);
  choice.recovery = options.text("relocalize_recovery") == "element" ? Recovery::element : Recovery::nodal;
  choice.points = read_points(options);
  choice.interfaces = read_interfaces(options);
  choice.strip = read_strip(options);
  choice.folder = options.text("output_folder");
  choice.progress = options.text("progress");
  return choice;
}

}  // namespace slipscale
