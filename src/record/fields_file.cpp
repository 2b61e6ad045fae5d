#include "slipscale/record/fields_file.hpp"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "slipscale/base/content_checksum.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/files/continued_file.hpp"
#include "slipscale/files/xdmf.hpp"
#include "slipscale/record/stress_measures.hpp"

namespace slipscale {
namespace {

std::vector<XdmfAttribute> attributes(const FieldQuantities& quantities, bool with_zz) {
  using enum XdmfAttribute::Centre;
  std::vector<XdmfAttribute> shown;
  if (quantities.u) shown.push_back({"u", node, "u", {3}});
  if (quantities.v) shown.push_back({"v", node, "v", {3}});
  if (quantities.stress) shown.push_back({"stress", cell, "stress_tensor", {3, 3}});
  for (const char* component : {"strain_xx", "strain_yy", "strain_xy"})
    if (quantities.strain) shown.push_back({component, cell, component, {}});
  if (quantities.von_mises && with_zz) shown.push_back({"von_mises", cell, "von_mises", {}});
  for (const char* value : {"principal_high", "principal_low"})
    if (quantities.principal) shown.push_back({value, cell, value, {}});
  if (quantities.damping_work) shown.push_back({"damping_work", cell, "damping_work", {}});
  shown.push_back(xdmf_region());
  return shown;
}

/// The frame's path without the '/' at its end.
std::string group_of(std::size_t frame) {
  std::string path = frame_path(frame);
  path.pop_back();
  return path;
}

/// Of a frame, from that of its datasets.
std::uint64_t with_time(std::uint64_t contents, double time) {
  ContentChecksum sum;
  sum.add(&contents, sizeof contents);
  sum.add(&time, sizeof time);
  return sum.value();
}

}  // namespace

FieldQuantities field_quantities(const std::string& list, const std::string& option) {
  FieldQuantities quantities{false, false, false, false};
  const std::pair<const char*, bool FieldQuantities::*> known[] = {
      {"u", &FieldQuantities::u},
      {"v", &FieldQuantities::v},
      {"stress", &FieldQuantities::stress},
      {"strain", &FieldQuantities::strain},
      {"von_mises", &FieldQuantities::von_mises},
      {"principal", &FieldQuantities::principal},
      {"damping_work", &FieldQuantities::damping_work}};
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const auto found = std::find_if(std::begin(known), std::end(known),
                                    [&](const auto& each) { return each.first == word; });
    if (found == std::end(known))
      throw UserError("-" + option + " has '" + word +
                      "'; give a list of u, v, stress, strain, von_mises, principal and damping_work, like "
                      "u,stress");
    quantities.*found->second = true;
  }
  return quantities;
}

FieldsFile::FieldsFile(MPI_Comm comm, const Mesh& mesh, const std::string& folder, FieldQuantities quantities)
    : FieldsFile(comm, MeshImage(comm, mesh), folder, quantities) {}

FieldsFile::FieldsFile(MPI_Comm comm, MeshImage image, const std::string& folder, FieldQuantities quantities,
                       const std::string& name, std::vector<double> transverse,
                       std::optional<std::size_t> frames)
    : comm_(comm),
      quantities_(quantities),
      image_(std::move(image)),
      transverse_(std::move(transverse)),
      file_(std::make_unique<SharedFile>(
          comm, folder + "/" + name + ".h5", bytes(0),
          frames ? SharedFile::Appearance::continued : SharedFile::Appearance::growing)),
      xdmf_path_(folder + "/" + name + ".xdmf"),
      to_cut_(frames.has_value()) {
  const DatasetDescription time{"/time", "s", "times of the frames"};
  const MeshLayout layout = frames ? check_mesh(comm, *file_, image_) : write_mesh(comm, *file_, image_);
  std::vector<double> times;
  if (frames) {
    times = file_->read_series(time, *frames);
    check_frames(*frames);
    file_->examine([&](hid_t file) {
      contents_.push_back(contents_of(file, "/mesh"));
      for (std::size_t frame = 0; frame < *frames; ++frame)
        contents_.push_back(with_time(contents_of(file, group_of(frame)), times[frame]));
    });
  } else {
    contents_.push_back(file_->take_contents());
    file_->add_series(time);
    file_->flush();
  }
  xdmf_ = std::make_unique<XdmfDocument>(XdmfDocument{
      name + ".h5", "block", layout, attributes(quantities, !transverse_.empty()), std::move(times)});
}

FieldsFile::~FieldsFile() = default;

void FieldsFile::about(const std::string& name, const std::string& text) {
  if (to_cut_) return file_->examine([&](hid_t file) { expect_text(file, name, text); });
  file_->describe("/", [&](hid_t root) { write_attribute(root, name, text); });
  file_->flush();
}

/// Refuses a file that lacks frames, or whose frames do not hold what this one would write.
void FieldsFile::check_frames(std::size_t frames) const {
  file_->examine([&](hid_t file) {
    if (frames == 0) return;
    for (std::size_t frame = 0; frame < frames; ++frame)
      if (!has_path(file, group_of(frame))) throw LibraryError("it has no '" + group_of(frame) + "'");
    for (const std::size_t frame : {std::size_t{0}, frames - 1}) check_frame(file, group_of(frame));
  });
}

void FieldsFile::expect(const std::vector<std::uint64_t>& contents) const {
  file_->examine([&](hid_t) {
    for (std::size_t k = 0; k < contents_.size(); ++k)
      if (k >= contents.size() || contents[k] != contents_[k])
        throw LibraryError((k == 0 ? "'/mesh'" : "'" + group_of(k - 1) + "' or its time") +
                           " has other values than the run wrote");
  });
}

void FieldsFile::check_frame(hid_t file, const std::string& group) const {
  const auto points = static_cast<hsize_t>(image_.points().total()),
             cells = static_cast<hsize_t>(image_.cells().total());
  const bool with_zz = !transverse_.empty();
  std::size_t expected = 0;
  const auto expect = [&](bool chosen, const std::string& name, const std::vector<hsize_t>& shape,
                          const std::string& units) {
    if (!chosen) return;
    (void)expect_dataset(file, group + "/" + name, H5T_IEEE_F64LE, shape, units);
    ++expected;
  };
  expect(quantities_.u, "u", {points, 3}, "m");
  expect(quantities_.v, "v", {points, 3}, "m/s");
  expect(quantities_.stress, "stress", {cells, 3}, "Pa");
  expect(quantities_.stress, "stress_tensor", {cells, 3, 3}, "Pa");
  expect(quantities_.stress && with_zz, "stress_zz", {cells}, "Pa");
  expect(quantities_.strain, "strain", {cells, 3}, "1");
  for (const char* part : {"strain_xx", "strain_yy", "strain_xy"})
    expect(quantities_.strain, part, {cells}, "1");
  expect(quantities_.von_mises && with_zz, "von_mises", {cells}, "Pa");
  for (const char* value : {"principal_high", "principal_low"})
    expect(quantities_.principal, value, {cells}, "Pa");
  expect(quantities_.damping_work, "damping_work", {cells}, "J/m^3");
  if (links_of(file, group).size() != expected) throw LibraryError("'" + group + "' holds other quantities");
}

/// Of a continued file, the frames behind those that count.
void FieldsFile::cut_back() {
  if (!to_cut_) return;
  // First, so that it never names a frame that is not there.
  write_xdmf(comm_, xdmf_path_, *xdmf_);
  file_->cut_series("/time", frames());
  file_->change([&](hid_t file) {
    if (!has_path(file, "/frames")) return;
    const auto order = [](const std::string& name) { return std::pair(name.size(), name); };
    for (const std::string& name : links_of(file, "/frames"))
      if (const std::string group = "/frames/" + name; order(group) >= order(group_of(frames())))
        hdf5(H5Ldelete(file, group.c_str(), H5P_DEFAULT), group);
  });
  file_->end_changes();
  to_cut_ = false;
}

std::size_t FieldsFile::frames() const { return xdmf_->times->size(); }

double FieldsFile::bytes(double frames) const {
  return fields_bytes(frames, image_.points().total(), image_.cells().total(), quantities_);
}

void FieldsFile::write(double time, const double* u, const double* v, const double* stress,
                       const double* strain, const double* damping_work) {
  cut_back();
  const std::string frame = frame_path(frames());
  file_->reserve(bytes(1));
  if (quantities_.u) write_nodal({frame + "u", "m", "displacement of the points; x, y and 0"}, u);
  if (quantities_.v) write_nodal({frame + "v", "m/s", "velocity of the points; x, y and 0"}, v);
  if (quantities_.of_stress()) write_stress(frame, stress);
  if (quantities_.strain) write_strain(frame, strain);
  if (quantities_.damping_work)
    slipscale::write_on_cells(*file_, image_,
                              {frame + "damping_work", "J/m^3", "energy that bulk damping took since t = 0"},
                              {}, [&](int cell, double* row) { *row = damping_work[cell]; });
  file_->append("/time", time);
  file_->flush();
  contents_.push_back(with_time(file_->take_contents(), time));
  xdmf_->times->push_back(time);
  write_xdmf(comm_, xdmf_path_, *xdmf_);
}

void FieldsFile::write_stress(const std::string& frame, const double* stress) {
  const auto rows = static_cast<hsize_t>(image_.cells().total());
  const auto at = [&](int cell) { return stress + 3 * static_cast<std::size_t>(cell); };
  const auto zz = [&](int cell) { return transverse_[cell] * (at(cell)[0] + at(cell)[1]); };
  const auto write = [&](const std::string& name, const std::string& text, const auto& value) {
    slipscale::write_on_cells(*file_, image_, {frame + name, "Pa", text}, {},
                              [&](int cell, double* row) { *row = value(cell); });
  };
  const bool with_zz = !transverse_.empty();
  if (quantities_.stress) {
    write_on_cells({frame + "stress", "Pa", "stress of the cells; xx, yy and xy"}, stress);
    DatasetView view{{rows, 3, 3}, {}};
    for (const auto& [to, component] : {std::pair<std::size_t, std::size_t>{0, 0}, {1, 2}, {3, 2}, {4, 1}})
      view.entries.push_back({to, frame + "stress", {3}, component});
    if (with_zz) {
      write(
          "stress_zz",
          "stress across the plane, nu (xx + yy); NaN where a stiffness that is not isotropic does not tell",
          zz);
      view.entries.push_back({8, frame + "stress_zz", {}, 0});
    }
    file_->write_view({frame + "stress_tensor", "Pa", "the same as a tensor, zz included"}, view);
  }
  if (quantities_.von_mises && with_zz)
    write("von_mises", "von Mises' equivalent stress of the cells",
          [&](int cell) { return von_mises(at(cell), zz(cell)); });
  if (!quantities_.principal) return;
  write("principal_high", "larger principal stress in the plane",
        [&](int cell) { return principal_stresses(at(cell))[0]; });
  write("principal_low", "smaller principal stress in the plane",
        [&](int cell) { return principal_stresses(at(cell))[1]; });
}

void FieldsFile::write_strain(const std::string& frame, const double* strain) {
  write_on_cells({frame + "strain", "1", "strain of the cells; xx, yy and xy, engineering shear"}, strain);
  (void)write_components(*file_, xdmf_->mesh, {frame + "strain", "1", "the strain, engineering shear"}, {3},
                         {"xx", "yy", "xy"}, "strain");
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

void FieldsFile::close() {
  cut_back();
  file_->finish();
}

double fields_bytes(double frames, std::int64_t points, std::int64_t cells,
                    const FieldQuantities& quantities) {
  const double vector = 3 * sizeof(double);
  const double of_cell =
      (quantities.stress + quantities.strain) * vector +
      (quantities.stress + quantities.von_mises + 2 * quantities.principal + quantities.damping_work) *
          sizeof(double);
  const double frame = (quantities.u + quantities.v) * vector * static_cast<double>(points) +
                       of_cell * static_cast<double>(cells) + group_overhead;
  return frames * frame + mesh_bytes(static_cast<double>(points), static_cast<double>(cells)) +
         group_overhead;
}

}  // namespace slipscale
