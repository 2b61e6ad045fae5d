#include "slipscale/files/xdmf.hpp"

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/files/output_folder.hpp"

namespace slipscale {
namespace {

using Topology = MeshImage::Topology;

/// Writes one grid; lines begin with `indent`.
class Grid {
 public:
  Grid(const XdmfDocument& document, std::string indent) : document_(document), indent_(std::move(indent)) {}

  /// `frame` is the path of the frame's group, `time` the line that tells its time.
  std::string text(const std::string& frame, const std::string& time) const {
    std::string lines = indent_ + "<Grid Name=\"" + document_.grid + "\" GridType=\"Uniform\">\n" + time;
    lines += topology() + geometry();
    for (const XdmfAttribute& attribute : document_.attributes) lines += field(attribute, frame);
    return lines + indent_ + "</Grid>\n";
  }

 private:
  std::string topology() const {
    const MeshLayout& mesh = document_.mesh;
    const long long cells = mesh.cells;
    const char* name = mesh.topology == Topology::triangles        ? "Triangle"
                       : mesh.topology == Topology::quadrilaterals ? "Quadrilateral"
                                                                   : "Mixed";
    const std::string dimensions = mesh.topology == Topology::mixed
                                       ? std::to_string(mesh.stream_length)
                                       : format("{} {}", cells, mesh.topology == Topology::triangles ? 3 : 4);
    return indent_ + format("  <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">", name, cells) +
           item(dimensions, XdmfAttribute::Number::index, "/mesh/cells") + "</Topology>\n";
  }

  std::string geometry() const {
    return indent_ + "  <Geometry GeometryType=\"XY\">" +
           item(std::to_string(document_.mesh.points) + " 2", XdmfAttribute::Number::real,
                "/mesh/coordinates") +
           "</Geometry>\n";
  }

  std::string field(const XdmfAttribute& attribute, const std::string& frame) const {
    const bool nodal = attribute.centre == XdmfAttribute::Centre::node;
    const char* types[] = {"Scalar", "Vector", "Tensor"};
    std::string dimensions = std::to_string(nodal ? document_.mesh.points : document_.mesh.cells);
    for (const hsize_t n : attribute.row) dimensions += " " + std::to_string(n);
    return indent_ +
           format("  <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">", attribute.name,
                  types[attribute.row.size()], nodal ? "Node" : "Cell") +
           item(dimensions, attribute.number,
                attribute.path.starts_with('/') ? attribute.path : frame + attribute.path) +
           "</Attribute>\n";
  }

  std::string item(const std::string& dimensions, XdmfAttribute::Number number,
                   const std::string& path) const {
    const bool real = number == XdmfAttribute::Number::real;
    return format(
        "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:{}</DataItem>",
        dimensions, real ? "Float" : "Int", real ? sizeof(double) : sizeof(PetscInt), document_.data_file,
        path);
  }

  const XdmfDocument& document_;
  const std::string indent_;
};

std::string frames(const XdmfDocument& document) {
  const Grid grid(document, "      ");
  std::string text = "    <Grid Name=\"slipscale\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t frame = 0; frame < document.times->size(); ++frame)
    text +=
        grid.text(frame_path(frame), format("        <Time Value=\"{:.17g}\"/>\n", (*document.times)[frame]));
  return text + "    </Grid>\n";
}

}  // namespace

std::vector<XdmfAttribute> write_components(SharedFile& file, const MeshLayout& mesh,
                                            const DatasetDescription& about, const std::vector<hsize_t>& row,
                                            const std::vector<std::string>& components,
                                            const std::string& name) {
  std::vector<XdmfAttribute> shown;
  for (std::size_t k = 0; k < components.size(); ++k) {
    const std::string end = "_" + components[k];
    file.write_view({about.path + end, about.units, components[k] + " of " + about.text},
                    {{static_cast<hsize_t>(mesh.cells)}, {{0, about.path, row, k}}});
    shown.push_back({.name = name + end, .path = about.path + end, .row = {}});
  }
  return shown;
}

XdmfAttribute xdmf_region() {
  return {"region", XdmfAttribute::Centre::cell, "/mesh/region", {}, XdmfAttribute::Number::index};
}

std::string frame_path(std::size_t frame) { return format("/frames/{:05}/", frame); }

std::string xdmf_text(const XdmfDocument& document) {
  return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n" +
         (document.times ? frames(document) : Grid(document, "    ").text("", "")) + "  </Domain>\n</Xdmf>\n";
}

void write_xdmf(MPI_Comm comm, const std::string& path, const XdmfDocument& document) {
  stop_together(comm, is_root(comm) ? try_replace_text_file(path, xdmf_text(document)) : "");
}

}  // namespace slipscale
