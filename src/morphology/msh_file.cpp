#include "msh_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

/// The rest of the file from where the stream stands, with the pairs of each periodic link sorted.
std::string sorted_links(std::istream& in) {
  std::string text, line;
  std::getline(in, line);
  text += line + "\n";
  const long links = std::stol(line);
  for (long link = 0; link < links; ++link) {
    for (int header = 0; header < 3; ++header) {  // entities, affine map, number of pairs
      std::getline(in, line);
      text += line + "\n";
    }
    std::vector<std::pair<long, long>> pairs(static_cast<std::size_t>(std::stol(line)));
    for (auto& [node, master] : pairs) in >> node >> master;
    in.ignore(1, '\n');
    std::ranges::sort(pairs);
    for (const auto& [node, master] : pairs)
      text += std::to_string(node) + " " + std::to_string(master) + "\n";
  }
  while (std::getline(in, line)) text += line + "\n";
  return text;
}

}  // namespace

void sort_periodic_pairs(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  while (std::getline(in, line) && line != "$Periodic") {
  }
  if (!in) return;
  const auto begin = in.tellg();
  const std::string sorted = sorted_links(in);
  in.close();
  errno = 0;
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(begin));
  std::ofstream out(path, std::ios::app);
  if (!(out << sorted << std::flush)) refuse_unwritten(path);
}

namespace {

/// Lines between the section's first, which was read, and its end.
long lines_of_section(std::istream& in, const std::string& end) {
  long count = 0;
  for (std::string line; std::getline(in, line); ++count)
    if (line == end) return count;
  return -1;
}

}  // namespace

void refuse_cut_short(const std::string& path) {
  std::ifstream in(path);
  int sections = 0;
  for (std::string line; std::getline(in, line);) {
    const bool nodes = line == "$Nodes";
    if (!nodes && line != "$Elements") continue;
    ++sections;
    long blocks = 0, total = 0;
    if (!std::getline(in, line)) break;
    std::istringstream(line) >> blocks >> total;
    // Nodes have a line for the number and one for the place.
    if (lines_of_section(in, nodes ? "$EndNodes" : "$EndElements") != blocks + (nodes ? 2 : 1) * total)
      refuse_unwritten(path);
  }
  if (sections != 2) refuse_unwritten(path);
}

void refuse_unwritten(const std::string& path) {
  const std::filesystem::path file(path);
  std::error_code code;
  const auto room = std::filesystem::space(file.parent_path(), code);
  const bool full = !code && room.available < 64 * 1024;
  throw UserError("-output_folder '" + file.parent_path().string() + "' cannot take the files: " +
                  (full || errno == 0 ? std::string("the disk is full") : std::string(std::strerror(errno))) +
                  "; free some space, or name another folder");
}

}  // namespace slipscale
