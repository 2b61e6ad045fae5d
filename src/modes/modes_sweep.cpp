#include "slipscale/modes/modes_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "slipscale/base/log.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "sweep_problem.hpp"

namespace slipscale {
namespace {

constexpr double tolerable = 1e-6;  ///< residual of a point
constexpr int most_places = 12;     ///< where modes are found on the whole body
constexpr double same = 1e-6;       ///< exponents that are one, relative
constexpr Complex lost{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

bool is_there(Complex p) { return std::isfinite(p.real()) && std::isfinite(p.imag()); }

SlidingLaw law_at(const Scene& scene, const SweepChoice& choice, std::size_t k) {
  Scene changed = scene;
  const double value = choice.values[k];
  switch (choice.of) {
    case SweepChoice::Of::coefficient:
      changed.friction.coefficient = value;
      break;
    case SweepChoice::Of::speed:
      changed.surface->speed = std::copysign(value, scene.surface->speed);
      if (!scene.friction.by_slip_rate) changed.friction.time = scene.friction.length / value;
      break;
    case SweepChoice::Of::time:
      break;
  }
  SlidingLaw law = sliding_law(changed);
  if (choice.of == SweepChoice::Of::time) law.time = value;
  return law;
}

/// A mode found at one of the values.
struct Anchor {
  std::size_t at = 0;
  SlidingMode mode;
};

/// Follows a mode from its anchor both ways; each step starts where the last two point to.
ModePath follow(const SweepProblem& part, const std::vector<SlidingLaw>& laws, const Anchor& anchor) {
  const std::size_t count = laws.size();
  ModePath path{std::vector<Complex>(count, lost), std::vector<double>(count, lost.real())};
  for (const int way : {1, -1}) {
    ReducedMode mode{anchor.mode.exponent, part.part_of(anchor.mode.vector).normalized()};
    Complex before = mode.exponent;
    for (auto k = static_cast<std::ptrdiff_t>(anchor.at); k >= 0 && k < static_cast<std::ptrdiff_t>(count);
         k += way) {
      const auto at = static_cast<std::size_t>(k);
      const Complex here = mode.exponent;
      mode = nearest_mode(part.problem(), laws[at], 2.0 * here - before, mode.vector);
      if (!is_there(mode.exponent)) break;
      before = at == anchor.at ? mode.exponent : here;
      path.exponent[at] = mode.exponent;
      path.residual[at] = part.residual(laws[at], mode);
    }
  }
  return path;
}

void share(MPI_Comm comm, ModePath& path, int owner) {
  const auto count = static_cast<int>(path.exponent.size());
  MPI_Bcast(path.exponent.data(), count, MPI_CXX_DOUBLE_COMPLEX, owner, comm);
  MPI_Bcast(path.residual.data(), count, MPI_DOUBLE, owner, comm);
}

bool passes(const ModePath& path, std::size_t at, Complex p) {
  return is_there(path.exponent[at]) && std::abs(path.exponent[at] - p) <= same * std::abs(p);
}

/// Paths of all anchors, each once.
std::vector<ModePath> follow_all(MPI_Comm comm, const SweepProblem& part, const std::vector<SlidingLaw>& laws,
                                 const std::vector<Anchor>& anchors) {
  static const LogEvent event("ModesPaths");
  const LogEvent::Scope scope(event);
  std::vector<ModePath> paths;
  const int ranks = ranks_of(comm), rank = rank_of(comm);
  for (std::size_t begin = 0; begin < anchors.size();) {
    // Of one place at a time: those of the next may be on paths that are known then.
    std::size_t end = begin;
    std::vector<std::size_t> fresh;
    for (; end < anchors.size() && anchors[end].at == anchors[begin].at; ++end)
      if (std::ranges::none_of(paths, [&](const ModePath& path) {
            return passes(path, anchors[end].at, anchors[end].mode.exponent);
          }))
        fresh.push_back(end);
    std::vector<ModePath> found(fresh.size());
    for (std::size_t n = 0; n < fresh.size(); ++n) {
      const int owner = static_cast<int>(n) % ranks;
      if (owner == rank)
        found[n] = follow(part, laws, anchors[fresh[n]]);
      else
        found[n] = {std::vector<Complex>(laws.size()), std::vector<double>(laws.size())};
    }
    for (std::size_t n = 0; n < fresh.size(); ++n) share(comm, found[n], static_cast<int>(n) % ranks);
    paths.insert(paths.end(), found.begin(), found.end());
    begin = end;
  }
  return paths;
}

/// The value whose points have the largest residual.
std::size_t worst_place(const std::vector<ModePath>& paths, double& worst) {
  std::size_t place = 0;
  worst = 0;
  for (const ModePath& path : paths)
    for (std::size_t k = 0; k < path.residual.size(); ++k)
      if (path.residual[k] > worst) {
        worst = path.residual[k];
        place = k;
      }
  return place;
}

/// Vectors in the basis of the modes without friction, of which all others are made where friction is weak.
std::vector<Eigen::VectorXcd> real_vectors(const ModesBasis& basis, double to) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(basis.problem().stiffness);
  constexpr double somewhat = 1.05;
  std::vector<Eigen::VectorXcd> found;
  for (Eigen::Index k = 0; k < basis.size(); ++k)
    if (solver.eigenvalues()[k] <= std::pow(somewhat * 2 * std::numbers::pi * to, 2))
      found.push_back(solver.eigenvectors().col(k).cast<Complex>());
  return found;
}

/// Over which of the values the nodes that touch are those of the scene's own value: only the coefficient has
/// a part in the steady state. What lies between two values that keep the contact is taken to keep it.
void look_at_contact(const SlidingOperator& body, const SteadySliding& state, const Scene& scene,
                     ModesSweep& sweep) {
  const std::vector<double>& values = sweep.choice.values;
  const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
  if (sweep.choice.of != SweepChoice::Of::coefficient) {
    sweep.same_contact = {values.front(), values.back()};
    return;
  }
  const double own = scene.friction.coefficient;
  const auto keeps = [&](std::ptrdiff_t k) {
    Scene changed = scene;
    changed.friction.coefficient = values[static_cast<std::size_t>(k)];
    return changed.friction.coefficient == own || keeps_contact(body.comm(), body.model(), changed, state);
  };
  const auto nearest =
      std::ranges::min_element(values, {}, [&](double value) { return std::abs(value - own); }) -
      values.begin();
  if (keeps(nearest)) {
    const auto reach = [&](std::ptrdiff_t end) {
      if (end == nearest || keeps(end)) return end;
      std::ptrdiff_t in = nearest, out = end;
      while (std::abs(out - in) > 1) {
        const std::ptrdiff_t middle = (in + out) / 2;
        (keeps(middle) ? in : out) = middle;
      }
      return in;
    };
    for (const std::ptrdiff_t end : {std::ptrdiff_t{0}, last})
      sweep.same_contact.push_back(values[static_cast<std::size_t>(reach(end))]);
    if (sweep.same_contact[0] == values.front() && sweep.same_contact[1] == values.back()) return;
  }
  sweep.notes.push_back(
      format("along the sweep of the coefficient the nodes that touch are those of {:g} ", own) +
      (sweep.same_contact.empty()
           ? std::string("at none of the values")
           : format("from {:g} to {:g}", sweep.same_contact[0], sweep.same_contact[1])) +
      "; at the others nodes open or close, and the paths are those of a body whose contact stays: run such "
      "values "
      "on their own");
}

}  // namespace

ModesSweep sweep_modes(ModesBasis& basis, const SteadySliding& state, const Scene& scene,
                       const SweepChoice& choice, const SearchAim& asked) {
  ModesSweep sweep{choice, {}, {}, {}, 0, {}, 0};
  look_at_contact(basis.body(), state, scene, sweep);
  // No point is better than the rest of its path, and the basis knows the modes of the scene's own value.
  SearchAim aim = asked;
  aim.tolerance = std::max(aim.tolerance, tolerable / 10);
  aim.looks = 1;
  const std::size_t count = choice.values.size();
  std::vector<SlidingLaw> laws;
  for (std::size_t k = 0; k < count; ++k) laws.push_back(law_at(scene, choice, k));
  std::set<std::size_t> places;
  std::vector<Anchor> anchors;
  const auto find = [&](std::size_t at) {
    if (!places.insert(at).second) return;
    sweep.places.push_back(choice.values[at]);
    for (SlidingMode& mode : find_modes(basis, laws[at], aim).modes) anchors.push_back({at, std::move(mode)});
  };
  for (const std::size_t at : {count - 1, count / 2, std::size_t{0}}) find(at);
  while (!anchors.empty()) {
    std::vector<Eigen::VectorXcd> vectors = real_vectors(basis, aim.to);
    for (Anchor& anchor : anchors) {
      anchor.mode.vector.conservativeResizeLike(Eigen::VectorXcd::Zero(basis.size()));
      vectors.push_back(anchor.mode.vector);
    }
    const SweepProblem part(basis, vectors);
    sweep.basis = static_cast<PetscInt>(part.problem().size());
    sweep.paths = follow_all(basis.body().comm(), part, laws, anchors);
    const std::size_t next = worst_place(sweep.paths, sweep.worst);
    if (sweep.worst <= tolerable || sweep.places.size() >= most_places) break;
    // What the part does not hold there, and nothing else.
    std::vector<SlidingMode> poor;
    for (const ModePath& path : sweep.paths)
      if (path.residual[next] > aim.tolerance) poor.push_back({path.exponent[next], {}, 0});
    sweep.places.push_back(choice.values[next]);
    for (SlidingMode& mode : improve(basis, laws[next], std::move(poor), aim.tolerance).modes)
      if (is_there(mode.exponent)) anchors.push_back({next, std::move(mode)});
  }
  find_events(sweep);
  return sweep;
}

}  // namespace slipscale
