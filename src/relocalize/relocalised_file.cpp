#include "slipscale/relocalize/relocalised_file.hpp"

#include "slipscale/base/finite.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/files/mesh_group.hpp"
#include "slipscale/files/xdmf.hpp"
#include "slipscale/relocalize/local_stress.hpp"

namespace slipscale {
namespace {

const std::vector<std::string> components{"xx", "yy", "xy"};
constexpr const char* data_file = "relocalized.h5";

double frame_bytes(const PlaneGrid& grid) {
  constexpr double header = 16000;
  return header + 9 * sizeof(double) * static_cast<double>(grid.cells());
}

}  // namespace

struct RelocalisedFile::File {
  MPI_Comm comm;
  std::string folder;
  double bytes;  ///< of a frame
  SharedFile data;
  MeshImage image;
  MeshLayout layout;
  std::vector<double> times;

  File(MPI_Comm on, const PlaneGrid& grid, const RankShare& mine, const std::string& where)
      : comm(on),
        folder(where),
        bytes(frame_bytes(grid)),
        data(on, where + "/" + data_file,
             mesh_bytes(static_cast<double>(grid.points.size()), grid.cells()) + bytes),
        image(on, grid, mine.begin, mine.end),
        layout(write_mesh(on, data, image)) {
    data.add_series({"/time", "s", "times of the frames"});
  }

  void add(const std::string& name, const char* units, const std::string& text,
           std::span<const PlaneTensor> rows) {
    refuse_unless_finite(comm, {rows.empty() ? nullptr : rows.front().data(), 3 * rows.size()}, text,
                         cure_of_overflow);
    const DatasetDescription about{frame_path(times.size()) + name, units, text};
    data.write({about.path, units, text + "; xx, yy and xy"}, image.cells(), {3},
               rows.empty() ? nullptr : rows.front().data());
    (void)write_components(data, layout, about, {3}, components, name);
  }

  /// What every rank knows and rank 0 writes.
  void add(const DatasetDescription& about, std::vector<hsize_t> shape, const double* values) {
    data.write(about, slice_of_root(comm, std::move(shape)), H5T_NATIVE_DOUBLE, values);
  }

  void add(std::size_t number, const LocalHistory& history) {
    const std::string point = format("/points/{}/", number);
    const hsize_t frames = history.time.size();
    const double region = history.region;
    add({point + "x", "m", "position of the point; x and y"}, {2}, history.x.data());
    add({point + "region", "1", "of its cell, index into the attribute names of /mesh/region"}, {1}, &region);
    if (frames == 0) return;
    add({point + "time", "s", "times of the rows"}, {frames}, history.time.data());
    add({point + "stress", "Pa", "relocalised stress of the cell; xx, yy and xy"}, {frames, 3},
        history.stress.front().data());
    add({point + "strain", "1", "relocalised strain of the cell, engineering shear; xx, yy and xy"},
        {frames, 3}, history.strain.front().data());
    add({point + "homogeneous_stress", "Pa", "stress of the homogeneous run; xx, yy and xy"}, {frames, 3},
        history.homogeneous_stress.front().data());
  }

  XdmfDocument document() const {
    XdmfDocument shown{data_file, "relocalised", layout, {xdmf_region()}, times};
    for (const std::string name : {"stress", "strain", "homogeneous_stress"})
      for (const std::string& component : components)
        shown.attributes.push_back(
            {.name = name + "_" + component, .path = name + "_" + component, .row = {}});
    return shown;
  }
};

RelocalisedFile::RelocalisedFile(MPI_Comm comm, const PlaneGrid& grid, const RankShare& mine,
                                 const std::string& folder, const std::vector<std::string>& notes)
    : file_(std::make_unique<File>(comm, grid, mine, folder)) {
  if (notes.empty()) return;
  file_->data.describe("/", [&](hid_t root) { write_attribute(root, "notes", notes); });
}

RelocalisedFile::~RelocalisedFile() = default;

void RelocalisedFile::write(double time, std::span<const PlaneTensor> stress,
                            std::span<const PlaneTensor> strain,
                            std::span<const PlaneTensor> homogeneous_stress) {
  file_->data.reserve(file_->bytes);
  file_->add("stress", "Pa", "relocalised stress of the cells", stress);
  file_->add("strain", "1", "relocalised strain of the cells, engineering shear", strain);
  file_->add("homogeneous_stress", "Pa", "stress of the homogeneous run at the cells", homogeneous_stress);
  file_->data.append("/time", time);
  file_->times.push_back(time);
}

void RelocalisedFile::close(const std::vector<LocalHistory>& histories) {
  for (std::size_t k = 0; k < histories.size(); ++k) file_->add(k, histories[k]);
  file_->data.finish();
  write_xdmf(file_->comm, file_->folder + "/relocalized.xdmf", file_->document());
}

}  // namespace slipscale
