#include "slipscale/modes/mode_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "inner.hpp"
#include "slipscale/base/log.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "sweep_problem.hpp"

namespace slipscale {
namespace {

constexpr int most_rounds = 40;
constexpr int most_in_vain = 4;             ///< rounds without half the residual
constexpr double of_largest = 1e-2;         ///< directions of less than this part of the residuals wait
constexpr double of_column = 1e-5;          ///< of a new direction: what must be new of it
constexpr double same = 1e-6;               ///< exponents that are one, relative
constexpr double parallel = 0.9999;         ///< cosine of vectors that are one
constexpr std::size_t at_once = 20;         ///< modes whose residuals are held in memory
constexpr Eigen::Index most_vectors = 400;  ///< of a companion matrix, which has three times as many rows

bool is_number(const SlidingMode& mode) { return std::isfinite(std::norm(mode.exponent)); }

/// The vector in a basis that has grown.
void fill_up(Eigen::VectorXcd& vector, Eigen::Index size) {
  const Eigen::Index old = vector.size();
  vector.conservativeResize(size);
  vector.tail(size - old).setZero();
}

/// Newton's method for the modes of a list, shared out among the ranks.
void find_again(MPI_Comm comm, const ReducedProblem& problem, const SlidingLaw& law,
                std::vector<SlidingMode>& modes, const std::vector<std::size_t>& which) {
  static const LogEvent event("ModesNewton");
  const LogEvent::Scope scope(event);
  const auto ranks = static_cast<std::size_t>(ranks_of(comm)), rank = static_cast<std::size_t>(rank_of(comm));
  for (std::size_t n = rank; n < which.size(); n += ranks) {
    SlidingMode& mode = modes[which[n]];
    const bool known = mode.vector.size() > 0;
    if (known) fill_up(mode.vector, problem.size());
    const ReducedMode found = nearest_mode(problem, law, mode.exponent, mode.vector,
                                           known ? 0 : 0.37 * static_cast<double>(which[n]));
    mode.exponent = found.exponent;
    mode.vector = found.vector;
    if (mode.exponent.imag() >= 0) continue;
    mode.exponent = std::conj(mode.exponent);
    mode.vector = mode.vector.conjugate().eval();
  }
  for (std::size_t n = 0; n < which.size(); ++n) {
    SlidingMode& mode = modes[which[n]];
    mode.vector.conservativeResize(problem.size());
    const int owner = static_cast<int>(n % ranks);
    MPI_Bcast(&mode.exponent, 1, MPI_CXX_DOUBLE_COMPLEX, owner, comm);
    MPI_Bcast(mode.vector.data(), static_cast<int>(mode.vector.size()), MPI_CXX_DOUBLE_COMPLEX, owner, comm);
  }
}

/// The directions that residuals have, but for what is little beside the largest. Columns of length 1.
Columns main_directions(MPI_Comm comm, const Column& mass, const Columns& residuals) {
  const Eigen::MatrixXd gram = inner(comm, residuals, mass.cwiseInverse().asDiagonal() * residuals);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  const Eigen::VectorXd& value = solver.eigenvalues();
  const double least = of_largest * of_largest * value[value.size() - 1];
  const auto kept = (value.array() > least).count();
  return residuals *
         (solver.eigenvectors().rightCols(kept) * value.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal());
}

bool is_known(const std::vector<SlidingMode>& modes, Complex p) {
  return std::ranges::any_of(
      modes, [&](const SlidingMode& mode) { return std::abs(mode.exponent - p) <= same * std::abs(p); });
}

/// The same vector as well: more than one mode may have the same exponent.
bool is_known(const std::vector<SlidingMode>& modes, const SlidingMode& found) {
  return std::ranges::any_of(modes, [&](const SlidingMode& mode) {
    const Eigen::Index size = std::min(mode.vector.size(), found.vector.size());
    return std::abs(mode.exponent - found.exponent) <= same * std::abs(found.exponent) &&
           std::abs(mode.vector.head(size).dot(found.vector.head(size))) > parallel;
  });
}

double frequency_of(Complex p) { return p.imag() / (2 * std::numbers::pi); }

/// Growth descending; where it differs by rounding alone, as of modes that neither grow nor decay, frequency
/// ascending, so that the order does not depend on the number of ranks.
class Order {
 public:
  explicit Order(double to) : unit_(rounding * 2 * std::numbers::pi * to) {}
  bool operator()(const Complex& a, const Complex& b) const {
    const double one = std::round(a.real() / unit_), other = std::round(b.real() / unit_);
    return one != other ? one > other : a.imag() < b.imag();
  }

 private:
  static constexpr double rounding = 1e-8;
  double unit_;
};

/// Not the memory of friction, or damping, that dies away before a period is over; what creeps away counts.
bool is_vibration(Complex p) { return p.real() > -p.imag(); }

/// Where all eigenvalues are looked for: the basis, or of a large one a part that holds the modes that are
/// known and, for those that are not, what moves slowly.
struct Place {
  Eigen::MatrixXd part;  ///< [basis, part], orthonormal; empty: the basis itself
  ReducedProblem problem;
};

Place place_of(const ReducedProblem& problem, const std::vector<SlidingMode>& known, bool whole) {
  const Eigen::Index size = problem.size();
  if (whole || size <= most_vectors) return {{}, problem};
  const Eigen::Index of_known = 2 * std::min(static_cast<Eigen::Index>(known.size()), most_vectors / 4);
  Eigen::MatrixXd vectors = Eigen::MatrixXd::Zero(size, most_vectors);
  for (Eigen::Index k = 0; k < of_known; k += 2) {
    const Eigen::VectorXcd& y = known[static_cast<std::size_t>(k / 2)].vector;
    vectors.col(k).head(y.size()) = y.real();
    vectors.col(k + 1).head(y.size()) = y.imag();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> slow(problem.stiffness);
  vectors.rightCols(most_vectors - of_known) = slow.eigenvectors().leftCols(most_vectors - of_known);
  Place place{orthonormal_part(vectors), {}};
  place.problem = problem.part(place.part);
  return place;
}

void share(MPI_Comm comm, Eigen::MatrixXd& matrix) {
  Eigen::Index size[] = {matrix.rows(), matrix.cols()};
  MPI_Bcast(size, 2 * sizeof(Eigen::Index), MPI_BYTE, 0, comm);
  matrix.resize(size[0], size[1]);
  MPI_Bcast(matrix.data(), static_cast<int>(matrix.size()), MPI_DOUBLE, 0, comm);
}

/// Modes that are looked for, growth descending, those that are not yet known: of a large basis with their
/// vectors. `whole`: of the basis as it is, which a start has to be. Found by the first rank.
struct Candidates {
  std::vector<SlidingMode> fresh;
  std::size_t in_window = 0;
};

Candidates candidates(MPI_Comm comm, const ReducedProblem& problem, const SlidingLaw& law, double to,
                      const std::vector<SlidingMode>& known, std::size_t looked_at, bool whole) {
  static const LogEvent event("ModesCompanion");
  const LogEvent::Scope scope(event);
  Place place;
  std::vector<Complex> found;
  if (is_root(comm)) {
    place = place_of(problem, known, whole);
    found = all_exponents(place.problem, law);
    std::erase_if(found, [&](const Complex& p) { return !is_vibration(p) || frequency_of(p) > to; });
    std::ranges::sort(found, Order(to));
  }
  std::size_t count = found.size();
  MPI_Bcast(&count, sizeof count, MPI_BYTE, 0, comm);
  found.resize(count);
  MPI_Bcast(found.data(), static_cast<int>(count), MPI_CXX_DOUBLE_COMPLEX, 0, comm);
  for (Eigen::MatrixXd* matrix :
       {&place.part, &place.problem.stiffness, &place.problem.friction, &place.problem.slip})
    share(comm, *matrix);
  Candidates list{{}, count};
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < std::min(count, looked_at); ++k)
    if (!is_known(known, found[k])) {
      all.push_back(all.size());
      list.fresh.push_back({found[k], {}, 0});
    }
  if (place.part.size() == 0) return list;
  find_again(comm, place.problem, law, list.fresh, all);
  std::erase_if(list.fresh, [](const SlidingMode& mode) { return !is_number(mode); });
  for (SlidingMode& mode : list.fresh) mode.vector = (place.part * mode.vector).eval();
  return list;
}

}  // namespace

ModesFound improve(ModesBasis& basis, const SlidingLaw& law, std::vector<SlidingMode> modes,
                   double tolerance) {
  const MPI_Comm comm = basis.body().comm();
  ModesFound found;
  std::vector<std::size_t> open(modes.size());
  for (std::size_t k = 0; k < modes.size(); ++k) open[k] = k;
  double best = 1e300;
  for (int in_vain = 0; !open.empty() && found.rounds < most_rounds && in_vain < most_in_vain;) {
    find_again(comm, basis.problem(), law, modes, open);
    std::erase_if(open, [&](std::size_t k) { return !is_number(modes[k]); });
    double worst = 0;
    Eigen::Index added = 0;
    std::vector<std::size_t> still;
    for (std::size_t begin = 0; begin < open.size(); begin += at_once) {
      const std::size_t end = std::min(open.size(), begin + at_once);
      Columns residuals(basis.body().free().size(), 2 * static_cast<Eigen::Index>(end - begin));
      Eigen::Index columns = 0;
      Eigen::MatrixXcd vectors(basis.size(), static_cast<Eigen::Index>(end - begin));
      for (std::size_t n = begin; n < end; ++n) {
        fill_up(modes[open[n]].vector, basis.size());
        vectors.col(static_cast<Eigen::Index>(n - begin)) = modes[open[n]].vector;
      }
      const Columns shapes = basis.shape_of(vectors);  // in one go: the basis is read from memory once
      for (std::size_t n = begin; n < end; ++n) {
        SlidingMode& mode = modes[open[n]];
        const auto residual =
            basis.residual(law, mode, shapes.middleCols(2 * static_cast<Eigen::Index>(n - begin), 2));
        mode.residual = residual.size;
        if (residual.size <= tolerance) continue;
        worst = std::max(worst, residual.size);
        residuals.middleCols(columns, 2) = residual.force / residual.size;
        columns += 2;
        still.push_back(open[n]);
      }
      if (columns == 0) continue;
      residuals.conservativeResize(Eigen::NoChange, columns);
      residuals = main_directions(comm, basis.body().free().mass(), residuals);
      found.solves += static_cast<int>(residuals.cols());
      added += basis.add(basis.body().solve(residuals), of_column);
    }
    open = still;
    if (open.empty()) break;
    in_vain = worst < 0.5 * best ? 0 : in_vain + 1;
    best = std::min(best, worst);
    ++found.rounds;
    if (added == 0) break;
  }
  for (SlidingMode& mode : modes)
    if (is_number(mode)) fill_up(mode.vector, basis.size());
  found.modes = std::move(modes);
  return found;
}

ModesFound find_modes(ModesBasis& basis, const SlidingLaw& law, const SearchAim& aim) {
  ModesFound all;
  const auto wanted = static_cast<std::size_t>(aim.count);
  // More than wanted are improved: the order may change.
  const std::size_t looked_at = wanted + std::max<std::size_t>(2, wanted / 8);
  for (int look = 0; look < aim.looks; ++look) {
    Candidates here = candidates(basis.body().comm(), basis.problem(), law, 1.01 * aim.to, all.modes,
                                 looked_at, look == 0 && aim.looks > 1);
    all.in_window = here.in_window;
    if (here.fresh.empty()) break;
    ModesFound found = improve(basis, law, std::move(here.fresh), aim.tolerance);
    all.rounds += found.rounds;
    all.solves += found.solves;
    for (SlidingMode& mode : found.modes)
      if (is_number(mode) && !is_known(all.modes, mode)) all.modes.push_back(std::move(mode));
  }
  std::erase_if(all.modes, [&](const SlidingMode& mode) {
    return !is_vibration(mode.exponent) || frequency_of(mode.exponent) > aim.to;
  });
  std::ranges::sort(all.modes, Order(aim.to), &SlidingMode::exponent);
  if (all.modes.size() > wanted) all.modes.resize(wanted);
  for (SlidingMode& mode : all.modes) fill_up(mode.vector, basis.size());
  for (const SlidingMode& mode : all.modes)
    if (mode.residual > aim.tolerance)
      all.notes.push_back(
          format("the mode of {:.6g} Hz has a residual of {:.2g}, above -modes_tolerance {:g}: rounding or a "
                 "cluster of modes allows no less; give a larger tolerance or a larger -modes_basis",
                 frequency_of(mode.exponent), mode.residual, aim.tolerance));
  return all;
}

}  // namespace slipscale
