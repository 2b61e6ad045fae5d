#include "slipscale/modes/modes_file.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slipscale/base/print.hpp"
#include "slipscale/files/mesh_group.hpp"
#include "slipscale/files/xdmf.hpp"
#include "slipscale/mesh/ordered_gather.hpp"

namespace slipscale {
namespace {

/// A vector for each point, with the third component that ParaView's warping wants.
void write_vectors(SharedFile& file, const MeshImage& image, const DatasetDescription& about,
                   const Vector2* values) {
  std::vector<double> rows;
  rows.reserve(3 * image.point_nodes().size());
  for (const int node : image.point_nodes()) rows.insert(rows.end(), {values[node][0], values[node][1], 0.0});
  file.write(about, image.points(), {3}, rows.data());
}

/// A number for each mode.
void write_spectrum(MPI_Comm comm, SharedFile& file, const ModesReport& report) {
  const auto write = [&](const std::string& name, const std::string& units, const std::string& text,
                         const auto& value) {
    std::vector<double> rows;
    for (const ReportedMode& each : report.modes) rows.push_back(value(each));
    file.write({"/spectrum/" + name, units, text}, slice_of_root(comm, {report.modes.size()}),
               H5T_NATIVE_DOUBLE, rows.data());
  };
  write("frequency", "Hz", "frequency of each mode",
        [](const ReportedMode& each) { return each.frequency(); });
  write("growth_rate", "1/s", "growth rate", [](const ReportedMode& each) { return each.growth_rate(); });
  write("damping_ratio", "1", "-Re p/|p|", [](const ReportedMode& each) { return each.damping_ratio(); });
  write("near_contact_energy", "1", "part of the strain energy within a tenth of the height of the surface",
        [](const ReportedMode& each) { return each.measures.near_contact; });
  write("residual", "1", "of the mode on the whole body, relative",
        [](const ReportedMode& each) { return each.mode.residual; });
  if (report.step) {
    const auto missing = [](const ReportedMode& each, auto value) {
      return each.scheme ? value(each.scheme->exponent) : std::nan("");
    };
    write("scheme_frequency", "Hz", "frequency in the time scheme", [&](const ReportedMode& each) {
      return missing(each, [](Complex p) { return p.imag() / (2 * std::numbers::pi); });
    });
    write("scheme_growth_rate", "1/s", "growth rate in the time scheme",
          [&](const ReportedMode& each) { return missing(each, [](Complex p) { return p.real(); }); });
  }
  std::vector<double> work;
  for (const ReportedMode& each : report.modes)
    work.insert(work.end(), each.measures.friction_work.begin(), each.measures.friction_work.end());
  file.write({"/spectrum/friction_work", "J/m",
              "work of friction on the body over a period, of a mode that carries 1 J/m, by region"},
             slice_of_root(comm, {report.modes.size(), report.regions.size()}), H5T_NATIVE_DOUBLE,
             work.data(), [&](hid_t set) { write_attribute(set, "names", report.regions); });
}

/// The nodes that can meet the surface, in the order of their place along x.
class AlongContact {
 public:
  AlongContact(MPI_Comm comm, const Mesh& mesh, const SteadySliding& state)
      : comm_(comm), state_(state), gather_(comm, numbers(mesh, state)) {
    std::vector<double> x;
    for (const SurfaceNode& each : state.nodes) x.push_back(mesh.nodes.position[each.node][0]);
    x_ = gather_(x, 1);
    order_.resize(x_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) order_[k] = k;
    std::ranges::sort(order_, [&](std::size_t a, std::size_t b) { return x_[a] < x_[b]; });
    count_ = static_cast<hsize_t>(x_.size());
    MPI_Bcast(&count_, 1, MPI_UNSIGNED_LONG_LONG, 0, comm);
  }

  hsize_t count() const { return count_; }
  /// A number of this rank's nodes, on rank 0 in the order along x.
  std::vector<double> operator()(const std::vector<double>& mine) const {
    const std::vector<double> all = gather_(mine, 1);
    std::vector<double> sorted;
    for (const std::size_t k : order_) sorted.push_back(all[k]);
    return sorted;
  }
  /// A traction from the forces on closed nodes, 0 where a node is open.
  std::vector<double> traction(const Eigen::VectorXd& force) const {
    std::vector<double> mine;
    Eigen::Index closed = 0;
    for (std::size_t k = 0; k < state_.nodes.size(); ++k)
      mine.push_back(state_.is_closed[k] ? force[closed++] / state_.nodes[k].length : 0);
    return (*this)(mine);
  }

 private:
  static std::vector<PetscInt> numbers(const Mesh& mesh, const SteadySliding& state) {
    std::vector<PetscInt> found;
    for (const SurfaceNode& each : state.nodes) found.push_back(mesh.nodes.number[each.node]);
    return found;
  }

  MPI_Comm comm_;
  const SteadySliding& state_;
  OrderedGather gather_;
  std::vector<double> x_;
  std::vector<std::size_t> order_;
  hsize_t count_ = 0;
};

void write_contact(MPI_Comm comm, SharedFile& file, const Mesh& mesh, const ModesReport& report,
                   const SteadySliding& state) {
  const AlongContact along(comm, mesh, state);
  const auto write = [&](const std::string& name, const std::string& units, const std::string& text,
                         const std::vector<double>& rows) {
    file.write({"/contact/" + name, units, text}, slice_of_root(comm, {along.count()}), H5T_NATIVE_DOUBLE,
               rows.data());
  };
  std::vector<double> x, closed, pressure;
  for (std::size_t k = 0; k < state.nodes.size(); ++k) {
    x.push_back(mesh.nodes.position[state.nodes[k].node][0]);
    closed.push_back(state.is_closed[k]);
    pressure.push_back(state.reaction[k] / state.nodes[k].length);
  }
  write("x", "m", "places of the nodes that can meet the surface", along(x));
  write("closed", "1", "1 where the node is closed in the steady state", along(closed));
  write("pressure", "Pa", "pressure of the steady state", along(pressure));
  const auto write_modes = [&](const std::string& name, const std::string& text, const auto& part) {
    std::vector<double> rows;
    for (const ReportedMode& each : report.modes) {
      const auto row = along.traction(part(each.measures));
      rows.insert(rows.end(), row.begin(), row.end());
    }
    file.write({"/contact/" + name, "Pa", text}, slice_of_root(comm, {report.modes.size(), along.count()}),
               H5T_NATIVE_DOUBLE, rows.data());
  };
  write_modes("normal_real", "pressure in each mode, real part",
              [](const ModeMeasures& m) -> Eigen::VectorXd { return m.normal.real(); });
  write_modes("normal_imaginary", "pressure in each mode, imaginary part",
              [](const ModeMeasures& m) -> Eigen::VectorXd { return m.normal.imag(); });
  write_modes("tangential_real", "traction of friction along +x in each mode, real part",
              [](const ModeMeasures& m) -> Eigen::VectorXd { return m.tangential.real(); });
  write_modes("tangential_imaginary", "traction of friction along +x in each mode, imaginary part",
              [](const ModeMeasures& m) -> Eigen::VectorXd { return m.tangential.imag(); });
}

void write_sweep(MPI_Comm comm, SharedFile& file, const ModesSweep& sweep) {
  const std::string group = "/sweep/" + sweep.choice.name + "/";
  const std::size_t points = sweep.choice.values.size();
  file.write({group + "value", sweep.choice.unit, "values of the sweep"}, slice_of_root(comm, {points}),
             H5T_NATIVE_DOUBLE, sweep.choice.values.data());
  const auto write = [&](const std::string& name, const std::string& units, const std::string& text,
                         const auto& of) {
    std::vector<double> rows;
    for (const ModePath& path : sweep.paths)
      for (std::size_t k = 0; k < points; ++k) rows.push_back(of(path, k));
    file.write({group + name, units, text}, slice_of_root(comm, {sweep.paths.size(), points}),
               H5T_NATIVE_DOUBLE, rows.data());
  };
  write("growth_rate", "1/s", "of each mode along the sweep; NaN where it is lost",
        [](const ModePath& path, std::size_t k) { return path.exponent[k].real(); });
  write("frequency", "Hz", "of each mode along the sweep",
        [](const ModePath& path, std::size_t k) { return path.exponent[k].imag() / (2 * std::numbers::pi); });
  write("residual", "1", "of each point on the whole body, relative",
        [](const ModePath& path, std::size_t k) { return path.residual[k]; });
}

/// Real and imaginary part of a shape on all local nodes.
class Shape {
 public:
  Shape(const SlidingOperator& body, const Columns& shape)
      : real_(body.comm(), body.model().mesh.nodes, true),
        imaginary_(body.comm(), body.model().mesh.nodes, true),
        size_(body.model().mesh.nodes.number.size()) {
    body.free().expand(shape.col(0).data(), real_.data());
    body.free().expand(shape.col(1).data(), imaginary_.data());
    for (NodalVector* part : {&real_, &imaginary_}) {
      part->begin_update();
      part->end_update();
    }
  }
  const Vector2* real() const { return real_.data(); }
  const Vector2* imaginary() const { return imaginary_.data(); }
  /// Re(u e^{iα}).
  std::vector<Vector2> at(double angle) const {
    const double c = std::cos(angle), s = std::sin(angle);
    std::vector<Vector2> u(size_);
    for (std::size_t i = 0; i < size_; ++i)
      for (int axis = 0; axis < 2; ++axis)
        u[i][axis] = c * real_.data()[i][axis] - s * imaginary_.data()[i][axis];
    return u;
  }

 private:
  NodalVector real_, imaginary_;
  std::size_t size_;
};

std::string mode_name(std::size_t k) { return format("mode_{}", k + 1); }

}  // namespace

void write_modes(MPI_Comm comm, const std::string& folder, const Mesh& mesh, const ModesReport& report,
                 const SteadySliding& state, int shapes, int frames) {
  const MeshImage image(comm, mesh);
  const auto shown = std::min(static_cast<std::size_t>(shapes), report.modes.size());
  const double points = static_cast<double>(image.points().total()),
               cells = static_cast<double>(image.cells().total()), vector = 3 * sizeof(double) * points,
               rows = static_cast<double>(report.modes.size() * (4 * state.nodes.size() + 32)) * 8;
  SharedFile file(comm, folder + "/modes.h5",
                  mesh_bytes(points, cells) + vector * (1 + static_cast<double>(shown) * (frames + 2)) +
                      rows + group_overhead * (20 + frames + static_cast<double>(shown)));
  const MeshLayout layout = write_mesh(comm, file, image);
  write_spectrum(comm, file, report);
  write_contact(comm, file, mesh, report, state);
  for (const ModesSweep& sweep : report.sweeps) write_sweep(comm, file, sweep);
  NodalVector u(comm, mesh.nodes, true);
  std::copy(state.displacement.begin(), state.displacement.end(), u.data());
  u.begin_update();
  u.end_update();
  write_vectors(file, image, {"/state/displacement", "m", "of the steady state; x, y and 0"}, u.data());

  XdmfDocument document{"modes.h5", "block", layout, {}, std::vector<double>{}};
  for (int frame = 0; frame < frames; ++frame)
    document.times->push_back(static_cast<double>(frame) / static_cast<double>(frames));
  for (std::size_t k = 0; k < shown; ++k) {
    const Shape shape(*state.body, report.modes[k].measures.shape);
    const std::string group = "/shape/" + mode_name(k) + "/", text = "part of the shape; x, y and 0";
    write_vectors(file, image, {group + "real", "m", "real " + text}, shape.real());
    write_vectors(file, image, {group + "imaginary", "m", "imaginary " + text}, shape.imaginary());
    for (std::size_t frame = 0; shown > 0 && frame < document.times->size(); ++frame)
      write_vectors(file, image, {frame_path(frame) + mode_name(k), "m", "Re(u exp(2 pi i t)); x, y and 0"},
                    shape.at(2 * std::numbers::pi * (*document.times)[frame]).data());
    document.attributes.push_back({mode_name(k), XdmfAttribute::Centre::node, mode_name(k), {3}});
  }
  document.attributes.push_back(xdmf_region());
  file.finish();
  if (shown > 0) write_xdmf(comm, folder + "/modes.xdmf", document);
}

}  // namespace slipscale
