#include "object_header.hpp"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace slipscale {
namespace {

constexpr std::uint64_t most = 1 << 20;  ///< bytes of one block of a header
constexpr int most_blocks = 1000;
enum : std::uint64_t { layout = 8, continuation = 16 };

struct Block {
  std::uint64_t at, size;
};

std::uint64_t number(const std::vector<unsigned char>& bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int k = count; k-- > 0;) value = value << 8 | bytes[at + static_cast<std::size_t>(k)];
  return value;
}

std::vector<unsigned char> read(std::ifstream& file, const Block& block) {
  std::vector<unsigned char> bytes(block.size <= most ? block.size : 0);
  file.seekg(static_cast<std::streamoff>(block.at));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) bytes.clear();
  return bytes;
}

std::string name_of(hid_t object) {
  const ssize_t length = H5Fget_name(object, nullptr, 0);
  if (length <= 0) return "";
  std::string name(static_cast<std::size_t>(length) + 1, '\0');
  H5Fget_name(object, name.data(), name.size());
  name.pop_back();
  return name;
}

/// The lengths of the chunks in entries, the last one the size of a number in bytes; empty where there is no
/// such message.
std::vector<std::uint64_t> layout_of(hid_t dataset) {
  constexpr std::uint64_t prefix = 16;  ///< version, messages, references, size, padding
  H5O_info_t info{};
  if (H5Oget_info2(dataset, &info, H5O_INFO_BASIC) < 0) return {};
  std::ifstream file(name_of(dataset), std::ios::binary);
  const auto start = read(file, {info.addr, prefix});
  if (start.empty() || start[0] != 1) return {};
  std::vector<Block> blocks{{info.addr + prefix, number(start, 8, 4)}};
  for (std::size_t k = 0; k < blocks.size() && k < most_blocks; ++k) {
    const auto bytes = read(file, blocks[k]);
    for (std::size_t at = 0; at + 8 <= bytes.size();) {  // type, size, flags, padding, then what it says
      const std::uint64_t type = number(bytes, at, 2), size = number(bytes, at + 2, 2), said = at + 8;
      if (said + size > bytes.size()) break;
      if (type == continuation && size >= 16)
        blocks.push_back({number(bytes, said, 8), number(bytes, said + 8, 8)});
      if (type == layout && size >= 11 && bytes[said] == 3 && bytes[said + 1] == 2) {
        std::vector<std::uint64_t> lengths;
        for (std::uint64_t place = said + 11; place + 4 <= said + size && lengths.size() < bytes[said + 2];
             place += 4)
          lengths.push_back(number(bytes, place, 4));
        return lengths;
      }
      at = said + size;
    }
  }
  return {};
}

}  // namespace

bool chunks_are_sound(hid_t dataset) {
  const auto lengths = layout_of(dataset);
  if (lengths.empty()) return true;
  const Hdf5Type type(H5Dget_type(dataset));
  if (lengths.back() != H5Tget_size(type)) return false;
  const Hdf5Properties creation(H5Dget_create_plist(dataset));
  if (H5Pget_nfilters(creation) != 0) return true;
  hsize_t chunks = 0;
  const Hdf5Space space(H5Dget_space(dataset));
  if (H5Dget_num_chunks(dataset, space, &chunks) < 0) return false;
  const double bytes =
      std::accumulate(lengths.begin(), lengths.end(), static_cast<double>(chunks), std::multiplies<>());
  return bytes == static_cast<double>(H5Dget_storage_size(dataset));
}

}  // namespace slipscale
