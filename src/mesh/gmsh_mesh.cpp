#include "gmsh_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>

#include "node_index.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale::mesh_stages {
namespace {

/// The entities of one dimension.
struct Entities {
  std::map<int, int> index;              ///< by tag
  std::vector<std::vector<int>> groups;  ///< physical tags of each
};

/// Nodes and elements of a cell by its type in gmsh's numbering, corners first.
struct CellType {
  int dimension, corners, nodes;
};

CellType cell_type(int type) {
  switch (type) {
    case 15:
      return {0, 1, 1};
    case 1:
      return {1, 2, 2};
    case 8:
      return {1, 2, 3};
    case 26:
      return {1, 2, 4};
    case 2:
      return {2, 3, 3};
    case 9:
      return {2, 3, 6};
    case 20:
      return {2, 3, 9};
    case 21:
      return {2, 3, 10};
    case 3:
      return {2, 4, 4};
    case 16:
      return {2, 4, 8};
    case 10:
      return {2, 4, 9};
    case 39:
      return {2, 4, 12};
    case 36:
      return {2, 4, 16};
    default:
      break;
  }
  if ((type >= 4 && type <= 7) || (type >= 11 && type <= 14) || (type >= 17 && type <= 19) || type == 29 ||
      type == 30 || type == 90 || type == 91 || type == 92)
    throw GmshFault("has 3-dimensional cells, but the model is plane; mesh the surfaces only (gmsh -2)");
  throw GmshFault(
      format("has cells that are not three- or four-cornered (type {} of gmsh); mesh it again "
             "with gmsh -2 -order 1 -format msh41",
             type));
}

class Reader {
 public:
  explicit Reader(GmshStream& stream) : in_(stream) {}

  GmshMesh run() {
    for (std::string name = in_.open(); !name.empty(); name = in_.open()) {
      if (!known(name)) {
        in_.skip();  // as gmsh does
        continue;
      }
      if (!read_.insert(name).second) in_.damaged("stands there twice");
      if (name == "MeshFormat") in_.damaged("stands there twice");
      if (name == "PartitionedEntities")
        throw GmshFault("is partitioned, which slipscale does itself; mesh it again without -part");
      if (name == "PhysicalNames") names();
      if (name == "Entities") entities();
      if (name == "Nodes") after("Entities"), nodes();
      if (name == "Elements") after("Nodes"), elements();
      if (name == "Periodic") after("Nodes"), periods();
      in_.close();
    }
    for (const char* name : {"Entities", "Nodes", "Elements"})
      if (!read_.contains(name))
        throw GmshFault("is cut short: it has no $" + std::string(name) + "; " + write_again);
    check_plane();
    return std::move(mesh_);
  }

 private:
  static bool known(const std::string& name) {
    static const std::set<std::string> names{"MeshFormat", "PhysicalNames", "Entities", "PartitionedEntities",
                                             "Nodes",      "Elements",      "Periodic"};
    return names.contains(name);
  }

  void after(const char* other) {
    if (!read_.contains(other)) in_.damaged("stands before $" + std::string(other));
  }

  void names() {
    std::set<std::pair<int, int>> seen;
    // Text in both formats, one name a line.
    const auto number = [&](std::string_view text) {
      GmshStream line(text);
      const int value = line.integer();
      return value;
    };
    const int count = number(in_.word());
    in_.line();
    for (int k = 0; k < count; ++k) {
      PhysicalName& entry = mesh_.names.emplace_back();
      std::string_view words[2] = {in_.word(), in_.word()};
      for (const auto word : words)
        if (word.empty() || word.find_first_not_of("0123456789") != word.npos || word.size() > 9)
          in_.damaged("holds a line that names no group");
      entry.dimension = number(words[0]);
      entry.tag = number(words[1]);
      const std::string_view rest = in_.line();
      const auto open = rest.find('"'), close = rest.rfind('"');
      if (open == rest.npos || close <= open || entry.dimension > 3 ||
          !seen.insert({entry.dimension, entry.tag}).second)
        in_.damaged("holds a line that names no group, or one twice");
      entry.name = rest.substr(open + 1, close - open - 1);
    }
  }

  void entities() {
    std::array<long, 4> counts{};
    for (long& count : counts) count = in_.count(4);
    for (int dimension = 0; dimension < 4; ++dimension)
      for (long k = 0; k < counts[dimension]; ++k) {
        Entities& known = entities_[dimension];
        const int tag = in_.integer();
        if (!known.index.emplace(tag, static_cast<int>(k)).second) in_.damaged("lists an entity twice");
        in_.skip_reals(dimension == 0 ? 3 : 6);  // its box
        std::vector<int>& groups = known.groups.emplace_back();
        for (long tags = in_.count(1); tags > 0; --tags) groups.push_back(std::abs(in_.integer()));
        if (dimension == 2) mesh_.surface_tags.push_back(tag);
        if (dimension > 0)
          for (long sides = in_.count(1); sides > 0; --sides) in_.integer();
      }
    mesh_.curve_groups = std::move(entities_[1].groups);
    mesh_.surface_groups = std::move(entities_[2].groups);
  }

  void nodes() {
    const long blocks = in_.count(4), count = in_.count(4), least = in_.size(), largest = in_.size();
    index_.reserve(count);
    mesh_.nodes.reserve(static_cast<std::size_t>(count));
    third_.reserve(static_cast<std::size_t>(count));
    for (long block = 0; block < blocks; ++block) {
      const int dimension = in_.integer();
      in_.integer();  // the entity
      const bool parametric = in_.integer() != 0;
      if (dimension < 0 || dimension > 3) in_.damaged("names a dimension that is not 0 to 3");
      const long size = in_.count(4);
      for (long k = 0; k < size; ++k) {
        const long tag = in_.size();
        if (tag < least || tag > largest)
          in_.damaged(format("holds node tag {}, which is out of range", tag));
        index_.add(tag);
      }
      for (long k = 0; k < size; ++k) {
        const double x = in_.real(), y = in_.real();
        mesh_.nodes.push_back({x, y});
        third_.push_back(in_.real());
        if (parametric) in_.skip_reals(dimension);
      }
    }
    if (static_cast<long>(mesh_.nodes.size()) != count) in_.damaged("holds fewer entries than it announces");
    if (const auto twice = index_.settle()) in_.damaged(format("holds node tag {} twice", *twice));
  }

  int node(const char* what) {
    const long tag = in_.size();
    const int found = index_.find(tag);
    if (found < 0) in_.damaged(format("{} node {}, which $Nodes does not list", what, tag));
    return found;
  }

  void elements() {
    const long blocks = in_.count(4), count = in_.count(2);
    in_.size(), in_.size();  // least and largest tag
    long seen = 0;
    std::vector<GmshMesh::Cell> quadrilaterals;
    for (long block = 0; block < blocks; ++block) {
      const int dimension = in_.integer(), tag = in_.integer();
      const CellType type = cell_type(in_.integer());
      const auto& known = entities_[type.dimension].index;
      const auto entity = known.find(tag);
      if (dimension != type.dimension || entity == known.end())
        in_.damaged("names an entity that $Entities does not list");
      const long size = in_.count(type.nodes);
      for (long k = 0; k < size; ++k) {
        in_.size();
        std::array<int, 4> corner{-1, -1, -1, -1};
        for (int c = 0; c < type.corners; ++c) corner[c] = node("names");
        for (int c = type.corners; c < type.nodes; ++c) node("names");
        if (type.corners == 2) mesh_.lines.push_back({{corner[0], corner[1]}, entity->second});
        if (type.corners == 3) mesh_.cells.push_back({corner, entity->second});
        if (type.corners == 4) quadrilaterals.push_back({corner, entity->second});
      }
      seen += size;
      if (type.dimension == 2 && type.nodes > type.corners && size > 0) mesh_.is_of_higher_order = true;
    }
    if (seen != count) in_.damaged("holds fewer entries than it announces");
    mesh_.cells.insert(mesh_.cells.end(), quadrilaterals.begin(), quadrilaterals.end());
    if (mesh_.cells.empty())
      throw GmshFault("has no cells, only points or lines; mesh its surfaces (gmsh -2)");
  }

  void periods() {
    mesh_.is_periodic = true;
    for (long links = in_.count(4); links > 0; --links) {
      PeriodicLink& link = mesh_.links.emplace_back();
      link.dimension = in_.integer();
      link.entity = in_.integer();
      link.original = in_.integer();
      std::vector<double> map;
      for (long numbers = in_.count(1); numbers > 0; --numbers) map.push_back(in_.real());
      link.is_turned = is_turned(map);
      for (long pairs = in_.count(2); pairs > 0; --pairs) {
        const int copy = node("names");
        link.pairs.push_back({copy, node("names")});
      }
    }
  }

  /// `map` is a matrix of 4 by 4, row by row, whose last column is the shift.
  static bool is_turned(const std::vector<double>& map) {
    if (map.size() < 16) return false;
    for (std::size_t row = 0; row < 2; ++row)
      for (std::size_t column = 0; column < 2; ++column)
        if (std::abs(map[4 * row + column] - (row == column ? 1 : 0)) > 1e-6) return true;
    return false;
  }

  /// The model is plane. Nodes that no cell uses, the centre of an arc, say, may lie anywhere.
  void check_plane() {
    constexpr double far = std::numeric_limits<double>::max();
    std::array<double, 3> lower{far, far, far}, upper{-far, -far, -far};
    for (const GmshMesh::Cell& cell : mesh_.cells)
      for (const int node : cell.nodes) {
        if (node < 0) continue;
        const std::array<double, 3> x{mesh_.nodes[node][0], mesh_.nodes[node][1], third_[node]};
        for (int d = 0; d < 3; ++d) {
          lower[d] = std::min(lower[d], x[d]);
          upper[d] = std::max(upper[d], x[d]);
        }
      }
    const double size = std::max(upper[0] - lower[0], upper[1] - lower[1]);
    if (!(upper[2] - lower[2] <= 1e-6 * size))
      throw GmshFault(
          format(": its third coordinate varies from {:g} to {:g} m, but the model lies in a plane "
                 "of constant z; turn the geometry into the x-y plane and mesh it again",
                 lower[2], upper[2]));
  }

  GmshStream& in_;
  GmshMesh mesh_;
  std::set<std::string> read_;
  std::array<Entities, 4> entities_;
  NodeIndex index_;
  std::vector<double> third_;  ///< z of each node, m
};

}  // namespace

GmshMesh read_gmsh_mesh(GmshStream& stream) { return Reader(stream).run(); }

}  // namespace slipscale::mesh_stages
