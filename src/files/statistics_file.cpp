#include "slipscale/files/statistics_file.hpp"

#include <cmath>

#include "slipscale/base/print.hpp"
#include "slipscale/files/mesh_group.hpp"
#include "slipscale/files/xdmf.hpp"

namespace slipscale {
namespace {

struct Quantity {
  std::string name, units;
};
const Quantity quantities[] = {{"stress", "Pa"}, {"strain", "1"}};

/// A statistic that is a tensor again.
struct Statistic {
  std::string name, text;
  std::vector<double> FieldStatistics::*values;
};

std::vector<Statistic> tails(double quantile) {
  const std::string part = format("{:g}", quantile), rest = format("{:g}", 1 - quantile);
  return {{"lowest", "lowest value, peak compression", &FieldStatistics::lowest},
          {"highest", "highest value, peak tension", &FieldStatistics::highest},
          {"quantile_low", rest + " quantile", &FieldStatistics::quantile_low},
          {"quantile_high", part + " quantile", &FieldStatistics::quantile_high}};
}

std::vector<double> deviation(const std::vector<double>& covariance) {
  std::vector<double> roots;
  for (std::size_t place = 0; place < covariance.size() / 6; ++place)
    for (std::size_t i = 0; i < 3; ++i) roots.push_back(std::sqrt(covariance[6 * place + i]));
  return roots;
}

/// Returns what XDMF shows of it.
std::vector<XdmfAttribute> write(SharedFile& file, const MeshLayout& mesh, const FileOrder& cells,
                                 const StatisticsSample& sample, const Quantity& quantity,
                                 const FieldStatistics& found) {
  const std::string group = "/statistics/" + quantity.name + "/", of = " of the " + quantity.name;
  const std::string components = "; xx, yy and xy", &units = quantity.units;
  std::vector<XdmfAttribute> shown;
  const auto add = [&](const std::string& name, const std::string& text, const std::vector<double>& values) {
    file.write({group + name, units, text + of + components}, cells, {3}, values.data());
    const auto parts = write_components(file, mesh, {group + name, units, "the " + text + of}, {3},
                                        {"xx", "yy", "xy"}, quantity.name + "_" + name);
    shown.insert(shown.end(), parts.begin(), parts.end());
  };
  add("mean", "time mean", found.mean);
  add("deviation", "standard deviation", deviation(found.covariance));
  file.write({group + "covariance", units == "1" ? "1" : units + "2",
              "covariance" + of + "; xx.xx, yy.yy, xy.xy, yy.xy, xx.xy and xx.yy"},
             cells, {6}, found.covariance.data());
  if (sample.tails)
    for (const Statistic& each : tails(sample.quantile)) add(each.name, each.text, found.*each.values);
  return shown;
}

}  // namespace

void write_statistics(MPI_Comm comm, const MeshImage& image, const StatisticsSample& sample,
                      const FieldStatistics& stress, const FieldStatistics& strain, const std::string& folder,
                      const std::string& name, const std::optional<std::vector<double>>& damping_power) {
  SharedFile file(comm, folder + "/" + name + ".h5",
                  statistics_bytes(image.points().total(), image.cells().total()));
  const MeshLayout layout = write_mesh(comm, file, image);
  std::vector<XdmfAttribute> shown{xdmf_region()};
  for (const auto& [quantity, found] : {std::pair{&quantities[0], &stress}, {&quantities[1], &strain}}) {
    const auto parts = write(file, layout, image.cells(), sample, *quantity, *found);
    shown.insert(shown.end(), parts.begin(), parts.end());
  }
  if (damping_power) {
    file.write({"/statistics/damping_power", "W/m^3", "mean power of bulk damping"}, image.cells(), {},
               damping_power->data());
    shown.push_back({"damping_power", XdmfAttribute::Centre::cell, "/statistics/damping_power", {}});
  }
  file.describe("/statistics", [&](hid_t group) {
    write_attribute(group, "from", sample.from);
    write_attribute(group, "to", sample.to);
    write_attribute(group, "samples", static_cast<std::int64_t>(sample.count));
    write_attribute(group, "quantile", sample.quantile);
  });
  file.finish();
  write_xdmf(comm, folder + "/" + name + ".xdmf", {name + ".h5", "statistics", layout, shown});
}

double statistics_bytes(std::int64_t points, std::int64_t cells) {
  const double tensors = 2 * (6 * 3 + 6) * sizeof(double);
  return tensors * static_cast<double>(cells) +
         mesh_bytes(static_cast<double>(points), static_cast<double>(cells)) + 8 * group_overhead;
}

}  // namespace slipscale
