#include "gmsh_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "gmsh_sections.hpp"

namespace slipscale::mesh_stages {
namespace {

/// FNV-1a, 64 bit (Fowler, Noll, Vo): enough to tell two meshes apart, not a defence against anyone.
std::uint64_t fnv1a(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ull;
  return hash;
}

std::vector<PhysicalName> physical_names(std::string_view text) {
  std::vector<PhysicalName> names;
  std::istringstream section{std::string(text)};
  std::string line;
  std::getline(section, line);
  std::getline(section, line);
  while (std::getline(section, line)) {
    std::istringstream fields(line);
    PhysicalName entry;
    if (!(fields >> entry.dimension >> entry.tag)) continue;
    const auto open = line.find('"'), close = line.rfind('"');
    if (open == std::string::npos || close <= open) continue;
    entry.name = line.substr(open + 1, close - open - 1);
    names.push_back(entry);
  }
  return names;
}

}  // namespace

GmshFile read_gmsh(const std::string& path, std::string& fault) {
  GmshFile file;
  std::ifstream stream(path, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(path)) {
    fault = "-mesh_file: cannot read '" + path + "'; give the path of a gmsh file (MSH 4.1)";
    return file;
  }
  std::string bytes(std::filesystem::file_size(path), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  const auto head = bytes.find("$MeshFormat");
  if (head == std::string::npos || head > 4096 ||
      !(std::istringstream(bytes.substr(head + 11, 64)) >> file.version)) {
    fault = "-mesh_file: '" + path + "' is not a gmsh mesh; write one with gmsh -2 -format msh41";
    return file;
  }
  const GmshSections sections(bytes);
  GmshText text = read_gmsh_text(bytes, sections);
  if (!text.fault.empty()) fault = "mesh '" + path + "' " + text.fault;
  file.mesh = std::move(text.mesh);
  file.is_read = file.mesh.has_value();
  file.checksum = fnv1a(bytes);
  file.names = physical_names(sections.text("PhysicalNames"));
  file.has_periodic_section = sections.has("Periodic");
  return file;
}

std::string fault_in_names(const std::string& path, const std::vector<PhysicalName>& names) {
  static const std::vector<std::string> taken{"depth", "celltype", "vtk", "ghost", "dim", "pyre", "all"};
  if (std::none_of(names.begin(), names.end(), [](const auto& n) { return n.dimension == 2; }))
    return "mesh '" + path + "' names no region; add Physical Surface(\"matrix\") = {…}; to its geometry";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].name.empty() || names[i].name.find_first_of(" \t,:#'") != std::string::npos)
      return "mesh '" + path + "' has a physical group named '" + names[i].name +
             "', which no option can spell; use letters, digits, '-' and '_'";
    if (std::find(taken.begin(), taken.end(), names[i].name) != taken.end())
      return "mesh '" + path + "' has a physical group named '" + names[i].name +
             "', a name that has a meaning of its own; rename it";
    for (std::size_t j = 0; j < i; ++j)
      if (names[i].name == names[j].name)
        return "mesh '" + path + "' uses the name '" + names[i].name +
               "' for two physical groups; give each its own";
  }
  return "";
}

}  // namespace slipscale::mesh_stages
