#include "slipscale/relocalize/relocalisation_report.hpp"

#include <algorithm>

#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

std::string size_of(const PlaneGrid& grid) {
  const Box box = bounding_box(grid);
  return format("{} cells, {} by {}", grid.cells(), engineering(box.extent(0), "m"),
                engineering(box.extent(1), "m"));
}

std::string frames_of(const FieldsReader& run) {
  const auto& times = run.times();
  if (times.empty()) return "no frame";
  if (times.size() == 1) return "one frame, " + engineering(times.front(), "s");
  return format("{} frames, ", times.size()) + engineering(times.front(), "s") + " to " +
         engineering(times.back(), "s");
}

}  // namespace

std::string describe(const FieldsReader& run, const LocalisationTensors& tensors, const Targets& targets,
                     const LocalStress& local) {
  std::string text = "homogeneous run: " + size_of(run.grid()) + "; " + frames_of(run) + "\n";
  text += "tensors (" + tensors.boundary + "): " + size_of(tensors.grid) + "; regions";
  for (const std::string& region : tensors.grid.regions) text += " " + region;
  text += "\nrelocalised on " + size_of(targets.grid) + "\n";
  if (const int other = count_of_other_regions(targets, tensors.grid); other > 0)
    text += format(
        "note: {} of these cells lie in another region than the tensors' cell there; draw both "
        "from one mesh to avoid it\n",
        other);
  if (const auto& layer = local.boundary_layer())
    text += format("corrected next to the contact: a strip of {} cells is solved, its lower half kept\n",
                   layer->cells());
  return text;
}

}  // namespace slipscale
