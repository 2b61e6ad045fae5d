#include "gmsh_text.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "gmsh_numbers.hpp"

namespace slipscale::mesh_stages {
namespace {

/// The entities of one dimension.
struct Entities {
  std::map<long, int> index;              ///< by tag
  std::vector<std::vector<long>> groups;  ///< physical tags of each
};

std::array<Entities, 4> read_entities(GmshNumbers numbers) {
  std::array<long, 4> counts{};
  for (long& count : counts) count = numbers.count();
  std::array<Entities, 4> known;
  for (int dimension = 0; dimension < 4; ++dimension)
    for (long k = 0; k < counts[dimension]; ++k) {
      Entities& entities = known[dimension];
      entities.index.emplace(numbers.next(), static_cast<int>(k));
      numbers.skip_reals(dimension == 0 ? 3 : 6);
      auto& groups = entities.groups.emplace_back();
      for (long tags = numbers.count(); tags > 0; --tags) groups.push_back(numbers.next());
      if (dimension > 0)
        for (long parts = numbers.count(); parts > 0; --parts) numbers.next();
    }
  return known;
}

/// Where a node of this tag stands in the file.
class NodeIndex {
 public:
  NodeIndex() = default;
  NodeIndex(long least, long largest)
      : least_(least), index_(static_cast<std::size_t>(largest - least + 1), -1) {}

  int find(long tag) const {
    return tag < least_ || tag - least_ >= static_cast<long>(index_.size()) ? -1 : index_[tag - least_];
  }
  bool insert(long tag, int node) {
    if (tag < least_ || tag - least_ >= static_cast<long>(index_.size()) || index_[tag - least_] >= 0)
      return false;
    index_[tag - least_] = node;
    return true;
  }

 private:
  long least_ = 0;
  std::vector<int> index_;
};

NodeIndex read_nodes(GmshNumbers numbers, long bytes, std::vector<Vector2>& nodes) {
  const long blocks = numbers.count(), count = numbers.count(), least = numbers.next(),
             largest = numbers.next();
  if (count > 0 && (least < 1 || largest < least || largest > 1000 + 25 * bytes))
    throw GmshFault("is damaged: the tags of its nodes run from " + std::to_string(least) + " to " +
                    std::to_string(largest) + "; renumber the mesh and " + write_again);
  NodeIndex index;
  if (count > 0) index = NodeIndex(least, largest);
  nodes.reserve(static_cast<std::size_t>(count));
  for (long block = 0; block < blocks; ++block) {
    numbers.next(), numbers.next();  // dimension and tag of the entity
    if (numbers.next() != 0)
      throw GmshFault("holds parametric coordinates; write it again without Mesh.SaveParametric");
    const long size = numbers.count(), first = static_cast<long>(nodes.size());
    for (long k = 0; k < size; ++k)
      if (const long tag = numbers.next(); !index.insert(tag, static_cast<int>(first + k)))
        throw GmshFault("is damaged: node tag " + std::to_string(tag) + " is out of range or used twice; " +
                        write_again);
    for (long k = 0; k < size; ++k) {
      const double x = numbers.real(), y = numbers.real();
      nodes.push_back({x, y});
      numbers.real();  // the model is plane
    }
  }
  if (static_cast<long>(nodes.size()) != count) numbers.fail("holds fewer entries than it announces");
  return index;
}

int corners_of(long type) {
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
      throw GmshFault("has 3-dimensional cells, but the model is plane; mesh the surfaces only (gmsh -2)");
    default:
      throw GmshFault("has cells that are not three- or four-cornered and straight; use gmsh -order 1");
  }
}

using Edge = std::pair<int, int>;

Edge edge_between(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Sides of the cells between two nodes that lie on lines, and the nodes themselves.
std::vector<Edge> sides_on_lines(const std::vector<Edge>& lines, const GmshMesh& mesh) {
  std::vector<char> on_line(mesh.nodes.size(), 0);
  for (const auto& [a, b] : lines) on_line[a] = on_line[b] = 1;
  std::vector<Edge> sides;  // a point is a line from a node to itself
  for (const GmshMesh::Cell& cell : mesh.cells) {
    const std::size_t n = cell.nodes[3] < 0 ? 3 : 4;
    for (std::size_t c = 0; c < n; ++c) {
      const int a = cell.nodes[c], b = cell.nodes[(c + 1) % n];
      if (!on_line[a]) continue;
      sides.emplace_back(a, a);
      if (on_line[b]) sides.push_back(edge_between(a, b));
    }
  }
  return sides;
}

/// Curves that are saved must run along the cells.
void check_lines(std::vector<Edge> lines, const GmshMesh& mesh) {
  std::vector<Edge> sides = sides_on_lines(lines, mesh);
  std::sort(lines.begin(), lines.end());
  std::sort(sides.begin(), sides.end());
  if (!std::includes(sides.begin(), sides.end(), lines.begin(), std::unique(lines.begin(), lines.end())))
    throw GmshFault(
        "has a curve or point that belongs to no cell; save only the physical groups that bound a meshed "
        "surface");
}

void read_elements(GmshNumbers numbers, const std::array<Entities, 4>& entities, const NodeIndex& nodes,
                   GmshMesh& mesh) {
  const long blocks = numbers.count(), count = numbers.count();
  numbers.next(), numbers.next();
  long seen = 0;
  std::vector<Edge> lines;  // a point is a line from a node to itself
  std::vector<GmshMesh::Cell> quadrilaterals;
  for (long block = 0; block < blocks; ++block) {
    const long dimension = numbers.next(), tag = numbers.next();
    const int corners = corners_of(numbers.next());
    if (dimension != std::min(corners - 1, 2) || !entities[dimension].index.contains(tag))
      throw GmshFault("is damaged: its elements name an entity that $Entities does not list; " + write_again);
    const int entity = entities[dimension].index.at(tag);
    const long size = numbers.count();
    for (long k = 0; k < size; ++k) {
      numbers.next();
      std::array<int, 4> corner{-1, -1, -1, -1};
      for (int c = 0; c < corners; ++c) {
        const long node = numbers.next();
        if ((corner[c] = nodes.find(node)) < 0)
          throw GmshFault("is damaged: an element names node " + std::to_string(node) +
                          ", which $Nodes does not list; " + write_again);
      }
      if (corners <= 2) lines.push_back(edge_between(corner[0], corner[corners - 1]));
      if (corners == 2) mesh.lines.push_back({{corner[0], corner[1]}, entity});
      if (corners == 3) mesh.cells.push_back({corner, entity});
      if (corners == 4) quadrilaterals.push_back({corner, entity});
    }
    seen += size;
  }
  if (seen != count) numbers.fail("holds fewer entries than it announces");
  mesh.cells.insert(mesh.cells.end(), quadrilaterals.begin(), quadrilaterals.end());
  if (mesh.cells.empty()) throw GmshFault("has no cells, only points or lines; mesh its surfaces (gmsh -2)");
  check_lines(std::move(lines), mesh);
}

/// A corner of a cell that is periodic both ways repeats a node that repeats another.
void follow_chains(std::vector<int>& original) {
  for (int& node : original) {
    int links = 0;
    for (; node != original[node]; node = original[node])
      if (++links > 8) throw GmshFault("is damaged: $Periodic pairs nodes in a circle; " + write_again);
  }
}

void read_periods(GmshNumbers numbers, const NodeIndex& nodes, GmshMesh& mesh) {
  mesh.original.resize(mesh.nodes.size());
  std::iota(mesh.original.begin(), mesh.original.end(), 0);
  const auto next_node = [&] {
    const long tag = numbers.next();
    const int node = nodes.find(tag);
    if (node < 0)
      throw GmshFault("is damaged: $Periodic names node " + std::to_string(tag) +
                      ", which $Nodes does not list; " + write_again);
    return node;
  };
  for (long links = numbers.count(); links > 0; --links) {
    for (int k = 0; k < 3; ++k) numbers.next();
    numbers.skip_reals(numbers.count());
    for (long pairs = numbers.count(); pairs > 0; --pairs) {
      const int node = next_node();
      mesh.original[node] = next_node();
    }
  }
  follow_chains(mesh.original);
}

GmshMesh read_sections(std::string_view bytes, const GmshSections& sections) {
  const auto of = [&](const char* name) {
    const auto text = sections.text(name);
    if (text.empty()) throw GmshFault("has no section $" + std::string(name) + "; " + write_again);
    return GmshNumbers(name, text);
  };
  GmshMesh mesh;
  std::array<Entities, 4> entities = read_entities(of("Entities"));
  const NodeIndex nodes = read_nodes(of("Nodes"), static_cast<long>(bytes.size()), mesh.nodes);
  read_elements(of("Elements"), entities, nodes, mesh);
  if (sections.has("Periodic")) read_periods(of("Periodic"), nodes, mesh);
  mesh.curve_groups = std::move(entities[1].groups);
  mesh.surface_groups = std::move(entities[2].groups);
  return mesh;
}

bool is_usual(const GmshSections& sections) {
  return std::ranges::all_of(sections.names(), [](std::string_view name) {
    return name == "MeshFormat" || name == "PhysicalNames" || name == "Entities" || name == "Nodes" ||
           name == "Elements" || name == "Periodic";
  });
}

}  // namespace

GmshText read_gmsh_text(std::string_view bytes, const GmshSections& sections) {
  GmshText read;
  try {
    GmshNumbers format("MeshFormat", bytes.substr(bytes.find("$MeshFormat") + 11, 64));
    const bool is_41 = format.next<double>() == 4.1, is_text = format.next() == 0;
    for (const char* name : {"PhysicalNames", "Entities", "Nodes", "Elements", "Periodic"})
      if (sections.is_cut(name))
        throw GmshFault("is cut short: $" + std::string(name) + " has no end; " + write_again);
    if (sections.text("Nodes").empty() || sections.text("Elements").empty())
      throw GmshFault("is cut short: it has no $Nodes or no $Elements; " + write_again);
    if (is_41 && is_text && is_usual(sections)) read.mesh = read_sections(bytes, sections);
  } catch (const GmshFault& fault) {
    read.fault = fault.what();
  }
  return read;
}

}  // namespace slipscale::mesh_stages
