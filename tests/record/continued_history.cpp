#include <gtest/gtest.h>

#include "read_back.hpp"
#include "scenes.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/record/history.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

const MPI_Comm& world = PETSC_COMM_WORLD;
constexpr int steps = 60;

Scene scene_of(bool with_surface) {
  Scene scene = scene_r();
  if (!with_surface) scene.surface.reset();
  return scene;
}

/// A run with its files, on rank 0.
struct Sliding {
  Sliding(const Mesh& mesh, bool with_surface)
      : model(mesh, {scene_r_material()}, Model::Storage::full),
        body(world, model, scene_of(with_surface), 2e-8),
        observer(body, false),
        probes(world, model, {{1e-3, 2e-3}}) {
    body.keep_contact_sums();
  }

  /// Makes all steps; writes those from `from` on, continuing files that have so many rows.
  std::vector<Observation> go(const std::string& name, int from, int to) {
    std::optional<SeriesFile::Continue> continued;
    if (from > 0) continued = SeriesFile::Continue{static_cast<hsize_t>(from)};
    std::optional<HistoryFile> history;
    std::optional<ContactFile> contact;
    const bool surface = body.scene().surface.has_value();
    std::vector<Observation> rows;
    if (is_root(world)) {
      history.emplace(name + ".history.h5", body, probes.positions(), false, steps, continued);
      if (surface)
        contact.emplace(name + ".contact.h5", observer, model.mesh.region_names(), true, steps, continued);
      rows = history->rows_so_far();
      EXPECT_EQ(history->series().refusal(), "");
      EXPECT_EQ(rows.size(), static_cast<std::size_t>(from));
    }
    for (int n = 0; n < to; ++n) {
      body.advance(true);
      Observation seen = observer.observe();
      const auto readings = probes.read(body);
      if (n < from || !history) continue;
      history->write(seen, readings);
      if (contact) contact->write(seen, body.surface_velocity());
      seen.contact.clear();
      rows.push_back(seen);
    }
    if (history) {
      history->series().close();
      EXPECT_EQ(history->series().fault(), "");
    }
    if (contact) contact->series().close();
    return rows;
  }

  Model model;
  SlidingBody body;
  Observer observer;
  Probes probes;
};

/// The numbers of an observation, in a row.
std::vector<double> numbers(const Observation& seen) {
  std::vector<double> all{seen.time,           static_cast<double>(seen.step),
                          seen.surface.normal, seen.surface.tangential,
                          seen.drive_power,    seen.power_into_body,
                          seen.friction_heat,  seen.stick,
                          seen.slip,           seen.open,
                          seen.friction};
  for (const BoundaryLoad& load : seen.boundaries) all.insert(all.end(), {load.normal, load.tangential});
  for (const EnergyTerm& term : energy_terms) all.push_back(seen.energy.*term.value);
  return all;
}

}  // namespace

TEST(ContinuedHistory, IsTheSameAsOneThatWasNotInterruptedAndTellsItsRows) {
  Block shape;
  shape.nx = shape.ny = 6;
  shape.width = shape.height = 5e-3;
  const Mesh mesh = block_mesh(shape);
  for (const bool with_surface : {true, false}) {
    const std::string whole = scratch("whole"), parts = scratch("parts");
    const auto expected = Sliding(mesh, with_surface).go(whole, 0, steps);
    Sliding(mesh, with_surface).go(parts, 0, 37);
    const auto found = Sliding(mesh, with_surface).go(parts, 25, steps);
    if (!is_root(world)) continue;
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_TRUE(read_back::same_bits(numbers(found[k]), numbers(expected[k]))) << k;
    for (const char* kind : {".history.h5", ".contact.h5"}) {
      if (!with_surface && std::string(kind) == ".contact.h5") continue;
      const auto all = read_back::everything(whole + kind), again = read_back::everything(parts + kind);
      ASSERT_EQ(again.size(), all.size());
      for (const auto& [path, dataset] : all) {
        EXPECT_EQ(again.at(path).shape, dataset.shape) << path;
        EXPECT_TRUE(read_back::same_bits(again.at(path).values, dataset.values)) << path;
      }
    }
  }
}
