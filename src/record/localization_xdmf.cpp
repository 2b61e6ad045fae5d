#include "localization_xdmf.hpp"

#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

using Topology = MeshImage::Topology;

class Writer {
 public:
  explicit Writer(const LocalizationLayout& layout) : layout_(layout) {}

  std::string topology() const {
    const long long cells = layout_.cells;
    const char* name = layout_.topology == Topology::triangles        ? "Triangle"
                       : layout_.topology == Topology::quadrilaterals ? "Quadrilateral"
                                                                      : "Mixed";
    const std::string dimensions =
        layout_.topology == Topology::mixed
            ? std::to_string(layout_.stream_length)
            : format("%lld %d", cells, layout_.topology == Topology::triangles ? 3 : 4);
    return format("      <Topology TopologyType=\"%s\" NumberOfElements=\"%lld\">", name, cells) +
           integers(dimensions, "/mesh/cells") + "</Topology>\n";
  }
  std::string geometry() const {
    return "      <Geometry GeometryType=\"XY\">" +
           reals(std::to_string(layout_.points) + " 2", "/mesh/coordinates") + "</Geometry>\n";
  }
  /// Of the cells; `shape` of a row, with a blank before it.
  std::string attribute(const std::string& name, const char* type, const std::string& shape) const {
    return on_cells(name, type, reals(std::to_string(layout_.cells) + shape, "/cell/" + name));
  }
  std::string region() const {
    return on_cells("region", "Scalar", integers(std::to_string(layout_.cells), "/mesh/region"));
  }

 private:
  static std::string on_cells(const std::string& name, const char* type, const std::string& data) {
    return format("      <Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Cell\">", name.c_str(), type) +
           data + "</Attribute>\n";
  }
  std::string item(const std::string& dimensions, const char* type, std::size_t bytes,
                   const std::string& path) const {
    return format(
        "<DataItem Dimensions=\"%s\" NumberType=\"%s\" Precision=\"%zu\" Format=\"HDF\">%s:%s</DataItem>",
        dimensions.c_str(), type, bytes, layout_.data_file.c_str(), path.c_str());
  }
  std::string reals(const std::string& dimensions, const std::string& path) const {
    return item(dimensions, "Float", sizeof(double), path);
  }
  std::string integers(const std::string& dimensions, const std::string& path) const {
    return item(dimensions, "Int", sizeof(PetscInt), path);
  }

  const LocalizationLayout& layout_;
};

}  // namespace

std::string localization_xdmf(const LocalizationLayout& layout) {
  const Writer writer(layout);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"cell\" GridType=\"Uniform\">\n";
  text += writer.topology() + writer.geometry() + writer.region() + writer.attribute("area", "Scalar", "");
  text += writer.attribute("localisation", "Tensor", " 3 3");
  for (const char* name : stress_names) text += writer.attribute(name, "Vector", " 3");
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace slipscale
