#pragma once

#include "scenes.hpp"

namespace slipscale::testing_support {

/// What must hold in every step of every run, as the worst that was seen, and what the run came to.
///
/// The slip of a step is against its traction nowhere, which is sharper than the ledger's friction heat: that
/// weights the tractions at both ends of the step and may fall a little where slip reverses.
struct Watched {
  double residual = 0;        ///< of the energy balance, relative to what flowed
  double penetration = 0;     ///< of u_{n+1} into the surface, relative to the largest displacement
  double suction = 0;         ///< −p where p < 0, Pa
  double excess = 0;          ///< |τ| beyond μ times the largest p since the node closed, relative to it
  double against = 0;         ///< slip against the traction, relative to displacement and travel
  double heat = 0;            ///< friction heat at the last look, relative to what flowed
  double displacement = 0;    ///< largest component, m
  double traction = 0;        ///< largest |τ|, Pa
  double drag = 0, load = 0;  ///< means over the run of the surface's tangential and normal force, N/m

  bool sound() const;                ///< energy and contact are right to rounding, heat is positive
  void include(const Watched& run);  ///< the worse of the two in all that `sound` looks at
};

/// Makes `steps` steps and looks at contact after each and at the energy after every tenth. Collective.
Watched watch(SlidingBody& body, long steps);

/// 1e-14 for 3e-15: rounding, which differs with the number of ranks, as a bound.
std::string decade_above(double value);

/// Expects a group of runs to be sound, and their displacement to be at most twice what press and surface
/// can bring about, `reach`; one row of the table. A step that is unstable misses by orders of magnitude.
class Group {
 public:
  explicit Group(std::string topic) : topic_(std::move(topic)) {}
  void add(const Watched& run, double reach, const std::string& what);
  void report_worst() const;

 private:
  std::string topic_;
  Watched worst_;
  double reached_ = 0;
  int runs_ = 0;
};

/// Scene R on 10 × 10 elements, pressed down within 2 µs so that a short run is in full contact.
Scene pressed_scene();
Block pressed_block();

/// A run of `steps` steps at .9 of the stable step, and U + Vt for it.
struct WatchedRun {
  Watched seen;
  double reach;  ///< m
};
WatchedRun run_watched(const Block& block, const std::vector<Material>& materials, const Scene& scene,
                       long steps);

}  // namespace slipscale::testing_support
