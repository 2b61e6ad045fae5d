#include "groups.hpp"

#include <algorithm>
#include <cstring>
#include <set>

namespace slipscale::mesh_stages {
namespace {

std::string by_tag(int dimension, int tag) {
  return (dimension == 2 ? "surface_" : "curve_") + std::to_string(tag);
}

bool is_number(const std::string& name) {
  return !name.empty() && name.find_first_not_of("0123456789") == name.npos;
}

/// Tags of the groups that hold at least one element.
template <class Element>
std::set<int> tags_in_use(const std::vector<Element>& elements, int Element::*entity,
                          const std::vector<std::vector<int>>& groups) {
  std::vector<char> used(groups.size(), 0);
  for (const Element& element : elements) used[element.*entity] = 1;
  std::set<int> tags;
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (used[k]) tags.insert(groups[k].begin(), groups[k].end());
  return tags;
}

void check(const std::string& name, std::set<std::string>& known) {
  const auto is_odd = [](char c) { return static_cast<unsigned char>(c) <= ' ' || std::strchr(",:#'\"", c); };
  if (name.empty() || std::ranges::any_of(name, is_odd))
    throw GmshFault("has a physical group named '" + name +
                    "', which no option can spell; use letters, digits, '-' and '_'");
  if (name == "all")
    throw GmshFault("has a physical group named '" + name +
                    "', a name that has a meaning of its own; rename it");
  if (!known.insert(name).second)
    throw GmshFault("uses the name '" + name + "' for two physical groups; give each its own");
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  std::string list;
  for (std::size_t k = 0; k < std::min(names.size(), most); ++k) list += (k ? ", " : "") + names[k];
  return names.size() > most ? list + " and " + std::to_string(names.size() - most) + " more" : list;
}

}  // namespace

Groups find_groups(const GmshMesh& mesh) {
  Groups found;
  std::set<std::string> known;
  std::vector<std::string> nameless;
  std::array<std::set<int>, 3> unnamed{};
  unnamed[1] = tags_in_use(mesh.lines, &GmshMesh::Line::curve, mesh.curve_groups);
  unnamed[2] = tags_in_use(mesh.cells, &GmshMesh::Cell::surface, mesh.surface_groups);
  const auto add = [&](int dimension, int tag, const std::string& name) {
    check(name, known);
    if (dimension == 2) found.regions.push_back({name, tag});
    if (dimension == 1) found.boundaries.push_back({.name = name, .tag = tag});
  };
  for (const PhysicalName& entry : mesh.names) {
    if (entry.dimension != 1 && entry.dimension != 2) continue;
    unnamed[entry.dimension].erase(entry.tag);
    if (!is_number(entry.name)) {
      add(entry.dimension, entry.tag, entry.name);
      continue;
    }
    const std::string name = by_tag(entry.dimension, entry.tag);
    add(entry.dimension, entry.tag, name);
    found.notes.push_back("the physical group named '" + entry.name + "' is called " + name +
                          ", since no option can bear a number as a name");
  }
  for (const int dimension : {2, 1})
    for (const int tag : unnamed[dimension]) {
      nameless.push_back(by_tag(dimension, tag));
      add(dimension, tag, nameless.back());
    }
  if (!nameless.empty())
    found.notes.push_back("physical groups without a name are called by their tags: " + listed(nameless));
  if (found.regions.empty())
    throw GmshFault("names no region; add Physical Surface(\"matrix\") = {…}; to its geometry");
  return found;
}

}  // namespace slipscale::mesh_stages
