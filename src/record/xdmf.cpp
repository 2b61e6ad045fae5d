#include "xdmf.hpp"

#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

using Topology = MeshImage::Topology;

std::string item(const XdmfLayout& layout, const std::string& dimensions, const char* type, std::size_t bytes,
                 const std::string& path) {
  return format(
      "<DataItem Dimensions=\"%s\" NumberType=\"%s\" Precision=\"%zu\" Format=\"HDF\">%s:%s</DataItem>",
      dimensions.c_str(), type, bytes, layout.data_file.c_str(), path.c_str());
}

std::string topology(const XdmfLayout& layout) {
  const long long cells = layout.cells;
  const char* name = layout.topology == Topology::triangles        ? "Triangle"
                     : layout.topology == Topology::quadrilaterals ? "Quadrilateral"
                                                                   : "Mixed";
  const std::string dimensions =
      layout.topology == Topology::mixed
          ? std::to_string(layout.stream_length)
          : format("%lld %d", cells, layout.topology == Topology::triangles ? 3 : 4);
  return format("        <Topology TopologyType=\"%s\" NumberOfElements=\"%lld\">", name, cells) +
         item(layout, dimensions, "Int", sizeof(PetscInt), "/mesh/cells") + "</Topology>\n";
}

std::string attribute(const char* name, const char* center, const char* type, const std::string& data) {
  return format("        <Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"%s\">%s</Attribute>\n", name,
                type, center, data.c_str());
}

std::string grid(const XdmfLayout& layout, std::size_t frame, double time) {
  const std::string path = format("/frames/%05zu/", frame);
  const std::string points = std::to_string(layout.points), cells = std::to_string(layout.cells);
  const auto real = [&](const std::string& dimensions, const std::string& at) {
    return item(layout, dimensions, "Float", 8, at);
  };
  std::string text = "      <Grid Name=\"block\" GridType=\"Uniform\">\n";
  text += format("        <Time Value=\"%.17g\"/>\n", time);
  text += topology(layout);
  text +=
      "        <Geometry GeometryType=\"XY\">" + real(points + " 2", "/mesh/coordinates") + "</Geometry>\n";
  if (layout.quantities.u) text += attribute("u", "Node", "Vector", real(points + " 3", path + "u"));
  if (layout.quantities.v) text += attribute("v", "Node", "Vector", real(points + " 3", path + "v"));
  if (layout.quantities.stress)
    text += attribute("stress", "Cell", "Vector", real(cells + " 3", path + "stress"));
  text += attribute("region", "Cell", "Scalar", item(layout, cells, "Int", sizeof(PetscInt), "/mesh/region"));
  return text + "      </Grid>\n";
}

}  // namespace

std::string xdmf_text(const XdmfLayout& layout, const std::vector<double>& times) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"slipscale\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t frame = 0; frame < times.size(); ++frame) text += grid(layout, frame, times[frame]);
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace slipscale
