#include "msh_text.hpp"

#include <cstdint>
#include <sstream>

namespace slipscale::testing_support {
namespace {

/// Turns one section after the other, number by number.
class Binary {
 public:
  explicit Binary(const std::string& text) : in_(text) {}

  std::string run() {
    std::string word;
    while (in_ >> word) {
      out_ << word << '\n';
      if (word == "$MeshFormat") format();
      if (word == "$PhysicalNames") names();
      if (word == "$Entities") entities();
      if (word == "$Nodes") nodes();
      if (word == "$Elements") elements();
      if (word == "$Periodic") periods();
      in_ >> word;
      out_ << '\n' << word << '\n';
    }
    return out_.str();
  }

 private:
  template <class Number>
  Number put() {
    Number value{};
    in_ >> value;
    out_.write(reinterpret_cast<const char*>(&value), sizeof value);
    return value;
  }
  int integer() { return put<std::int32_t>(); }
  std::uint64_t size() { return put<std::uint64_t>(); }
  void reals(std::uint64_t count) {
    while (count-- > 0) put<double>();
  }

  void format() {
    std::string version, form, width;
    in_ >> version >> form >> width;
    out_ << version << " 1 " << width << '\n';
    const std::int32_t one = 1;
    out_.write(reinterpret_cast<const char*>(&one), sizeof one);
  }

  void names() {
    int count = 0;
    in_ >> count;
    out_ << count;
    std::string line;
    std::getline(in_, line);
    while (count-- > 0 && std::getline(in_, line)) out_ << '\n' << line;
  }

  void entities() {
    std::array<std::uint64_t, 4> counts{};
    for (auto& count : counts) count = size();
    for (int dimension = 0; dimension < 4; ++dimension)
      for (auto k = counts[dimension]; k > 0; --k) {
        integer();
        reals(dimension == 0 ? 3 : 6);
        for (auto tags = size(); tags > 0; --tags) integer();
        if (dimension > 0)
          for (auto sides = size(); sides > 0; --sides) integer();
      }
  }

  void nodes() {
    const auto blocks = size();
    size(), size(), size();
    for (auto block = blocks; block > 0; --block) {
      integer(), integer(), integer();
      const auto count = size();
      for (auto k = count; k > 0; --k) size();
      reals(3 * count);
    }
  }

  void elements() {
    const auto blocks = size();
    size(), size(), size();
    for (auto block = blocks; block > 0; --block) {
      integer(), integer();
      const int type = integer(), nodes = type == 15 ? 1 : type == 9 ? 6 : type == 8 ? 3 : type + 1;
      for (auto k = size(); k > 0; --k)
        for (int number = 0; number <= nodes; ++number) size();
    }
  }

  void periods() {
    for (auto links = size(); links > 0; --links) {
      integer(), integer(), integer();
      reals(size());
      for (auto pairs = size(); pairs > 0; --pairs) size(), size();
    }
  }

  std::istringstream in_;
  std::ostringstream out_;
};

}  // namespace

std::string binary(const std::string& text) { return Binary(text).run(); }

}  // namespace slipscale::testing_support
