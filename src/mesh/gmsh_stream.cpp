#include "gmsh_stream.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace slipscale::mesh_stages {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

void GmshStream::damaged(const std::string& what) const {
  throw GmshFault("is damaged: " + (section_.empty() ? "it" : "$" + section_) + " " + what + "; " +
                  write_again);
}

void GmshStream::cut_short() const {
  throw GmshFault("is cut short: " + (section_.empty() ? "its last section" : "$" + section_) +
                  " has no end; " + write_again);
}

void GmshStream::skip_blanks() {
  while (next_ != end_ && is_blank(*next_)) ++next_;
}

std::string_view GmshStream::word() {
  skip_blanks();
  const char* begin = next_;
  while (next_ != end_ && !is_blank(*next_)) ++next_;
  return {begin, next_};
}

std::string_view GmshStream::line() {
  const auto* stop =
      static_cast<const char*>(std::memchr(next_, '\n', static_cast<std::size_t>(end_ - next_)));
  if (!stop) cut_short();
  std::string_view text{next_, stop};
  if (text.ends_with('\r')) text.remove_suffix(1);
  next_ = stop + 1;
  return text;
}

std::string GmshStream::open() {
  section_.clear();
  skip_blanks();
  if (next_ == end_) return "";
  if (*next_ != '$') damaged("holds something outside its sections");
  ++next_;
  const std::string name(word());
  if (name.empty() || name.size() > 64 || name.starts_with("End"))
    damaged("has a section that ends before it begins");
  section_ = name;
  line();
  return name;
}

void GmshStream::close() {
  skip_blanks();
  if (next_ == end_) cut_short();
  if (word() != "$End" + section_) damaged("holds more than it announces");
}

void GmshStream::skip() {
  const std::string mark = "$End" + section_;
  const std::string_view rest{next_, end_};
  for (auto at = rest.find(mark); at != rest.npos; at = rest.find(mark, at + 1)) {
    const auto behind = at + mark.size();
    if ((at > 0 && rest[at - 1] != '\n') || (behind < rest.size() && !is_blank(rest[behind]))) continue;
    next_ += behind;
    return;
  }
  cut_short();
}

template <class Number>
Number GmshStream::text() {
  skip_blanks();
  if (next_ == end_) cut_short();
  Number value{};
  const auto [stop, code] = std::from_chars(next_, end_, value);
  if (code != std::errc{} || (stop != end_ && !is_blank(*stop)))
    damaged(*next_ == '$' ? "holds fewer entries than it announces" : "holds something that is not a number");
  next_ = stop;
  return value;
}

template <class Number>
Number GmshStream::raw() {
  Number value{};
  if (end_ - next_ < static_cast<std::ptrdiff_t>(sizeof value)) cut_short();
  std::memcpy(&value, next_, sizeof value);
  next_ += sizeof value;
  return value;
}

int GmshStream::integer() { return binary_ ? raw<std::int32_t>() : text<int>(); }

long GmshStream::size() { return binary_ ? static_cast<long>(raw<std::uint64_t>()) : text<long>(); }

double GmshStream::real() {
  const double value = binary_ ? raw<double>() : text<double>();
  if (!std::isfinite(value)) damaged("holds something that is not a number");
  return value;
}

void GmshStream::skip_reals(long count) {
  for (long k = 0; k < count; ++k) binary_ ? raw<double>() : text<double>();
}

long GmshStream::count(int numbers) {
  const long value = size();
  if (value < 0 || value > (end_ - next_) / (numbers * (binary_ ? 4 : 2)))
    damaged("announces more than it can hold");
  return value;
}

}  // namespace slipscale::mesh_stages
