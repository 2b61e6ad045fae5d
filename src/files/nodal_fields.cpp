#include "slipscale/files/nodal_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nodal_table.hpp"
#include "slipscale/base/checksum.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/yaml_text.hpp"
#include "slipscale/files/grid_file.hpp"
#include "slipscale/mesh/point_location.hpp"

namespace slipscale {
namespace {

constexpr double same_time = 1e-6;  ///< of a frame and the time that is asked for, relative

/// Which frame; throws UserError where none is at the time. Collective.
std::size_t frame_at(const GridFile& file, const std::vector<double>& times, double time,
                     const std::string& option) {
  const auto near = std::ranges::min_element(times, {}, [&](double each) { return std::abs(each - time); });
  const double scale = std::max(std::abs(time), times.back() * 1e-3);
  file.refuse_unless(
      std::abs(*near - time) <= same_time * scale, format("has no frame at {:g} s", time),
      format("the nearest is that of {:g} s, so give that with -{}, or leave it out for the last", *near,
             option));
  return static_cast<std::size_t>(near - times.begin());
}

NodalSource from_run(MPI_Comm comm, const std::string& path, const std::string& option,
                     const std::optional<double>& time, const std::string& time_option) {
  const GridFile file(
      comm, {path, "fields.h5", option, "run slide with -fields_every or -fields_times for that folder"});
  file.refuse_unless(file.has("/time"), "has no /time, so it is not a fields.h5");
  NodalSource source;
  source.grid = file.grid();
  std::vector<double> times;
  file.together([&] { times = file.reals("/time"); });
  file.refuse_unless(!times.empty(), "has no frames yet");
  const std::size_t frame = time ? frame_at(file, times, *time, time_option) : times.size() - 1;
  const auto read = [&](const char* quantity, std::vector<Vector2>& to) {
    const std::string name = format("/frames/{:05}/{}", frame, quantity);
    file.refuse_unless(file.has(name), format("has no {}", quantity),
                       format("run slide with {} among -fields_quantities", quantity));
    const std::size_t count = source.grid.points.size();
    std::vector<double> rows(3 * count);
    file.together([&] { file.read_rows(name, count, 3, 0, count, rows.data()); });
    for (std::size_t k = 0; k < count; ++k) to.push_back({rows[3 * k], rows[3 * k + 1]});
  };
  read("u", source.displacement);
  read("v", source.velocity);
  source.description = format("frame of t = {:g} s of '{}'", times[frame], file.path());
  return source;
}

/// The point of a line between a and b that is nearest to x: how far along it, and its distance.
struct OnEdge {
  double along, distance;
};
OnEdge nearest_on(const Vector2& a, const Vector2& b, const Vector2& x) {
  const Vector2 edge{b[0] - a[0], b[1] - a[1]}, to{x[0] - a[0], x[1] - a[1]};
  const double along =
      std::clamp((to[0] * edge[0] + to[1] * edge[1]) / (edge[0] * edge[0] + edge[1] * edge[1]), 0.0, 1.0);
  return {along, std::hypot(to[0] - along * edge[0], to[1] - along * edge[1])};
}

class Interpolation {
 public:
  explicit Interpolation(const NodalSource& source) : source_(source), location_(source.grid) {
    const Box box = bounding_box(source.grid);
    reach_ = nodal_fields_reach * std::max(box.width(), box.height());
  }

  /// How far outside the place lies, m; 0 where there are values.
  double at(const Vector2& place, Vector2& displacement, Vector2& velocity) const {
    const PlaneGrid& grid = source_.grid;
    const auto add = [&](int point, double part) {
      for (int axis = 0; axis < 2; ++axis) {
        displacement[axis] += part * source_.displacement[point][axis];
        velocity[axis] += part * source_.velocity[point][axis];
      }
    };
    displacement = velocity = {0, 0};
    if (const CellPlace found = location_.find(place); found.cell != CellPlace::none) {
      for (int k = 0; k < grid.corner_count(found.cell); ++k)
        add(grid.corners[grid.first[found.cell] + k], found.shape[k]);
      return 0;
    }
    OnEdge best{0, std::numeric_limits<double>::infinity()};
    int from = 0, to = 0;
    for (int cell = 0; cell < grid.cells(); ++cell)
      for (int k = 0, n = grid.corner_count(cell); k < n; ++k) {
        const int a = grid.corners[grid.first[cell] + k], b = grid.corners[grid.first[cell] + (k + 1) % n];
        const OnEdge each = nearest_on(grid.points[a], grid.points[b], place);
        if (each.distance < best.distance) best = each, from = a, to = b;
      }
    if (!(best.distance <= reach_)) return best.distance;
    add(from, 1 - best.along);
    add(to, best.along);
    return 0;
  }

  double reach() const { return reach_; }

 private:
  const NodalSource& source_;
  const PointLocation location_;
  double reach_ = 0;
};

}  // namespace

NodalFields read_nodal_fields(MPI_Comm comm, const std::string& path, const std::string& option,
                              const std::optional<double>& time, const std::string& time_option,
                              const std::vector<Vector2>& places) {
  NodalSource source;
  if (path.ends_with(".csv")) {
    source = nodal_table("-" + option + ": '" + path + "'", read_on_all("-" + option, path));
    source.description += " of '" + path + "'";
  } else {
    source = from_run(comm, path, option, time, time_option);
  }
  NodalFields found;
  found.description = source.description;
  Checksum sum;
  for (const auto* values : {&source.grid.points, &source.displacement, &source.velocity})
    sum.add(values->data(), values->size() * sizeof(Vector2));
  found.checksum = sum.value();

  const Interpolation interpolation(source);
  std::string fault;
  for (const Vector2& place : places) {
    const double outside =
        interpolation.at(place, found.displacement.emplace_back(), found.velocity.emplace_back());
    if (outside == 0) continue;
    const Box box = bounding_box(source.grid);
    fault = format(
        "-{}: the node at x = {:g} m, y = {:g} m lies {:.3g} m outside of '{}', which spans x {:g} to {:g} m "
        "and y {:g} to {:g} m; {:.2g} m (1e-6 of that) would be let pass, so give a file of the whole body",
        option, place[0], place[1], outside, path, box.lower[0], box.upper[0], box.lower[1], box.upper[1],
        interpolation.reach());
    break;
  }
  throw_together(comm, fault);
  return found;
}

}  // namespace slipscale
