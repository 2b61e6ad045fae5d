#include "slipscale/files/interfaces_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "slipscale/base/print.hpp"
#include "slipscale/files/yaml.hpp"

namespace slipscale {
namespace {

constexpr double between_batches = 0.5;    // s
constexpr std::size_t most_shown = 10000;  ///< rows in the .xdmf, of which each takes a kilobyte
constexpr const char* names[] = {"normal", "shear", "index"};
constexpr const char* units[] = {"Pa", "Pa", "1"};

/// Of the nodes, one number each.
template <class Value>
std::vector<double> of_nodes(const Inclusions& inclusions, Value&& value) {
  std::vector<double> found;
  for (const InterfaceNode& node : inclusions.interface) found.push_back(value(node));
  return found;
}

std::string degrees(double angle) { return format("{:.1f} degrees", angle * 180 / std::numbers::pi); }

void raise(InterfacePeak& peak, double value, double row, double time) {
  if (row >= 0 && value > peak.value) peak = {value, static_cast<int>(row), time};
}

}  // namespace

InterfacesFile::InterfacesFile(const std::string& path, const Inclusions& inclusions,
                               const InterfaceChoice& choice, std::vector<std::string> variants, double rows,
                               std::optional<SeriesFile::Continue> continued)
    : file_(path, between_batches, rows, continued),
      inclusions_(inclusions),
      choice_(choice),
      variants_(std::move(variants)),
      peaks_(variants_.size(), std::vector<InclusionPeaks>(inclusions.area.size())) {
  const hsize_t nodes = inclusions.interface.size(), count = inclusions.area.size();
  const auto constant = [&](const std::string& name, const char* unit, const char* text, auto&& value) {
    file_.constant(name, of_nodes(inclusions, value).data(), {nodes}, unit, text);
  };
  file_.about("region", choice.region);
  constant("/x", "m", "where the nodes of the interfaces are in the undeformed body",
           [](const auto& node) { return node.position[0]; });
  constant("/y", "m", "their heights", [](const auto& node) { return node.position[1]; });
  constant("/inclusion", "1", "number of the inclusion they belong to, from 0",
           [](const auto& node) { return static_cast<double>(node.inclusion); });
  constant("/length", "m", "length of the interface that belongs to each",
           [](const auto& node) { return node.length; });
  constant("/angle", "rad", "about the centre of the inclusion, counter-clockwise from +x",
           [](const auto& node) { return node.angle; });
  constant("/outer", "1", "1 where the node is also on the outer boundary, whose loads its traction holds",
           [](const auto& node) { return node.outer ? 1.0 : 0.0; });
  std::vector<double> normal;
  for (const InterfaceNode& node : inclusions.interface)
    normal.insert(normal.end(), node.normal.begin(), node.normal.end());
  file_.constant("/normal", normal.data(), {nodes, 2}, "1", "out of the inclusion");
  file_.constant("/inclusions/centre", inclusions.centre.front().data(), {count, 2}, "m",
                 "centres of the inclusions");
  file_.constant("/inclusions/area", inclusions.area.data(), {count}, "m^2", "their areas");
  time_ = file_.add("/time", {}, "s", "time of the row");
  for (const std::string& variant : variants_) columns_.push_back(add_columns(variant));
}

InterfacesFile::Columns InterfacesFile::add_columns(const std::string& variant) {
  const hsize_t nodes = inclusions_.interface.size(), count = inclusions_.area.size();
  const std::string root = variant.empty() ? "/" : "/" + variant + "/",
                    of = variant.empty() ? "" : " of the " + variant + " stress";
  Columns added{};
  added.normal = file_.add(root + "normal_traction", {nodes}, "Pa",
                           "on the inclusion along the normal out of it" + of + "; tension > 0");
  added.shear = file_.add(root + "shear_traction", {nodes}, "Pa",
                          "on the inclusion along what lies counter-clockwise of the normal" + of);
  if (choice_.strength)
    added.index = file_.add(root + "index", {nodes}, "1",
                            "debonding index (<normal>/strength)^2 + (shear/strength)^2" + of);
  const std::string group = root + "inclusions/";
  added.force = file_.add(group + "force", {count, 2}, "N/m",
                          "sum over the interface of what the rest does to the inclusion" + of);
  for (std::size_t q = 0; q < (choice_.strength ? 3u : 2u); ++q) {
    const std::string name = names[q];
    added.highest[q] = file_.add(group + "highest_" + name, {count}, units[q],
                                 std::string(q == 0   ? "largest tension"
                                             : q == 1 ? "largest size of the shear traction"
                                                      : "largest debonding index") +
                                     " along the interface" + of + "; 0 where there is none");
    added.at[q] = file_.add(group + "at_" + name, {count}, "1", "the node that has it; -1: none");
  }
  return added;
}

void InterfacesFile::write(double time, const std::vector<std::vector<Vector2>>& forces) {
  now_ = time;
  file_.append(time_, time);
  for (std::size_t v = 0; v < variants_.size(); ++v) write_variant(v, forces[v]);
  file_.end_row();
}

void InterfacesFile::write_variant(std::size_t v, const std::vector<Vector2>& force) {
  const Columns& columns = columns_[v];
  force_.assign(2 * inclusions_.area.size(), 0);
  for (auto& list : values_) list.clear();
  for (auto& list : highest_) list.assign(inclusions_.area.size(), 0);
  for (auto& list : at_) list.assign(inclusions_.area.size(), -1);
  for (std::size_t k = 0; k < force.size(); ++k) {
    const InterfaceNode& node = inclusions_.interface[k];
    for (int axis = 0; axis < 2; ++axis) force_[2 * node.inclusion + axis] += force[k][axis];
    const auto [normal, shear] = tractions(node, force[k]);
    const double index = choice_.strength ? choice_.strength->index(normal, shear) : 0;
    const double row[3] = {normal, shear, index}, sizes[3] = {normal, std::abs(shear), index};
    for (std::size_t q = 0; q < 3; ++q) {
      values_[q].push_back(row[q]);
      if (node.outer || !(sizes[q] > highest_[q][node.inclusion])) continue;
      highest_[q][node.inclusion] = sizes[q];
      at_[q][node.inclusion] = static_cast<double>(k);
    }
  }
  file_.append(columns.normal, values_[0].data());
  file_.append(columns.shear, values_[1].data());
  if (columns.index >= 0) file_.append(columns.index, values_[2].data());
  file_.append(columns.force, force_.data());
  for (std::size_t q = 0; q < 3; ++q) {
    if (columns.highest[q] < 0) continue;
    file_.append(columns.highest[q], highest_[q].data());
    file_.append(columns.at[q], at_[q].data());
  }
  merge(v, now_, highest_, at_);
}

void InterfacesFile::merge(std::size_t v, double time, const std::array<std::vector<double>, 3>& highest,
                           const std::array<std::vector<double>, 3>& at) {
  for (std::size_t k = 0; k < peaks_[v].size(); ++k) {
    InclusionPeaks& peaks = peaks_[v][k];
    raise(peaks.normal, highest[0][k], at[0][k], time);
    raise(peaks.shear, highest[1][k], at[1][k], time);
    raise(peaks.index, highest[2][k], at[2][k], time);
    if (peaks.debonds.row < 0 && at[2][k] >= 0 && highest[2][k] >= 1)
      peaks.debonds = {highest[2][k], static_cast<int>(at[2][k]), time};
  }
}

void InterfacesFile::recall() {
  const std::vector<double> times = file_.read(time_);
  for (std::size_t v = 0; v < variants_.size(); ++v) {
    std::array<std::vector<double>, 3> all_highest, all_at, highest, at;
    const std::size_t count = inclusions_.area.size();
    for (std::size_t q = 0; q < 3; ++q) {
      if (columns_[v].highest[q] < 0) {
        all_highest[q].assign(times.size() * count, 0);
        all_at[q].assign(times.size() * count, -1);
        continue;
      }
      all_highest[q] = file_.read(columns_[v].highest[q]);
      all_at[q] = file_.read(columns_[v].at[q]);
    }
    if (!file_.fault().empty() || !file_.refusal().empty()) return;
    for (std::size_t n = 0; n < times.size(); ++n) {
      for (std::size_t q = 0; q < 3; ++q) {
        const auto begin = static_cast<std::ptrdiff_t>(n * count),
                   end = begin + static_cast<std::ptrdiff_t>(count);
        highest[q].assign(all_highest[q].begin() + begin, all_highest[q].begin() + end);
        at[q].assign(all_at[q].begin() + begin, all_at[q].begin() + end);
      }
      merge(v, times[n], highest, at);
    }
  }
}

std::string InterfacesFile::place_of(const InterfacePeak& peak) const {
  const InterfaceNode& node = inclusions_.interface[peak.row];
  return format("x = {:.6g} m, y = {:.6g} m ({}), t = {:.6g} s", node.position[0], node.position[1],
                degrees(node.angle), peak.time);
}

std::string InterfacesFile::headline() const {
  constexpr std::size_t few = 10;
  const std::size_t rows = file_.rows();
  return finding() + (rows > few ? "" : format(" ({} row{} looked at)", rows, rows == 1 ? " was" : "s were"));
}

std::string InterfacesFile::finding() const {
  const auto& peaks = peaks_.front();
  const auto first = std::ranges::min_element(peaks, {}, [](const InclusionPeaks& p) {
    return p.debonds.row < 0 ? std::numeric_limits<double>::infinity() : p.debonds.time;
  });
  if (first->debonds.row >= 0)
    return format("inclusion {} debonds first: index {:.4g} at ", first - peaks.begin(),
                  first->debonds.value) +
           place_of(first->debonds);
  if (choice_.strength) {
    const auto most = std::ranges::max_element(peaks, {}, [](const auto& p) { return p.index.value; });
    if (most->index.row < 0) return "nothing pulls or shears an interface";
    return format("no inclusion debonds; inclusion {} comes nearest: index {:.4g} at ", most - peaks.begin(),
                  most->index.value) +
           place_of(most->index);
  }
  const auto most = std::ranges::max_element(peaks, {}, [](const auto& p) { return p.normal.value; });
  if (most->normal.row < 0) return "no interface is ever pulled";
  return format("inclusion {} is pulled hardest: {:.4g} Pa at ", most - peaks.begin(), most->normal.value) +
         place_of(most->normal);
}

std::string InterfacesFile::report() const {
  Yaml yaml;
  yaml.remark(
      "Peaks of the tractions along the interfaces of the inclusions, over the rows of interfaces.h5.");
  yaml.remark(
      "Traction: nodal force of the inclusion's own cells (m a + K u, or the integral of B:stress) over");
  yaml.remark(
      "the length of interface that belongs to the node; tension > 0. Nodes that are also on the outer");
  yaml.remark("boundary are left out.");
  yaml.text("region", choice_.region);
  yaml.integer("inclusions", inclusions_.size());
  yaml.integer("nodes", static_cast<std::int64_t>(inclusions_.interface.size()), "of the interfaces");
  if (choice_.strength) {
    yaml.number("normal_strength", choice_.strength->normal, "Pa");
    yaml.number("shear_strength", choice_.strength->shear, "Pa");
  }
  yaml.text("first", headline());
  for (std::size_t v = 0; v < variants_.size(); ++v) {
    yaml.begin(variants_[v].empty() ? "peaks" : "peaks_" + variants_[v],
               "of each inclusion: value, x, y (m), t (s); 0 and zeros where there is none");
    for (std::size_t k = 0; k < peaks_[v].size(); ++k) {
      yaml.begin(format("inclusion_{}", k));
      yaml.numbers("centre", {inclusions_.centre[k][0], inclusions_.centre[k][1]}, "m");
      const auto line = [&](const char* name, const InterfacePeak& peak, const char* unit) {
        const InterfaceNode none{}, &node = peak.row < 0 ? none : inclusions_.interface[peak.row];
        yaml.numbers(name, {peak.value, node.position[0], node.position[1], peak.time}, unit);
      };
      line("normal", peaks_[v][k].normal, "Pa");
      line("shear", peaks_[v][k].shear, "Pa");
      if (choice_.strength) line("index", peaks_[v][k].index, "");
      if (peaks_[v][k].debonds.row >= 0)
        line("debonds", peaks_[v][k].debonds, "first row with an index of 1");
      yaml.end();
    }
    yaml.end();
  }
  return yaml.str();
}

std::string InterfacesFile::xdmf(const std::string& name) {
  const std::vector<double> times = file_.read(time_);
  const std::size_t nodes = inclusions_.interface.size();
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"slipscale\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const auto real = [&](const std::string& dimensions, const std::string& path) {
    return format(
        "<DataItem Dimensions=\"{}\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">{}:{}</DataItem>",
        dimensions, name, path);
  };
  const std::size_t stride = 1 + times.size() / most_shown;
  for (std::size_t n = 0; n < times.size(); n += stride) {
    text +=
        format("      <Grid Name=\"interfaces\" GridType=\"Uniform\">\n        <Time Value=\"{:.17g}\"/>\n",
               times[n]);
    text += format("        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/>\n", nodes);
    text += "        <Geometry GeometryType=\"X_Y\">" + real(std::to_string(nodes), "/x") +
            real(std::to_string(nodes), "/y") +
            "</Geometry>\n        <Attribute Name=\"inclusion\" "
            "AttributeType=\"Scalar\" Center=\"Node\">" +
            real(std::to_string(nodes), "/inclusion") + "</Attribute>\n";
    for (std::size_t v = 0; v < variants_.size(); ++v)
      for (const char* what : {"normal_traction", "shear_traction", "index"}) {
        if (std::string(what) == "index" && !choice_.strength) continue;
        const std::string path = (variants_[v].empty() ? "/" : "/" + variants_[v] + "/") + what,
                          shown = variants_[v].empty() ? what : variants_[v] + "_" + what;
        text += format(
            "        <Attribute Name=\"{0}\" AttributeType=\"Scalar\" Center=\"Node\"><DataItem "
            "ItemType=\"HyperSlab\" Dimensions=\"1 {1}\"><DataItem Dimensions=\"3 2\" NumberType=\"Int\" "
            "Format=\"XML\">{2} 0 1 1 1 {1}</DataItem>",
            shown, nodes, n);
        text += real(format("{} {}", times.size(), nodes), path) + "</DataItem></Attribute>\n";
      }
    text += "      </Grid>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace slipscale
