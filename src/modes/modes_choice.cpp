#include "slipscale/modes/modes_choice.hpp"

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

const Range tolerable{"> 0 and <= 0.01", [](double x) { return x > 0 && x <= 0.01; }};

}  // namespace

Schema modes_schema() {
  return {
      {"modes_count", Kind::integer, "1", "10", range::at_least_one,
       "how many modes are reported, those that grow fastest"},
      {"modes_to", Kind::real, "Hz", required, range::positive, "highest frequency that is looked at"},
      {"modes_tolerance", Kind::real, "1", "1e-10", tolerable,
       "residual of every reported mode on the whole body, relative"},
      {"modes_basis", Kind::integer, "1", absent, range::at_least_one,
       "real modes that the search starts from; all below twice modes_to when not given"},
      {"modes_scheme",
       Kind::flag,
       "",
       "false",
       {},
       "besides, the eigenvalues of the time scheme at the scene's step, which is what slide shows"},
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

}  // namespace slipscale
