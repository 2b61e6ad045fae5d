#include "slipscale/record/observation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace slipscale {
namespace {

std::vector<PetscInt> numbers_of(const Mesh& mesh, const std::vector<int>& nodes) {
  std::vector<PetscInt> numbers;
  for (int i : nodes) numbers.push_back(mesh.nodes.number[i]);
  return numbers;
}

/// [regions]
std::vector<double> shares_of(const ContactPlace& place, std::size_t regions) {
  std::vector<double> shares(regions, 0);
  shares[place.region[0]] = 1 - place.second;
  shares[place.region[1]] += place.second;
  return shares;
}

}  // namespace

Directions directions_of(const Boundary& boundary) {
  Vector2 normal = boundary.normal;
  if (normal[0] == 0 && normal[1] == 0) normal = {0, 1};
  Vector2 tangent{normal[1], -normal[0]};
  constexpr double upright = 1e-6;  // rounding tilts a straight side by far less
  if (tangent[0] < -upright || (std::abs(tangent[0]) <= upright && tangent[1] < 0))
    tangent = {-tangent[0], -tangent[1]};
  return {normal, tangent};
}

Observer::Observer(const SlidingBody& body, bool momentum) : body_(body), momentum_(momentum) {
  const Mesh& mesh = body.model().mesh;
  const auto& nodes = body.boundary_nodes();
  boundary_gather_ = OrderedGather(body.comm(), numbers_of(mesh, nodes.node));
  for (const std::string& name : body.boundary_names()) {
    if (name == body.scene().measured) measured_ = static_cast<int>(members_.size());
    std::vector<double> belongs(static_cast<std::size_t>(nodes.size()), 0);
    for (int i : mesh.find_boundary(name)->nodes) belongs[nodes.slot_of(i)] = 1;
    const auto all = boundary_gather_(belongs, 1);
    members_.emplace_back();
    for (std::size_t k = 0; k < all.size(); ++k)
      if (all[k] != 0) members_.back().push_back(static_cast<int>(k));
  }

  const ContactNodes& contact = body.contact();
  contact_gather_ = OrderedGather(body.comm(), numbers_of(mesh, contact.node));
  std::vector<double> place;
  for (int k = 0; k < contact.size(); ++k) {
    place.insert(place.end(), {mesh.nodes.position[contact.node[k]][0],
                               mesh.nodes.position[contact.node[k]][1], contact.tributary_length[k]});
    const auto shares = shares_of(body.contact_places()[k], mesh.regions.size());
    place.insert(place.end(), shares.begin(), shares.end());
  }
  const std::size_t width = 3 + mesh.regions.size();
  const auto all = contact_gather_(place, static_cast<int>(width));
  along_x_.resize(all.size() / width);
  std::iota(along_x_.begin(), along_x_.end(), 0);
  const auto row_of = [&](int k) { return all.begin() + static_cast<std::ptrdiff_t>(width) * k; };
  std::stable_sort(along_x_.begin(), along_x_.end(), [&](int a, int b) { return *row_of(a) < *row_of(b); });
  for (const int k : along_x_) {
    const auto row = row_of(k);
    contact_x_.push_back(row[0]);
    contact_y_.push_back(row[1]);
    contact_length_.push_back(row[2]);
    contact_shares_.insert(contact_shares_.end(), row + 3, row + static_cast<std::ptrdiff_t>(width));
  }
}

Observation Observer::observe(bool bulk) const {
  Observation seen;
  seen.time = body_.time();
  seen.step = body_.steps_done() - 1;
  if (bulk) seen.energy = body_.energy();
  if (bulk && momentum_) {
    seen.momentum = body_.momentum();
    observe_plates(seen);
  }
  if (bulk) observe_boundaries(seen);
  if (body_.scene().surface) observe_contact(seen);
  seen.friction = std::numeric_limits<double>::quiet_NaN();
  if (measured_ >= 0 && !seen.boundaries.empty() && seen.boundaries[measured_].normal != 0)
    seen.friction = seen.boundaries[measured_].tangential / seen.boundaries[measured_].normal;
  return seen;
}

void Observer::observe_boundaries(Observation& seen) const {
  std::vector<Vector2> mine;
  mine.reserve(static_cast<std::size_t>(body_.boundary_nodes().size()));
  for (int k = 0; k < body_.boundary_nodes().size(); ++k) mine.push_back(body_.force_on_support(k));
  const auto all = boundary_gather_({mine.empty() ? nullptr : mine[0].data(), 2 * mine.size()}, 2);
  if (all.empty()) return;
  for (std::size_t b = 0; b < members_.size(); ++b) {
    Vector2 sum{};
    for (int row : members_[b]) sum = {sum[0] + all[2 * row], sum[1] + all[2 * row + 1]};
    const auto [normal, tangent] =
        directions_of(*body_.model().mesh.find_boundary(body_.boundary_names()[b]));
    seen.boundaries.push_back(
        {sum[0] * normal[0] + sum[1] * normal[1], sum[0] * tangent[0] + sum[1] * tangent[1]});
  }
}

void Observer::observe_plates(Observation& seen) const {
  for (const auto& side : body_.straight_sides()) {
    PlateReading reading;
    const PlateMotion mass = side->plate_mass();
    for (std::size_t q = 0; side->answers_for_plate() && q < mass.size(); ++q) {
      reading.moved[q] = side->displacement()[q];
      reading.velocity[q] = side->velocity()[q];
      reading.momentum[q] = mass[q] * reading.velocity[q];
    }
    // The sum over ranks makes +0 of -0 where there are several, so one rank adds its zero as well.
    for (auto* two : {&reading.moved, &reading.velocity, &reading.momentum})
      for (double& value : *two) value += 0.0;
    static_assert(sizeof(PlateReading) == 6 * sizeof(double));
    MPI_Allreduce(MPI_IN_PLACE, &reading, 6, MPI_DOUBLE, MPI_SUM, body_.comm());
    seen.plates.push_back(reading);
  }
}

void Observer::observe_contact(Observation& seen) const {
  const ContactNodes& contact = body_.contact();
  static_assert(sizeof(ContactTotals) == 7 * sizeof(double));
  const bool with_totals = body_.keeps_contact_sums();
  const int width = with_totals ? 16 : 9;
  std::vector<double> mine;
  mine.reserve(static_cast<std::size_t>(contact.size()) * width);
  for (int k = 0; k < contact.size(); ++k) {
    const Vector2 &u = body_.displacement_n()[contact.node[k]], &v = body_.velocity_n()[contact.node[k]];
    mine.insert(mine.end(),
                {u[0], u[1], v[0], v[1], contact.clearance_now(k) + u[1], contact.memory[k].traction,
                 contact.traction[k], contact.force[k][1], static_cast<double>(contact.status[k])});
    if (!with_totals) continue;
    const ContactTotals totals = body_.contact_totals(k);
    mine.insert(mine.end(), &totals.friction_work, &totals.friction_work + 7);
  }
  const auto all = contact_gather_(mine, width);
  const double surface = body_.surface_velocity();
  double total = 0;
  seen.contact.reserve(along_x_.size());
  for (std::size_t k = 0; k < along_x_.size(); ++k) {
    const double *row = &all[static_cast<std::size_t>(along_x_[k]) * width], length = contact_length_[k];
    ContactReading reading{{row[0], row[1]},
                           {row[2], row[3]},
                           row[4],
                           row[5],
                           row[6],
                           row[7],
                           static_cast<ContactStatus>(row[8])};
    if (with_totals) reading.totals = {row[9], row[10], row[11], row[12], row[13], row[14], row[15]};
    const double force = reading.traction * length;
    seen.surface.normal += reading.normal_force;
    seen.surface.tangential += force;
    seen.power_into_body += force * reading.v[0];
    seen.friction_heat += force * (surface - reading.v[0]);
    (reading.status == ContactStatus::open    ? seen.open
     : reading.status == ContactStatus::stick ? seen.stick
                                              : seen.slip) += length;
    total += length;
    seen.contact.push_back(reading);
  }
  seen.drive_power = seen.surface.tangential * surface;
  if (total > 0)
    for (double* part : {&seen.stick, &seen.slip, &seen.open}) *part /= total;
}

}  // namespace slipscale
