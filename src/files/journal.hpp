#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace slipscale {

/// Bytes of a file by their place; they do not overlap.
using Extents = std::map<std::uint64_t, std::vector<std::byte>>;

/// Reads from an open file, zeros behind its end. False, with errno, when the system cannot.
bool read_at(int file, std::uint64_t at, std::size_t size, std::byte* to);
/// Writes all of it. False, with errno, when the system cannot.
bool write_at(int file, std::uint64_t at, std::size_t size, const std::byte* from);

/// The changes that take a file from one state to the next, in one piece: a header with sizes and checksum,
/// the places and lengths of what changes, the bytes.
class Journal {
 public:
  /// Of a file that has this size before it is changed.
  Journal(const Extents& changes, std::uint64_t size);
  /// From a file; absent when it is none, or not whole.
  static std::optional<Journal> read(int file);

  /// Where the journal of a file lies.
  static std::string path(const std::string& of);

  /// Writes it to an open file; false when that cannot be.
  bool save(int file) const;
  /// Makes a saved one none.
  static void strike(int file);
  /// Makes the changes; false, with errno, when that cannot be.
  bool apply(int file) const;
  std::uint64_t size() const;  ///< of the file before it is changed

 private:
  struct Header;
  struct Place;
  explicit Journal(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  Header header() const;
  std::uint64_t checksum() const;
  bool cut();
  bool whole() const;

  std::vector<std::byte> bytes_;
};

}  // namespace slipscale
