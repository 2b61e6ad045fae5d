#include "slipscale/morphology/result_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "msh_file.hpp"

namespace slipscale {

void write_text(const std::string& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path);
  if (!(file << text << std::flush)) refuse_unwritten(path);
}

ResultFiles::~ResultFiles() {
  std::error_code code;
  for (const std::string& name : names_) std::filesystem::remove(aside(name), code);
}

void ResultFiles::publish() {
  for (const std::string& name : names_) {
    std::error_code code;
    std::filesystem::rename(aside(name), folder_ + "/" + name, code);
    if (code) {
      errno = code.value();
      refuse_unwritten(folder_ + "/" + name);
    }
  }
  names_.clear();
}

/// A file system may take bytes that it finds no room for later.
void ResultFiles::settle(const std::string& path) const {
  errno = 0;
  const int file = open(path.c_str(), O_RDONLY);
  if (file < 0) refuse_unwritten(path);
  const bool settled = fsync(file) == 0 || errno == EINVAL;
  const off_t size = lseek(file, 0, SEEK_END);
  close(file);
  if (!settled || size == 0) refuse_unwritten(path);
}

}  // namespace slipscale
