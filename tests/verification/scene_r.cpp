#include <gtest/gtest.h>

#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// u of the central contact node M, its velocity (u_{n+1} − u_n)/Δt and the top's load at one time.
struct Reading {
  double u, v, tangential, normal;
};

Reading scene_r_at(double spacing, double step, double time, Partitioner partitioner = Partitioner::metis) {
  Block block;
  block.width = block.height = 5e-3;
  block.nx = block.ny = static_cast<int>(std::lround(5e-3 / spacing));
  block.shape = Shape::quadrilaterals;
  const Mesh mesh = block_mesh(block, partitioner);
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  SlidingBody body(PETSC_COMM_WORLD, model, scene_r(), step);
  const long last = std::lround(time / step);
  for (long n = 0; n <= last; ++n) body.advance(n == last);
  const Vector2 m{2.5e-3, 0};
  const double now = value_near(mesh, body.displacement_n(), m, 0),
               next = value_near(mesh, body.next_displacement(), m, 0);
  const Vector2 top = support_force(body, "top");
  return {now, (next - now) / step, top[0], top[1]};
}

/// One quantity within 1e-6 of the reference.
void compare(const std::string& quantity, double found, double expected) {
  EXPECT_NEAR(found / expected, 1, 1e-6) << quantity;
  report({"Scene R before saturation", quantity, format("{:.10g}, relative +- 1e-6", expected),
          format("{:.10g}", found), "", "second program, second_program.py"});
}

void compare(const std::string& when, const Reading& found, const Reading& expected) {
  compare(when + ": u_M, m", found.u, expected.u);
  compare(when + ": v_M, m/s", found.v, expected.v);
  compare(when + ": top T, N/m", found.tangential, expected.tangential);
  compare(when + ": top N, N/m", found.normal, expected.normal);
}

}  // namespace

/// Before saturation; figures of second_program.py, as it prints them.
TEST(SceneR, AgreesWithTheReferenceAtTenMicroseconds) {
  compare("h .25 mm, 10 us", scene_r_at(0.25e-3, 5e-9, 10e-6),
          {3.716186611e-7, 0.06998790387, 4476.373474, 10365.76611});
}

TEST(SceneR, AgreesWithTheReferenceAtThirtyMicroseconds) {
  compare("h .25 mm, 30 us", scene_r_at(0.25e-3, 5e-9, 30e-6),
          {2.461864355e-6, 0.09284393237, 29911.02442, 60767.82014});
}

TEST(SceneR, AgreesWithTheReferenceOnTheFinerMesh) {
  compare("h .125 mm, 30 us: u_M, m", scene_r_at(0.125e-3, 2.5e-9, 30e-6).u, 2.467210660e-6);
}
