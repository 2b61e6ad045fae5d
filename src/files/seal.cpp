#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "slipscale/base/checksum.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/files/state_file.hpp"

namespace slipscale {
namespace {

constexpr std::size_t seal_bytes = 33;  ///< "slipscale fnv1a:0123456789abcdef\n"

struct Closing {
  void operator()(std::FILE* file) const { (void)std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, Closing>;

std::string seal_of(std::FILE* file, long bytes) {
  std::array<char, 1 << 16> piece;
  Checksum sum;
  std::rewind(file);
  while (bytes > 0) {
    const auto wanted = std::min<std::size_t>(piece.size(), static_cast<std::size_t>(bytes));
    if (std::fread(piece.data(), 1, wanted, file) != wanted) return "";
    sum.add(piece.data(), wanted);
    bytes -= static_cast<long>(wanted);
  }
  return "slipscale " + checksum_text(sum.value()) + "\n";
}

long size_of(std::FILE* file) {
  (void)std::fseek(file, 0, SEEK_END);
  return std::ftell(file);
}

}  // namespace

void seal(const std::string& path) {
  const OpenFile file(std::fopen(path.c_str(), "r+b"));
  if (!file) throw LibraryError(std::strerror(errno));
  const std::string text = seal_of(file.get(), size_of(file.get()));
  (void)std::fseek(file.get(), 0, SEEK_END);
  if (text.size() != seal_bytes || std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
      std::fflush(file.get()) != 0)
    throw LibraryError(std::strerror(errno));
}

bool is_sealed(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return false;
  const OpenFile file(std::fopen(path.c_str(), "rb"));
  if (!file) return false;
  const long bytes = size_of(file.get()) - static_cast<long>(seal_bytes);
  if (bytes < 0) return false;
  const std::string wanted = seal_of(file.get(), bytes);
  std::array<char, seal_bytes> found{};
  (void)std::fseek(file.get(), bytes, SEEK_SET);
  return std::fread(found.data(), 1, found.size(), file.get()) == found.size() &&
         std::string(found.data(), found.size()) == wanted;
}

}  // namespace slipscale
