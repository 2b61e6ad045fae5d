#include "slipscale/record/fields_file.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "slipscale/base/error.hpp"
#include "slipscale/files/xdmf.hpp"

namespace slipscale {
namespace {

std::vector<XdmfAttribute> attributes(const FieldQuantities& quantities) {
  using enum XdmfAttribute::Centre;
  std::vector<XdmfAttribute> shown;
  if (quantities.u) shown.push_back({"u", node, "u", {3}});
  if (quantities.v) shown.push_back({"v", node, "v", {3}});
  if (quantities.stress) shown.push_back({"stress", cell, "stress", {3}});
  if (quantities.strain) shown.push_back({"strain", cell, "strain", {3}});
  shown.push_back(xdmf_region());
  return shown;
}

}  // namespace

FieldQuantities field_quantities(const std::string& list, const std::string& option) {
  FieldQuantities quantities{false, false, false, false};
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "u")
      quantities.u = true;
    else if (word == "v")
      quantities.v = true;
    else if (word == "stress")
      quantities.stress = true;
    else if (word == "strain")
      quantities.strain = true;
    else
      throw UserError("-" + option + " has '" + word +
                      "'; give a list of u, v, stress and strain, like u,stress");
  }
  return quantities;
}

FieldsFile::FieldsFile(MPI_Comm comm, const Mesh& mesh, const std::string& folder, FieldQuantities quantities)
    : FieldsFile(comm, MeshImage(comm, mesh), folder, quantities) {}

FieldsFile::FieldsFile(MPI_Comm comm, MeshImage image, const std::string& folder, FieldQuantities quantities,
                       const std::string& name)
    : comm_(comm),
      quantities_(quantities),
      image_(std::move(image)),
      file_(std::make_unique<SharedFile>(comm, folder + "/" + name + ".h5", bytes(0),
                                         SharedFile::Appearance::growing)),
      xdmf_path_(folder + "/" + name + ".xdmf") {
  const MeshLayout layout = write_mesh(comm, *file_, image_);
  file_->add_series({"/time", "s", "times of the frames"});
  file_->flush();
  xdmf_ = std::make_unique<XdmfDocument>(
      XdmfDocument{name + ".h5", "block", layout, attributes(quantities), std::vector<double>{}});
}

FieldsFile::~FieldsFile() = default;

double FieldsFile::bytes(double frames) const {
  return fields_bytes(frames, image_.points().total(), image_.cells().total(), quantities_);
}

void FieldsFile::write(double time, const double* u, const double* v, const double* stress,
                       const double* strain) {
  const std::string frame = frame_path(xdmf_->times->size());
  file_->reserve(bytes(1));
  if (quantities_.u) write_nodal({frame + "u", "m", "displacement of the points; x, y and 0"}, u);
  if (quantities_.v) write_nodal({frame + "v", "m/s", "velocity of the points; x, y and 0"}, v);
  if (quantities_.stress)
    write_on_cells({frame + "stress", "Pa", "stress of the cells; xx, yy and xy"}, stress);
  if (quantities_.strain)
    write_on_cells({frame + "strain", "1", "strain of the cells; xx, yy and xy, engineering shear"}, strain);
  file_->append("/time", time);
  file_->flush();
  xdmf_->times->push_back(time);
  write_xdmf(comm_, xdmf_path_, *xdmf_);
}

/// The third component is for ParaView, whose warping wants vectors in space.
void FieldsFile::write_nodal(const DatasetDescription& about, const double* values) {
  std::vector<double> rows;
  rows.reserve(3 * image_.point_nodes().size());
  for (const int node : image_.point_nodes())
    rows.insert(rows.end(), {values[2 * node], values[2 * node + 1], 0.0});
  file_->write(about, image_.points(), {3}, rows.data());
}

void FieldsFile::write_on_cells(const DatasetDescription& about, const double* values) {
  slipscale::write_on_cells(*file_, image_, about, {3}, [&](int cell, double* row) {
    std::copy_n(values + 3 * static_cast<std::size_t>(cell), 3, row);
  });
}

void FieldsFile::close() { file_->finish(); }

double fields_bytes(double frames, std::int64_t points, std::int64_t cells,
                    const FieldQuantities& quantities) {
  const double vector = 3 * sizeof(double);
  const double frame = (quantities.u + quantities.v) * vector * static_cast<double>(points) +
                       (quantities.stress + quantities.strain) * vector * static_cast<double>(cells) +
                       group_overhead;
  return frames * frame + mesh_bytes(static_cast<double>(points), static_cast<double>(cells)) +
         group_overhead;
}

}  // namespace slipscale
