#include "gmsh_check.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

namespace slipscale::mesh_stages {
namespace {

struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr const char* write_again = "write it again with gmsh -2 -format msh41";

/// The numbers of one section, one after the other.
class Numbers {
 public:
  Numbers(std::string name, std::string_view text)
      : name_(std::move(name)), next_(text.data()), end_(next_ + text.size()) {}

  template <class Number = long>
  Number next() {
    while (next_ != end_ && (*next_ == ' ' || *next_ == '\n' || *next_ == '\r' || *next_ == '\t')) ++next_;
    Number value{};
    const auto [stop, code] = std::from_chars(next_, end_, value);
    if (next_ == end_)
      throw Fault("is damaged: $" + name_ + " holds fewer entries than it announces; " + write_again);
    if (code != std::errc{})
      throw Fault("is damaged: $" + name_ + " holds something that is not a number; " + write_again);
    next_ = stop;
    return value;
  }

  /// A count of things that take at least two characters each.
  long count() {
    const long value = next();
    if (value < 0 || value > end_ - next_)
      throw Fault("is damaged: $" + name_ + " announces more than it can hold; " + write_again);
    return value;
  }

  void skip_reals(long count) {
    for (long k = 0; k < count; ++k)
      if (!std::isfinite(next<double>()))
        throw Fault("is damaged: $" + name_ + " holds something that is not a number; " + write_again);
  }

 private:
  std::string name_;
  const char *next_, *end_;
};

/// What stands between "$Name" and "$EndName"; empty when the file has no such section.
std::string_view section(std::string_view bytes, const std::string& name) {
  const std::string open = "\n$" + name, close = "\n$End" + name;
  const auto begin = bytes.find(open);
  if (begin == std::string_view::npos) return {};
  const auto end = bytes.find(close, begin + open.size() - 1);
  if (end == std::string_view::npos) throw Fault("is cut short: $" + name + " has no end; " + write_again);
  return bytes.substr(begin + open.size(), end - begin - open.size() + 1);
}

using Entities = std::array<std::set<long>, 4>;  ///< tags by dimension

Entities entities(Numbers numbers) {
  std::array<long, 4> counts{};
  for (long& count : counts) count = numbers.count();
  Entities known;
  for (int dimension = 0; dimension < 4; ++dimension)
    for (long k = 0; k < counts[dimension]; ++k) {
      known[dimension].insert(numbers.next());
      numbers.skip_reals(dimension == 0 ? 3 : 6);
      for (long tags = numbers.count(); tags > 0; --tags) numbers.next();
      if (dimension > 0)
        for (long parts = numbers.count(); parts > 0; --parts) numbers.next();
    }
  return known;
}

/// 1 where a node has this tag.
std::vector<char> nodes(Numbers numbers, long most) {
  const long blocks = numbers.count(), count = numbers.count(), least_tag = numbers.next(),
             largest_tag = numbers.next();
  if (count > 0 && (least_tag < 1 || largest_tag < least_tag || largest_tag > 1000 + 100 * most))
    throw Fault("is damaged: the tags of its nodes run from " + std::to_string(least_tag) + " to " +
                std::to_string(largest_tag) + "; renumber the mesh and " + write_again);
  std::vector<char> known(static_cast<std::size_t>(largest_tag + 1), 0);
  long seen = 0;
  for (long block = 0; block < blocks; ++block) {
    numbers.next(), numbers.next();  // dimension and tag of the entity
    if (numbers.next() != 0)
      throw Fault("holds parametric coordinates; write it again without Mesh.SaveParametric");
    const long size = numbers.count();
    for (long k = 0; k < size; ++k) {
      const long node = numbers.next();
      if (node < least_tag || node > largest_tag || known[node]++)
        throw Fault("is damaged: node tag " + std::to_string(node) + " is out of range or used twice; " +
                    write_again);
    }
    numbers.skip_reals(3 * size);
    seen += size;
  }
  if (seen != count)
    throw Fault(std::string("is damaged: $Nodes holds fewer entries than it announces; ") + write_again);
  return known;
}

long corners_of(long type) {
  switch (type) {
    case 15:
      return 1;
    case 1:
      return 2;
    case 2:
      return 3;
    case 3:
      return 4;
    case 4:
    case 5:
    case 6:
    case 7:
      throw Fault("has 3-dimensional cells, but the model is plane; mesh the surfaces only (gmsh -2)");
    default:
      throw Fault("has cells that are not three- or four-cornered and straight; use gmsh -order 1");
  }
}

using Edge = std::pair<long, long>;

Edge edge_between(long a, long b) { return {std::min(a, b), std::max(a, b)}; }

using Corners = std::array<long, 4>;  ///< tags; a triangle's last is 0, which is no node's

/// Sides of the cells between two nodes that lie on lines, and the nodes themselves.
std::vector<Edge> sides_on_lines(const std::vector<Edge>& lines, const std::vector<Corners>& cells,
                                 std::size_t tags) {
  std::vector<char> on_line(tags, 0);
  for (const auto& [a, b] : lines) on_line[a] = on_line[b] = 1;
  on_line[0] = 0;
  std::vector<Edge> sides;  // a point is a line from a node to itself
  for (const Corners& corner : cells) {
    const std::size_t n = corner[3] == 0 ? 3 : 4;
    for (std::size_t c = 0; c < n; ++c) {
      const long a = corner[c], b = corner[(c + 1) % n];
      if (on_line[a]) sides.emplace_back(a, a);
      if (on_line[a] && on_line[b]) sides.push_back(edge_between(a, b));
    }
  }
  return sides;
}

/// Curves that are saved must run along the cells.
void check_lines(std::vector<Edge>& lines, const std::vector<Corners>& cells, std::size_t tags) {
  std::vector<Edge> sides = sides_on_lines(lines, cells, tags);
  std::sort(lines.begin(), lines.end());
  std::sort(sides.begin(), sides.end());
  if (!std::includes(sides.begin(), sides.end(), lines.begin(), std::unique(lines.begin(), lines.end())))
    throw Fault(
        "has a curve or point that belongs to no cell; save only the physical groups that bound a meshed "
        "surface");
}

void elements(Numbers numbers, const Entities& entities, const std::vector<char>& nodes) {
  const long blocks = numbers.count(), count = numbers.count();
  numbers.next(), numbers.next();
  long seen = 0;
  std::vector<Edge> lines;  // a point is a line from a node to itself
  std::vector<Corners> cells;
  for (long block = 0; block < blocks; ++block) {
    const long dimension = numbers.next(), entity = numbers.next(), corners = corners_of(numbers.next());
    if (dimension < 0 || dimension > 3 || !entities[dimension].count(entity))
      throw Fault(std::string("is damaged: its elements name an entity that $Entities does not list; ") +
                  write_again);
    const long size = numbers.count();
    for (long k = 0; k < size; ++k) {
      numbers.next();
      Corners corner{};
      for (long c = 0; c < corners; ++c) {
        const long node = corner[c] = numbers.next();
        if (node < 1 || node >= static_cast<long>(nodes.size()) || !nodes[node])
          throw Fault("is damaged: an element names node " + std::to_string(node) +
                      ", which $Nodes does not list; " + write_again);
      }
      if (corners <= 2)
        lines.push_back(edge_between(corner[0], corner[corners - 1]));
      else
        cells.push_back(corner);
    }
    seen += size;
  }
  if (seen != count)
    throw Fault(std::string("is damaged: $Elements holds fewer entries than it announces; ") + write_again);
  if (cells.empty()) throw Fault("has no cells, only points or lines; mesh its surfaces (gmsh -2)");
  check_lines(lines, cells, nodes.size());
}

void periodic(Numbers numbers, const std::vector<char>& nodes) {
  for (long links = numbers.count(); links > 0; --links) {
    for (int k = 0; k < 3; ++k) numbers.next();
    numbers.skip_reals(numbers.count());
    for (long pairs = 2 * numbers.count(); pairs > 0; --pairs) {
      const long node = numbers.next();
      if (node < 0 || node >= static_cast<long>(nodes.size()) || !nodes[node])
        throw Fault("is damaged: $Periodic names node " + std::to_string(node) +
                    ", which $Nodes does not list; " + write_again);
    }
  }
}

void check_numbers(std::string_view bytes) {
  const auto of = [&](const char* name) {
    const auto text = section(bytes, name);
    if (text.empty()) throw Fault("has no section $" + std::string(name) + "; " + write_again);
    return Numbers(name, text);
  };
  const Entities entity_tags = entities(of("Entities"));
  const auto node_tags = nodes(of("Nodes"), static_cast<long>(bytes.size()));
  elements(of("Elements"), entity_tags, node_tags);
  if (!section(bytes, "Periodic").empty()) periodic(of("Periodic"), node_tags);
}

bool only_usual_sections(std::string_view bytes) {
  static const std::set<std::string_view> usual{"MeshFormat", "PhysicalNames", "Entities",
                                                "Nodes",      "Elements",      "Periodic"};
  for (auto at = bytes.find("\n$"); at != std::string_view::npos; at = bytes.find("\n$", at + 2)) {
    auto name = bytes.substr(at + 2, bytes.find_first_of(" \r\n", at + 2) - at - 2);
    if (name.substr(0, 3) == "End") name.remove_prefix(3);
    if (!usual.count(name)) return false;
  }
  return true;
}

}  // namespace

GmshCheck check_gmsh(std::string_view bytes) {
  GmshCheck check;
  try {
    Numbers format("MeshFormat", bytes.substr(bytes.find("$MeshFormat") + 11, 64));
    const bool is_41 = format.next<double>() == 4.1, is_text = format.next() == 0;
    for (const char* name : {"PhysicalNames", "Entities", "Nodes", "Elements", "Periodic"})
      section(bytes, name);
    if (section(bytes, "Nodes").empty() || section(bytes, "Elements").empty())
      throw Fault(std::string("is cut short: it has no $Nodes or no $Elements; ") + write_again);
    if (is_41 && is_text && only_usual_sections(bytes)) {
      check_numbers(bytes);
      check.vouched = true;
    }
  } catch (const Fault& fault) {
    check.fault = fault.what();
  }
  return check;
}

}  // namespace slipscale::mesh_stages
