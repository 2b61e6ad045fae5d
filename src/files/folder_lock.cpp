#include "slipscale/files/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

int open_file(const std::string& path) {
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) throw LibraryError(std::strerror(errno));
  return file;
}

/// Whether the file is still the one of that name: its last owner removes it.
bool still_there(int file, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

std::string holder(int file) {
  std::array<char, 256> text{};
  const ssize_t length = pread(file, text.data(), text.size() - 1, 0);
  return length > 0 ? " (" + std::string(text.data(), static_cast<std::size_t>(length)) + ")" : "";
}

/// For the sentence to whoever comes second.
void write_name(int file) {
  std::array<char, 128> host{};
  (void)gethostname(host.data(), host.size() - 1);
  const std::string name = format("process {} on {}", static_cast<int>(getpid()), host.data());
  if (ftruncate(file, 0) == 0) (void)!pwrite(file, name.data(), name.size(), 0);
}

}  // namespace

FolderLock::FolderLock(const std::string& folder) : path_(folder + "/.slipscale-lock") {
  for (;;) {
    file_ = open_file(path_);
    if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const std::string who = holder(file_);
      close(file_);
      throw UserError("-output_folder '" + folder + "' belongs to a run that still goes on" + who +
                      "; wait for it or give another folder");
    }
    if (still_there(file_, path_)) break;
    close(file_);
  }
  write_name(file_);
}

FolderLock::~FolderLock() {
  if (still_there(file_, path_)) (void)unlink(path_.c_str());
  close(file_);
}

}  // namespace slipscale
