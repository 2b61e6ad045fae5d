#pragma once

#include <string_view>
#include <vector>

namespace slipscale::mesh_stages {

/// Where the sections of a gmsh file begin and end. The file's bytes must outlive it.
class GmshSections {
 public:
  explicit GmshSections(std::string_view bytes);

  bool has(std::string_view name) const { return find(name) != nowhere; }
  bool is_cut(std::string_view name) const { return has(name) && end(name) == nowhere; }  ///< has no end
  /// What stands between "$Name" and "$EndName"; empty when the file has no such section or not its end.
  std::string_view text(std::string_view name) const;
  std::vector<std::string_view> names() const;  ///< as they come

 private:
  struct Mark {
    std::size_t at;         ///< of the $
    std::string_view word;  ///< behind it
  };
  static constexpr std::size_t nowhere = std::string_view::npos;

  std::size_t find(std::string_view name, std::size_t from = 0) const;  ///< index into marks_
  std::size_t end(std::string_view name) const;

  std::string_view bytes_;
  std::vector<Mark> marks_;
};

}  // namespace slipscale::mesh_stages
