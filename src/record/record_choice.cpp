#include "slipscale/record/record_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/contact/surface.hpp"

namespace slipscale {
namespace {

const Range at_least_half{">= 0.5 and <= 1", [](double x) { return x >= 0.5 && x <= 1; }};

/// A number of steps, or nothing for `auto`.
std::optional<long> steps_or_auto(const Options& options, const std::string& name) {
  const std::string text = options.text(name);
  if (text == "auto") return std::nullopt;
  const double steps = std::strtod(text.c_str(), nullptr);
  if (steps != std::floor(steps) || steps > 1e15)
    throw UserError(format("-{} is {:g}, but it must be auto or a whole number of steps", name, steps));
  return static_cast<long>(steps);
}

/// The two options that say how often something is recorded. `every`: kind, range, default and help of that
/// in steps; the other is like it.
Schema cadence_schema(const std::string& what, Option every) {
  every.name = what + "_every";
  return {every,
          {what + "_interval", Kind::real, "s", absent, range::positive,
           "time between them, in place of " + every.name + "; rounded to whole steps"}};
}

/// Of a file whose rows are about a thousand by default.
Schema thousand_rows(const std::string& what, const std::string& file) {
  return cadence_schema(what,
                        {"", Kind::text, "1", "auto", range::one_of_or_number({"auto"}, range::at_least_one),
                         "steps between the rows of " + file +
                             "; auto makes about a thousand rows, in a short run one in 25 steps, and a "
                             "restart with a later end keeps their distance"});
}

/// -<what>_every, which may have a default, or -<what>_interval.
Cadence read_cadence(const Options& options, const std::string& what,
                     const std::function<std::optional<long>(const std::string&)>& every) {
  Cadence cadence{{}, {}, what + "_interval"};
  options.refuse_both(what + "_every", cadence.option);
  cadence.interval = options.find_real(cadence.option);
  if (!cadence.interval) cadence.every = every(what + "_every");
  return cadence;
}

std::vector<Vector2> read_points(const Options& options) {
  const auto numbers = options.reals("history_points");
  if (numbers.size() % 2 != 0)
    throw UserError("-history_points has an odd count of numbers; give x1,y1,x2,y2,... in m");
  std::vector<Vector2> points;
  for (std::size_t k = 0; k < numbers.size(); k += 2) points.push_back({numbers[k], numbers[k + 1]});
  return points;
}

std::optional<Box> read_box(const Options& options) {
  const auto numbers = options.reals("fields_box");
  if (numbers.empty()) return std::nullopt;
  if (numbers.size() != 4)
    throw UserError(format("-fields_box has {} numbers; give two corners, x1,y1,x2,y2 in m", numbers.size()));
  const Box box{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
  for (int d = 0; d < 2; ++d)
    if (!(box.lower[d] < box.upper[d]))
      throw UserError(format("-fields_box goes from {} = {:g} to {:g} m; give the lower left corner first",
                             "xy"[d], box.lower[d], box.upper[d]));
  return box;
}

void read_fields(const Options& options, RecordChoice& choice) {
  options.refuse_both("fields_every", "fields_times");
  options.refuse_both("fields_interval", "fields_times");
  choice.fields = read_cadence(options, "fields", [&](const std::string& name) {
    const auto every = options.find_integer(name);
    return every ? std::optional<long>(static_cast<long>(*every)) : std::nullopt;
  });
  choice.fields_times = options.reals("fields_times");
  if (choice.fields.given() || !choice.fields_times.empty()) {
    choice.quantities = field_quantities(options.text("fields_quantities"));
    choice.fields_box = read_box(options);
  } else {
    options.refuse_idle({"fields_quantities", "fields_box"},
                        {"without -fields_every, -fields_interval or -fields_times", "give one of them"});
  }
}

std::optional<StatisticsChoice> read_statistics(const Options& options) {
  const auto from = options.find_real("statistics_from");
  if (!from) {
    options.refuse_idle({"statistics_to", "statistics_every", "statistics_quantile", "statistics_damping"},
                        {"without -statistics_from", "give the start of the window"});
    return std::nullopt;
  }
  return StatisticsChoice{*from, options.find_real("statistics_to"),
                          steps_or_auto(options, "statistics_every"), options.real("statistics_quantile"),
                          options.flag("statistics_damping")};
}

}  // namespace

long Cadence::steps(double step, long otherwise) const {
  if (every) return *every;
  if (!interval) return otherwise;
  if (*interval < 0.999 * step)
    throw UserError(
        format("-{} is {:g} s, less than the step of {:g} s; give at least that", option, *interval, step));
  return std::max(1L, std::lround(*interval / step));
}

Schema record_schema() {
  const Schema own = {
      {"output_folder", Kind::text, "", "out", range::any,
       "folder of the run; an older run in it is replaced once the scene has proved right, and kept in its "
       "folder `replaced` if it was interrupted and could go on"},
      {"history_points", Kind::reals, "m", absent, range::any,
       "points x1,y1,x2,y2,... whose u, v and stress are followed"},
      {"history_momentum",
       Kind::flag,
       "",
       "false",
       {},
       "whether history.h5 has rows of the body's linear and angular momentum, and of rigid sides"},
      {"contact_sums",
       Kind::flag,
       "",
       "true",
       {},
       "whether contact.h5 has friction work, slip distance, time closed, impulse and closures of each node, "
       "summed over every step and not only those of its rows; slipscale wear reads them"},
      {"fields_times", Kind::reals, "s", absent, range::any, "times of the frames, in place of fields_every"},
      {"fields_quantities", Kind::text, "", "u,v,stress", range::any,
       "what a frame holds: some of u,v,stress,strain,von_mises,principal,damping_work; the last, energy "
       "that bulk damping took in each cell since t = 0, is summed cell by cell at every step, which then "
       "takes several times as long"},
      {"fields_box", Kind::reals, "m", absent, range::any,
       "x1,y1,x2,y2: a frame holds only the cells whose centres lie in this rectangle"},
      {"statistics_from", Kind::real, "s", absent, range::non_negative,
       "start of the window over which statistics.h5 takes means, extremes and quantiles of stress and "
       "strain"},
      {"statistics_to", Kind::real, "s", absent, range::non_negative,
       "end of that window; the end of the run when not given"},
      {"statistics_every", Kind::text, "1", "auto", range::one_of_or_number({"auto"}, range::at_least_one),
       "samples are the multiples of this step in the window; auto takes about a thousand"},
      {"statistics_quantile", Kind::real, "1", "0.99", at_least_half,
       "part of the samples that lies below quantile_high, and above quantile_low"},
      {"statistics_damping",
       Kind::flag,
       "",
       "false",
       {},
       "whether statistics.h5 has the mean power of bulk damping in each cell; summed at every step, which "
       "then takes several times as long"},
      {"checkpoint_minutes", Kind::real, "min", "15", range::non_negative,
       "wall time between checkpoints, from which -restart goes on; the last two are kept, one more is left "
       "at "
       "the end; 0 writes none, but at a signal"},
      {"checkpoint_every", Kind::integer, "1", absent, range::at_least_one,
       "steps between checkpoints, besides those by time"},
      {"time_wall", Kind::real, "min", absent, range::positive,
       "wall time after which the run must have ended: it stops before, with a checkpoint and exit code 3"},
      {"restart", Kind::text, "", absent, range::any,
       "output folder of a run to go on with, on any number of ranks: alone, or with a later -time_end, "
       "other "
       "steps or intervals of output, -checkpoint_... and -time_wall"},
      {"progress", Kind::text, "", "auto", range::one_of({"auto", "none"}),
       "auto shows a line of progress when the output is a terminal"},
      {"run_<entry>", Kind::text, "", absent, range::any,
       "facts that run.yaml carries; ignored when it is read again"},
  };
  return interface_schema() + thousand_rows("interfaces", "interfaces.h5") +
         cadence_schema("history", {"", Kind::integer, "1", "25", range::at_least_one,
                                    "steps between the rows of history.h5"}) +
         thousand_rows("contact", "contact.h5") +
         cadence_schema("fields", {"", Kind::integer, "1", absent, range::at_least_one,
                                   "steps between the frames of fields.h5"}) +
         own;
}

RecordChoice read_record(const Options& options) {
  RecordChoice choice;
  choice.folder = options.text("output_folder");
  choice.history = read_cadence(options, "history", [&](const std::string& name) {
    return std::optional<long>(static_cast<long>(options.integer(name)));
  });
  choice.points = read_points(options);
  choice.momentum = options.flag("history_momentum");
  if (has_surface(options)) {
    choice.contact = read_cadence(options, "contact",
                                  [&](const std::string& name) { return steps_or_auto(options, name); });
    choice.contact_sums = options.flag("contact_sums");
  } else {
    options.refuse_idle({"contact_every", "contact_interval", "contact_sums"}, without_surface);
  }
  choice.interfaces = read_interfaces(options, {"interfaces_every", "interfaces_interval"});
  if (choice.interfaces)
    choice.interface_rows = read_cadence(
        options, "interfaces", [&](const std::string& name) { return steps_or_auto(options, name); });
  read_fields(options, choice);
  choice.statistics = read_statistics(options);
  choice.progress = options.text("progress");
  choice.checkpoint.minutes = options.real("checkpoint_minutes");
  if (const auto every = options.find_integer("checkpoint_every"))
    choice.checkpoint.every = static_cast<long>(*every);
  choice.checkpoint.wall = options.find_real("time_wall");
  choice.restart = options.find_text("restart");
  return choice;
}

}  // namespace slipscale
