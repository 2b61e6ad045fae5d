#pragma once

#include <string>
#include <string_view>

#include "gmsh_fault.hpp"

namespace slipscale::mesh_stages {

/// Goes once through the bytes of a gmsh file, section by section and number by number, in text or binary.
/// Looks at everything before it is used: a damaged file leads nowhere but to a `GmshFault`.
class GmshStream {
 public:
  explicit GmshStream(std::string_view bytes)
      : begin_(bytes.data()), next_(begin_), end_(begin_ + bytes.size()) {}

  /// From here on numbers are binary: integers of 4 bytes, sizes and tags of 8, reals of 8.
  void set_binary() { binary_ = true; }
  bool is_binary() const { return binary_; }

  /// Enters the next section and returns its name; empty at the end of the file.
  std::string open();
  /// Leaves the section, which must end here.
  void close();
  /// Leaves the section wherever it ends; for sections that are of no use here.
  void skip();

  int integer();                ///< a dimension, or the tag of a curve, a surface or a group
  long size();                  ///< a count, or the tag of a node or an element
  double real();                ///< finite
  void skip_reals(long count);  ///< whatever they are
  /// A count of entries of at least `numbers` numbers each; refuses more than the file can hold.
  long count(int numbers);
  std::string_view line();  ///< the rest of the line, always text
  std::string_view word();  ///< the next word, always text

  [[noreturn]] void damaged(const std::string& what) const;
  [[noreturn]] void cut_short() const;

 private:
  template <class Number>
  Number text();
  template <class Number>
  Number raw();
  void skip_blanks();

  const char *begin_, *next_, *end_;
  std::string section_;
  bool binary_ = false;
};

}  // namespace slipscale::mesh_stages
