#include "slipscale/record/checkpoints.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"
#include "slipscale/base/readable.hpp"

namespace slipscale {
namespace {

constexpr double between_looks = 0.1;  // s
constexpr double wall_reserve = 2;     // s, for closing the files

}  // namespace

Checkpoints::Checkpoints(SlidingBody& body, Recorder& recorder, const StopRequest& request, SceneMarks marks,
                         const CheckpointChoice& choice)
    : body_(body),
      recorder_(recorder),
      marks_(std::move(marks)),
      choice_(choice),
      request_(request),
      next_look_(body.steps_done()),
      first_(body.steps_done()),
      begun_(seconds_since_start()),
      written_at_(begun_) {}

std::string Checkpoints::forecast() {
  std::vector<StateGroup> groups = body_.state();
  for (StateGroup& group : recorder_.state(body_.steps_done() - 1)) groups.push_back(std::move(group));
  const double bytes = state_bytes(body_.comm(), groups);
  if (!choice_.wanted()) return "";
  std::string when;
  if (choice_.minutes > 0) when = "every " + readable_duration(60 * choice_.minutes);
  if (choice_.every) when += format("{}every {} steps", when.empty() ? "" : " and ", *choice_.every);
  return "a checkpoint of " + readable_bytes(bytes) + " " + when + " and at the end; two are kept\n";
}

long Checkpoints::next_look(long n) const {
  const double pace = (seconds_since_start() - begun_) / static_cast<double>(n + 1 - first_);  // s a step
  const double steps = std::clamp(between_looks / std::max(pace, 1e-12), 1.0, 1e9);
  return n + static_cast<long>(steps);
}

void Checkpoints::look(long n) {
  enum { signal, due, late, next, count };
  std::array<long, count> seen{request_.signal(), 0, 0, std::numeric_limits<long>::min()};
  if (is_root(body_.comm())) {
    const double now = seconds_since_start();
    seen[due] = choice_.minutes > 0 && now - written_at_ >= 60 * choice_.minutes;
    seen[late] =
        choice_.wall && now + 2 * between_looks + 1.5 * longest_write_ + wall_reserve >= 60 * *choice_.wall;
    seen[next] = next_look(n);
  }
  MPI_Allreduce(MPI_IN_PLACE, seen.data(), count, MPI_LONG, MPI_MAX, body_.comm());
  next_look_ = seen[next];
  if (choice_.every) {
    if (n % *choice_.every == 0) seen[due] = 1;
    next_look_ = std::min(next_look_, (n / *choice_.every + 1) * *choice_.every);
  }
  if (n == recorder_.time().count) return;  // what is left is less than what a restart would do again
  if (seen[signal] != 0) interrupt(n, signal_name(static_cast<int>(seen[signal])));
  if (seen[late] != 0) interrupt(n, format("-time_wall {:g} min", *choice_.wall));
  if (seen[due] != 0) write(n, true);
}

void Checkpoints::write(long n, bool sync) {
  const double start = seconds_since_start();
  if (sync) recorder_.sync();
  std::vector<StateGroup> groups = body_.state();
  for (StateGroup& group : recorder_.state(n)) groups.push_back(std::move(group));
  write_checkpoint(body_.comm(), recorder_.folder(), marks_, groups, sync);
  written_at_ = seconds_since_start();
  longest_write_ = std::max(longest_write_, written_at_ - start);
}

void Checkpoints::interrupt(long n, const std::string& why) {
  write(n, true);
  const int ranks = ranks_of(body_.comm());
  const std::string command =
      (ranks > 1 ? format("mpirun -n {} ", ranks) : "") + "slide -restart " + recorder_.folder();
  (void)recorder_.interrupt(why, command);
  throw Interruption(format("interrupted by {} after step {} of {} (t = {:g} s); go on with: {}", why, n,
                            recorder_.time().count, body_.time(), command));
}

void Checkpoints::finish(long n) {
  if (choice_.wanted() || first_ > 0) write(n, false);  // one that a restart began from would be out of date
}

}  // namespace slipscale
