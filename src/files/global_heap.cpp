#include "global_heap.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <string_view>

namespace slipscale {
namespace {

/// The bytes of a file, none where it cannot be read.
class FileBytes {
 public:
  explicit FileBytes(const std::string& path) {
    const int file = open(path.c_str(), O_RDONLY);
    if (file < 0) return;
    struct stat about {};
    if (fstat(file, &about) == 0 && about.st_size > 0) {
      void* const found =
          mmap(nullptr, static_cast<std::size_t>(about.st_size), PROT_READ, MAP_PRIVATE, file, 0);
      if (found != MAP_FAILED)
        bytes_ = {static_cast<const char*>(found), static_cast<std::size_t>(about.st_size)};
    }
    close(file);
  }
  ~FileBytes() {
    if (!bytes_.empty()) munmap(const_cast<char*>(bytes_.data()), bytes_.size());
  }
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  std::string_view all() const { return bytes_; }

 private:
  std::string_view bytes_;
};

template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  Number number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

constexpr std::size_t header = 16;  ///< of a heap, and of an object in it

bool is_sound(std::string_view rest) {
  if (rest.size() < header) return false;
  const auto size = number_at<std::uint64_t>(rest, 8);
  if (size < header || size > rest.size()) return false;
  std::size_t at = header;
  while (at + header <= size) {
    const auto index = number_at<std::uint16_t>(rest, at);
    const auto object = number_at<std::uint64_t>(rest, at + 8);
    if (object > size) return false;
    // Number 0 is what is free, and counts its header.
    const std::uint64_t step = index == 0 ? object : header + (object + 7) / 8 * 8;
    if (step < header || step > size - at) return false;
    at += step;
  }
  return true;
}

}  // namespace

bool global_heaps_are_sound(const std::string& path) {
  constexpr std::string_view begin("GCOL\1\0\0\0", 8);
  const FileBytes file(path);
  if (file.all().empty()) return false;
  for (auto at = file.all().find(begin); at != std::string_view::npos; at = file.all().find(begin, at + 1))
    if (!is_sound(file.all().substr(at))) return false;
  return true;
}

}  // namespace slipscale
