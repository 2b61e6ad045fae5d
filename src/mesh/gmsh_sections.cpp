#include "gmsh_sections.hpp"

#include <string>

namespace slipscale::mesh_stages {

GmshSections::GmshSections(std::string_view bytes) : bytes_(bytes) {
  for (auto at = bytes.find('$'); at != nowhere; at = bytes.find('$', at + 1)) {
    if (at > 0 && bytes[at - 1] != '\n') continue;
    const auto stop = bytes.find_first_of(" \r\n", at + 1);
    marks_.push_back({at, bytes.substr(at + 1, stop == nowhere ? nowhere : stop - at - 1)});
  }
}

std::size_t GmshSections::find(std::string_view name, std::size_t from) const {
  for (std::size_t k = from; k < marks_.size(); ++k)
    if (marks_[k].word == name) return k;
  return nowhere;
}

std::size_t GmshSections::end(std::string_view name) const {
  return find("End" + std::string(name), find(name));
}

std::string_view GmshSections::text(std::string_view name) const {
  if (!has(name) || is_cut(name)) return {};
  const Mark& open = marks_[find(name)];
  const std::size_t begin = open.at + 1 + open.word.size();
  return bytes_.substr(begin, marks_[end(name)].at - begin);
}

std::vector<std::string_view> GmshSections::names() const {
  std::vector<std::string_view> names;
  for (const Mark& mark : marks_)
    if (!mark.word.starts_with("End")) names.push_back(mark.word);
  return names;
}

}  // namespace slipscale::mesh_stages
