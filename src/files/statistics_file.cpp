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

void write(SharedFile& file, const FileOrder& cells, const StatisticsSample& sample, const Quantity& quantity,
           const FieldStatistics& found) {
  const std::string group = "/statistics/" + quantity.name + "/", of = " of the " + quantity.name;
  const std::string components = "; xx, yy and xy", &units = quantity.units;
  file.write({group + "mean", units, "time mean" + of + components}, cells, {3}, found.mean.data());
  file.write({group + "deviation", units, "standard deviation" + of + components}, cells, {3},
             deviation(found.covariance).data());
  file.write({group + "covariance", units == "1" ? "1" : units + "2",
              "covariance" + of + "; xx.xx, yy.yy, xy.xy, yy.xy, xx.xy and xx.yy"},
             cells, {6}, found.covariance.data());
  if (!sample.tails) return;
  for (const Statistic& each : tails(sample.quantile))
    file.write({group + each.name, units, each.text + of + components}, cells, {3},
               (found.*each.values).data());
}

std::vector<XdmfAttribute> attributes(const StatisticsSample& sample) {
  std::vector<std::string> names{"mean", "deviation"};
  if (sample.tails)
    for (const Statistic& each : tails(sample.quantile)) names.push_back(each.name);
  std::vector<XdmfAttribute> shown{xdmf_region()};
  for (const Quantity& quantity : quantities)
    for (const std::string& name : names)
      shown.push_back({.name = quantity.name + "_" + name,
                       .path = "/statistics/" + quantity.name + "/" + name,
                       .row = {3}});
  return shown;
}

}  // namespace

void write_statistics(MPI_Comm comm, const MeshImage& image, const StatisticsSample& sample,
                      const FieldStatistics& stress, const FieldStatistics& strain, const std::string& folder,
                      const std::string& name) {
  SharedFile file(comm, folder + "/" + name + ".h5",
                  statistics_bytes(image.points().total(), image.cells().total()));
  const MeshLayout layout = write_mesh(comm, file, image);
  write(file, image.cells(), sample, quantities[0], stress);
  write(file, image.cells(), sample, quantities[1], strain);
  file.describe("/statistics", [&](hid_t group) {
    write_attribute(group, "from", sample.from);
    write_attribute(group, "to", sample.to);
    write_attribute(group, "samples", static_cast<std::int64_t>(sample.count));
    write_attribute(group, "quantile", sample.quantile);
  });
  file.finish();
  write_xdmf(comm, folder + "/" + name + ".xdmf", {name + ".h5", "statistics", layout, attributes(sample)});
}

double statistics_bytes(std::int64_t points, std::int64_t cells) {
  const double tensors = 2 * (6 * 3 + 6) * sizeof(double);
  return tensors * static_cast<double>(cells) +
         mesh_bytes(static_cast<double>(points), static_cast<double>(cells)) + 4 * group_overhead;
}

}  // namespace slipscale
