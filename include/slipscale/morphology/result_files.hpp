#pragma once

#include <string>
#include <vector>

namespace slipscale {

/// Files that belong together: each is written aside, and all come under their names only when the last one
/// stands on the disk. Until then the older files stay as they are.
class ResultFiles {
 public:
  explicit ResultFiles(std::string folder) : folder_(std::move(folder)) {}
  ~ResultFiles();  ///< takes away what was not published
  ResultFiles(const ResultFiles&) = delete;
  ResultFiles& operator=(const ResultFiles&) = delete;

  /// `write(path)` writes the file. Throws UserError when it does not reach the disk.
  template <class Write>
  void add(const std::string& name, const Write& write) {
    names_.push_back(name);
    write(aside(name));
    settle(aside(name));
  }

  void publish();

 private:
  std::string aside(const std::string& name) const { return folder_ + "/.partial." + name; }
  void settle(const std::string& path) const;

  std::string folder_;
  std::vector<std::string> names_;
};

/// Throws UserError when the text does not fit.
void write_text(const std::string& path, const std::string& text);

}  // namespace slipscale
