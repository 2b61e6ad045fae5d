#include "slipscale/modes/modes_choice.hpp"

#include <cmath>
#include <cstdlib>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

const Range tolerable{"> 0 and <= 0.01", [](double x) { return x > 0 && x <= 0.01; }};

constexpr double most_values = 10000;

/// a:d:b, from a in steps of d to b, which is among the values when the steps meet it.
std::vector<double> values_of(const std::string& option, const std::string& text) {
  const auto refuse = [&](const std::string& fault) {
    throw UserError("-" + option + " is '" + text + "', " + fault +
                    "; give first:step:last with first < last, like 0:0.02:1");
  };
  double numbers[3];
  const char* at = text.c_str();
  for (int k = 0; k < 3; ++k) {
    char* end = nullptr;
    numbers[k] = std::strtod(at, &end);
    if (end == at || *end != (k < 2 ? ':' : '\0') || !std::isfinite(numbers[k]))
      refuse("which is not three numbers with colons between");
    at = end + 1;
  }
  const double first = numbers[0], step = numbers[1], last = numbers[2];
  if (!(step > 0) || !(last > first)) refuse("which does not ascend");
  if (first < 0) refuse("which has values below 0");
  const double count = std::floor((last - first) / step * (1 + 1e-12) + 1e-9) + 1;
  if (count > most_values) refuse(format("which has {:g} values, more than {:g}", count, most_values));
  std::vector<double> values;
  for (int k = 0; k < static_cast<int>(count); ++k) values.push_back(first + k * step);
  return values;
}

}  // namespace

Schema modes_schema() {
  return {
      {"modes_count", Kind::integer, "1", "10", range::at_least_one,
       "how many modes are reported, those that grow fastest"},
      {"modes_to", Kind::real, "Hz", required, range::positive, "highest frequency that is looked at"},
      {"modes_tolerance", Kind::real, "1", "1e-10", tolerable,
       "residual of every reported mode on the whole body, relative"},
      {"modes_basis", Kind::integer, "1", absent, range::at_least_one,
       "real modes that the search starts from; when not given all below 1.4 times modes_to, below twice of "
       "it where friction has little memory"},
      {"modes_scheme",
       Kind::flag,
       "",
       "false",
       {},
       "besides, the eigenvalues of the time scheme at the scene's step, which is what slide shows"},
      {"modes_coefficient", Kind::text, "1", absent, range::any,
       "first:step:last, a sweep of the coefficient of friction, which every mode is followed along; the "
       "nodes that "
       "touch stay those of the scene's own value, and where others would open or close is told"},
      {"modes_time", Kind::text, "s", absent, range::any,
       "first:step:last, a sweep of the relaxation time T of regularized friction"},
      {"modes_load_speed", Kind::text, "m/s", absent, range::any,
       "first:step:last, a sweep of the speed of the surface under the same load, which makes T from a "
       "length"},
      {"modes_shapes", Kind::integer, "1", "6", range::non_negative,
       "how many of the modes have their shapes in modes.h5"},
      {"modes_frames", Kind::integer, "1", "12", range::at_least_one, "frames of a period in modes.xdmf"},
  };
}

ModesChoice read_modes(const Options& options) {
  ModesChoice choice;
  choice.count = static_cast<int>(options.integer("modes_count"));
  choice.to = options.real("modes_to");
  choice.tolerance = options.real("modes_tolerance");
  if (const auto basis = options.find_integer("modes_basis")) choice.basis = static_cast<int>(*basis);
  choice.scheme = options.flag("modes_scheme");
  choice.shapes = static_cast<int>(options.integer("modes_shapes"));
  choice.frames = static_cast<int>(options.integer("modes_frames"));
  choice.folder = options.text("output_folder");
  return choice;
}

void read_sweeps(const Options& options, const Scene& scene, ModesChoice& choice) {
  using Of = SweepChoice::Of;
  const auto add = [&](Of of, const std::string& name, const std::string& unit) {
    if (const auto text = options.find_text("modes_" + name))
      choice.sweeps.push_back({of, name, unit, values_of("modes_" + name, *text)});
  };
  add(Of::coefficient, "coefficient", "1");
  const FrictionChoice& friction = scene.friction;
  for (const char* name : {"modes_coefficient", "modes_load_speed"})
    if (options.given(name) && friction.varies())
      throw UserError(
          "-" + std::string(name) +
          " follows modes of one law of friction, but that of this scene varies along the contact; "
          "run modes for each value");
  if (friction.law == FrictionChoice::Law::exponential) {
    for (const char* name : {"modes_coefficient", "modes_time", "modes_load_speed"})
      if (options.given(name))
        throw UserError("-" + std::string(name) +
                        " follows modes whose friction depends on pressure alone, but that of -friction_law "
                        "exponential depends on the slip rate; run modes for each value");
    return;
  }
  if (friction.law != FrictionChoice::Law::regularized)
    options.refuse_idle({"modes_time", "modes_load_speed"},
                        {"without a memory of friction", "give -friction_law regularized", {"friction_law"}});
  else
    add(Of::time, "time", "s");
  if (friction.law != FrictionChoice::Law::regularized) return;
  if (friction.length > 0)
    add(Of::speed, "load_speed", "m/s");
  else
    options.refuse_idle({"modes_load_speed"}, {"with -friction_time, which does not depend on the speed",
                                               "give -friction_length in its place",
                                               {"friction_time"}});
  for (const SweepChoice& sweep : choice.sweeps)
    if (sweep.of == Of::speed && sweep.values.front() == 0 && !friction.by_slip_rate)
      throw UserError("-modes_load_speed begins with 0, where nothing slides; begin above");
}

}  // namespace slipscale
