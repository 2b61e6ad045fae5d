#include "slipscale/record/history.hpp"

#include <array>
#include <limits>
#include <map>

namespace slipscale {
namespace {

constexpr double between_batches = 0.5;  // s

}  // namespace

HistoryFile::HistoryFile(const std::string& path, const SlidingBody& body, const std::vector<Vector2>& points,
                         bool momentum, double rows, std::optional<SeriesFile::Continue> continued)
    : file_(path, between_batches, rows, continued) {
  time_ = file_.add("/time", {}, "s", "time of the row, t_n = n times the step");
  step_ = file_.add("/step", {}, "1", "number of the step, n");
  for (const std::string& name : body.boundary_names()) {
    const std::string group = "/boundary/" + name + "/";
    boundary_.push_back(file_.add(group + "normal_force", {}, "N/m",
                                  "force of the body on " + name + ", > 0 in compression"));
    boundary_.push_back(
        file_.add(group + "tangential_force", {}, "N/m", "force of the body on " + name + " along +x"));
  }
  if (!body.scene().measured.empty())
    friction_ = file_.add("/friction/global", {}, "1",
                          "tangential over normal force at " + body.scene().measured + "; NaN without load");
  if (body.scene().surface) {
    surface_ = {
        file_.add("/surface/normal_force", {}, "N/m", "force of the surface on the body along +y"),
        file_.add("/surface/tangential_force", {}, "N/m", "force of the surface on the body along +x"),
        file_.add("/surface/drive_power", {}, "W/m", "power of the motor that drives the surface"),
        file_.add("/surface/power_into_body", {}, "W/m", "power of friction on the moving body"),
        file_.add("/surface/friction_heat", {}, "W/m", "power turned into heat at the surface")};
    fractions_ = {file_.add("/contact/stick", {}, "1", "part of the contact boundary's length that sticks"),
                  file_.add("/contact/slip", {}, "1", "part of it that slips"),
                  file_.add("/contact/open", {}, "1", "part of it that is open")};
  }
  add_energy();
  if (momentum) add_momentum(body);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::string group = "/points/" + std::to_string(k) + "/";
    file_.constant(group + "x", points[k].data(), {2}, "m", "where the point is in the undeformed body");
    points_.push_back(file_.add(group + "u", {2}, "m", "displacement"));
    points_.push_back(file_.add(group + "v", {2}, "m/s", "velocity"));
    points_.push_back(file_.add(group + "stress", {3}, "Pa", "stress xx, yy, xy"));
  }
}

void HistoryFile::add_energy() {
  for (const EnergyTerm& term : energy_terms)
    energy_.push_back(file_.add(std::string("/energy/") + term.name, {}, "J/m", term.description));
}

void HistoryFile::add_momentum(const SlidingBody& body) {
  momentum_ = {
      file_.add("/momentum/linear", {2}, "kg/s", "momentum of the body along x and y, without plates"),
      file_.add("/momentum/angular", {}, "kg m/s",
                "angular momentum of the body about the middle of the block, counter-clockwise")};
  for (const auto& side : body.straight_sides()) {
    const std::string group = "/plate/" + side->boundary() + "/";
    const auto add = [&](const std::string& name, const std::string& units, const std::string& description) {
      plates_.push_back(file_.add(group + name, {}, units, description));
    };
    add("displacement", "m", "of the plate's middle along y");
    add("tilt", "rad", "of the plate, counter-clockwise");
    add("velocity", "m/s", "of its middle along y");
    add("tilt_rate", "rad/s", "of the plate, counter-clockwise");
    add("momentum", "kg/s", "of the plate's own mass along y");
    add("angular_momentum", "kg m/s", "of its own mass about its middle, counter-clockwise");
  }
}

/// Calls `visit(id of the quantity, its place in the observation)` for all that is a real number: what is
/// written and what is read back is the same.
template <class Seen, class Visit>
void HistoryFile::visit_numbers(Seen& seen, Visit visit) const {
  visit(time_, seen.time);
  for (std::size_t b = 0; b < seen.boundaries.size(); ++b) {
    visit(boundary_[2 * b], seen.boundaries[b].normal);
    visit(boundary_[2 * b + 1], seen.boundaries[b].tangential);
  }
  if (friction_ >= 0) visit(friction_, seen.friction);
  if (!surface_.empty()) {
    visit(surface_[0], seen.surface.normal);
    visit(surface_[1], seen.surface.tangential);
    visit(surface_[2], seen.drive_power);
    visit(surface_[3], seen.power_into_body);
    visit(surface_[4], seen.friction_heat);
    visit(fractions_[0], seen.stick);
    visit(fractions_[1], seen.slip);
    visit(fractions_[2], seen.open);
  }
  for (std::size_t k = 0; k < energy_.size(); ++k) visit(energy_[k], seen.energy.*energy_terms[k].value);
}

void HistoryFile::write(const Observation& seen, const std::vector<ProbeReading>& probes) {
  visit_numbers(seen, [&](int id, double value) { file_.append(id, value); });
  file_.append(step_, static_cast<double>(seen.step));
  write_momentum(seen);
  for (std::size_t p = 0; p < probes.size(); ++p) {
    file_.append(points_[3 * p], probes[p].u.data());
    file_.append(points_[3 * p + 1], probes[p].v.data());
    file_.append(points_[3 * p + 2], probes[p].stress.data());
  }
  file_.end_row();
}

std::vector<Observation> HistoryFile::rows_so_far() {
  Observation row;
  row.boundaries.resize(boundary_.size() / 2);
  row.friction = std::numeric_limits<double>::quiet_NaN();
  std::map<int, std::vector<double>> columns{{step_, file_.read(step_)}};
  visit_numbers(row, [&](int id, double&) { columns[id] = file_.read(id); });
  std::vector<Observation> rows;
  if (!file_.fault().empty() || !file_.refusal().empty()) return rows;
  for (std::size_t k = 0; k < file_.rows(); ++k) {
    visit_numbers(row, [&](int id, double& value) { value = columns[id][k]; });
    row.step = static_cast<long>(columns[step_][k]);
    rows.push_back(row);
  }
  return rows;
}

void HistoryFile::write_momentum(const Observation& seen) {
  if (momentum_.empty()) return;
  file_.append(momentum_[0], seen.momentum.linear.data());
  file_.append(momentum_[1], seen.momentum.angular);
  auto column = plates_.begin();
  for (const PlateReading& plate : seen.plates)
    for (const PlateMotion& pair : {plate.moved, plate.velocity, plate.momentum})
      for (const double value : pair) file_.append(*column++, value);
}

ContactFile::ContactFile(const std::string& path, const Observer& observer,
                         const std::vector<std::string>& regions, bool sums, double rows,
                         std::optional<SeriesFile::Continue> continued)
    : file_(path, between_batches, rows, continued), length_(observer.tributary_length()) {
  const hsize_t nodes = observer.contact_x().size();
  file_.constant("/x", observer.contact_x().data(), {nodes}, "m",
                 "where the contact nodes are in the undeformed body");
  file_.constant("/y", observer.contact_y().data(), {nodes}, "m", "their heights in the undeformed body");
  file_.constant("/tributary_length", length_.data(), {nodes}, "m",
                 "length of the boundary that belongs to each node");
  std::string names;
  for (const std::string& name : regions) names += (names.empty() ? "" : "\n") + name;
  file_.about("regions", names);
  file_.constant("/region_share", observer.region_shares().data(), {nodes, regions.size()}, "1",
                 "part of that length that belongs to each of the regions, which an attribute of the file "
                 "names");
  time_ = file_.add("/time", {}, "s", "time of the row");
  u_ = file_.add("/u", {nodes, 2}, "m", "displacement");
  v_y_ = file_.add("/v_y", {nodes}, "m/s", "velocity along +y");
  gap_ = file_.add("/gap", {nodes}, "m", "height above the surface; 0 in contact to rounding");
  slip_rate_ =
      file_.add("/slip_rate", {nodes}, "m/s", "velocity of the surface relative to the node, along +x");
  normal_ = file_.add("/normal_traction", {nodes}, "Pa", "pressure, >= 0");
  tangential_ = file_.add("/tangential_traction", {nodes}, "Pa", "traction on the body along +x");
  strength_ =
      file_.add("/strength", {nodes}, "Pa",
                "what the friction law remembers: the stored strength (regularised threshold), or the "
                "tangential traction of the step; 0 where open");
  status_ = file_.add("/status", {nodes}, "1", "0 open, 1 stick, 2 slip", SeriesFile::Storage::byte);
  if (!sums) return;
  const std::array<std::array<const char*, 3>, 7> quantities{
      {{"friction_work", "J/m^2",
        "heat of friction; times the tributary length, over all nodes: "
        "/energy/friction_heat of history.h5"},
       {"impact_loss", "J/m^2", "energy lost where the node met the surface, likewise /energy/impact_loss"},
       {"slip_distance", "m",
        "way that the surface slipped along the node while they touched, forth and "
        "back alike"},
       {"pressure_slip", "Pa m", "pressure times slip distance, step by step: what Archard's law asks for"},
       {"time_closed", "s", "time in contact"},
       {"impulse", "Pa s", "normal impulse"},
       {"closures", "1", "times that the node came into contact, at the start as well"}}};
  for (const auto& [name, units, text] : quantities)
    sums_.push_back(file_.add(std::string("/sums/") + name, {nodes}, units,
                              std::string(text) + "; over every step since t = 0"));
}

void ContactFile::write(const Observation& seen, double surface_velocity) {
  for (auto* row :
       {&u_row_, &v_y_row_, &gap_row_, &slip_row_, &normal_row_, &tangential_row_, &strength_row_})
    row->clear();
  status_row_.clear();
  for (std::size_t k = 0; k < seen.contact.size(); ++k) {
    const ContactReading& node = seen.contact[k];
    u_row_.insert(u_row_.end(), node.u.begin(), node.u.end());
    v_y_row_.push_back(node.v[1]);
    gap_row_.push_back(node.gap);
    slip_row_.push_back(surface_velocity - node.v[0]);
    normal_row_.push_back(node.normal_force / length_[k]);
    tangential_row_.push_back(node.traction);
    strength_row_.push_back(node.strength);
    status_row_.push_back(static_cast<std::uint8_t>(node.status));
  }
  file_.append(time_, seen.time);
  file_.append(u_, u_row_.data());
  file_.append(v_y_, v_y_row_.data());
  file_.append(gap_, gap_row_.data());
  file_.append(slip_rate_, slip_row_.data());
  file_.append(normal_, normal_row_.data());
  file_.append(tangential_, tangential_row_.data());
  file_.append(strength_, strength_row_.data());
  file_.append(status_, status_row_.data());
  for (std::size_t q = 0; q < sums_.size(); ++q) {
    sums_row_.clear();
    for (const ContactReading& node : seen.contact) sums_row_.push_back((&node.totals.friction_work)[q]);
    file_.append(sums_[q], sums_row_.data());
  }
  file_.end_row();
}

}  // namespace slipscale
