#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "slipscale/dynamics/model.hpp"

namespace slipscale {
namespace {

/// M^{-1/2} K M^{-1/2} on the owned nodes of all ranks.
class ScaledStiffness {
 public:
  ScaledStiffness(MPI_Comm comm, const Model& model)
      : comm_(comm), model_(model), x_(comm, model.mesh.nodes, true), force_(model.mesh.nodes.number.size()) {
    for (const double m : model.mass) scale_.push_back(1 / std::sqrt(m));
  }

  void multiply(const std::vector<Vector2>& in, std::vector<Vector2>& out) {
    for (std::size_t i = 0; i < in.size(); ++i) x_.data()[i] = {scale_[i] * in[i][0], scale_[i] * in[i][1]};
    x_.begin_update();
    x_.end_update();
    model_.multiply(x_.data(), force_.data());
    for (std::size_t i = 0; i < in.size(); ++i) out[i] = {scale_[i] * force_[i][0], scale_[i] * force_[i][1]};
  }

  double dot(const std::vector<Vector2>& a, const std::vector<Vector2>& b) const {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i][0] * b[i][0] + a[i][1] * b[i][1];
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm_);
    return sum;
  }

 private:
  MPI_Comm comm_;
  const Model& model_;
  NodalVector x_;
  std::vector<Vector2> force_;
  std::vector<double> scale_;
};

/// A start vector that depends on the node's number only; rough, so that it holds the highest mode.
std::vector<Vector2> start_vector(const Nodes& nodes) {
  std::vector<Vector2> q(static_cast<std::size_t>(nodes.owned));
  for (int i = 0; i < nodes.owned; ++i) {
    const auto n = static_cast<double>(nodes.number[i] % 1000003);
    q[i] = {std::sin(12.9898 * n + 1), std::sin(78.233 * n + 2)};
  }
  return q;
}

struct Ritz {
  double value, residual;
};

/// The largest eigenvalue of the Lanczos tridiagonal matrix and the residual of its Ritz vector, for which
/// the last components of the eigenvectors are enough: the implicit QL method (EISPACK's IMTQL2) with one row
/// of the vectors.
Ritz largest_ritz(std::vector<double> d, std::vector<double> e) {
  const auto n = static_cast<int>(d.size());
  const double last = e.back();
  std::vector<double> row(d.size(), 0);
  row.back() = 1;
  const auto split = [&](int k) {  // whether the matrix falls apart behind k
    const double size = std::abs(d[k]) + std::abs(d[k + 1]);
    return std::abs(e[k]) <= std::numeric_limits<double>::epsilon() * size;
  };
  for (int l = 0; l < n; ++l)
    for (int sweep = 0; sweep < 60; ++sweep) {
      int m = l;
      while (m < n - 1 && !split(m)) ++m;
      if (m == l) break;
      double g = (d[l + 1] - d[l]) / (2 * e[l]), r = std::hypot(g, 1);
      g = d[m] - d[l] + e[l] / (g + std::copysign(r, g));
      double sine = 1, cosine = 1, p = 0;
      int i = m - 1;
      for (; i >= l; --i) {
        const double f = sine * e[i], b = cosine * e[i];
        r = std::hypot(f, g);
        e[i + 1] = r;
        if (r == 0) break;
        sine = f / r, cosine = g / r;
        g = d[i + 1] - p;
        r = (d[i] - g) * sine + 2 * cosine * b;
        p = sine * r;
        d[i + 1] = g + p;
        g = cosine * r - b;
        const double above = row[i + 1];
        row[i + 1] = sine * row[i] + cosine * above;
        row[i] = cosine * row[i] - sine * above;
      }
      if (i >= l) {
        d[i + 1] -= p;
      } else {
        d[l] -= p;
        e[l] = g;
      }
      e[m] = 0;
    }
  const auto largest = std::max_element(d.begin(), d.end());
  return {*largest, last * std::abs(row[largest - d.begin()])};
}

Ritz lanczos(MPI_Comm comm, const Model& model, int most, double tolerance) {
  ScaledStiffness a(comm, model);
  std::vector<Vector2> q = start_vector(model.mesh.nodes), previous(q.size(), {0, 0}), r(q.size());
  double norm = std::sqrt(a.dot(q, q));
  for (auto& x : q) x = {x[0] / norm, x[1] / norm};
  std::vector<double> diagonal, beside;
  Ritz ritz{};
  for (int k = 0; k < most; ++k) {
    a.multiply(q, r);
    const double alpha = a.dot(q, r), beta = beside.empty() ? 0 : beside.back();
    for (std::size_t i = 0; i < q.size(); ++i)
      for (int axis = 0; axis < 2; ++axis) r[i][axis] -= alpha * q[i][axis] + beta * previous[i][axis];
    norm = std::sqrt(a.dot(r, r));
    diagonal.push_back(alpha);
    beside.push_back(norm);
    const bool exhausted = norm <= 1e-12 * alpha;  // a small mesh: the Krylov space is complete
    if (k % 10 == 9 || k + 1 == most || exhausted) {
      ritz = largest_ritz(diagonal, beside);
      if (exhausted || ritz.residual < tolerance * ritz.value) break;
    }
    previous = q;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = {r[i][0] / norm, r[i][1] / norm};
  }
  return ritz;
}

double round_up_to_four_digits(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 3);
  return std::ceil(x / unit * (1 - 1e-12)) * unit;
}

}  // namespace

FrequencyBounds largest_frequency(MPI_Comm comm, const Model& model) {
  const CriticalCell critical = critical_cell(comm, model.mesh, model.materials);
  const double safe = critical.eigenvalue;
  constexpr double unknown = std::numeric_limits<double>::infinity();
  if (!std::isfinite(safe)) return {unknown, unknown, critical};
  // Ritz values converge from below, so the residual is added as a margin; the element bound is never
  // exceeded.
  const Ritz ritz = lanczos(comm, model, 300, 1e-4);
  const double sharp = std::min(safe, ritz.value + ritz.residual);
  if (!std::isfinite(ritz.value + ritz.residual)) return {unknown, unknown, critical};
  return {round_up_to_four_digits(std::sqrt(sharp)), std::sqrt(safe), critical};
}

}  // namespace slipscale
