// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line_scanner.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexact::io {
namespace {

constexpr std::uint64_t kNumberBytes = std::uint64_t{1} << 31;

[[nodiscard]] bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

[[nodiscard]] bool has_only(std::string_view word, std::string_view allowed) {
  return word.find_first_not_of(allowed) == std::string_view::npos;
}

/// Number of digits from which an integer may be beyond the largest double, about 1.8e308.
constexpr std::size_t kDigitsOfLargest = 309;

[[nodiscard]] bool beyond_double(const Rational& value, std::size_t length) {
  return length >= kDigitsOfLargest && !std::isfinite(value.to_double());
}

}  // namespace

std::string quoted(std::string_view word) {
  constexpr std::size_t kShown = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kShown)) text += c >= 32 && c < 127 ? c : '?';
  return text + (word.size() > kShown ? "…'" : "'");
}

void NumberBudget::spend(const Rational& value, const std::string& file) {
  bytes_ += 32 + 8 * (mpz_size(mpq_numref(value.raw())) + mpz_size(mpq_denref(value.raw())));
  if (bytes_ > kNumberBytes) throw ResourceLimit(file + ": the exact numbers of this file need more than 2 GiB");
}

LineScanner::LineScanner(std::string_view bytes, std::string name, Comments comments)
    : text_(bytes), name_(std::move(name)), comment_style_(comments) {
  if (text_.starts_with("\xef\xbb\xbf")) next_ = 3;  // a byte order mark
}

bool LineScanner::next_line() {
  while (next_ < text_.size()) {
    ++line_;
    line_start_ = at_ = next_;
    const std::size_t newline = text_.find('\n', at_);
    end_ = newline == std::string_view::npos ? text_.size() : newline;
    next_ = newline == std::string_view::npos ? text_.size() : newline + 1;
    while (at_ < end_ && is_blank(text_[at_])) ++at_;
    if (at_ == end_) continue;
    if (text_[at_] == '#') {
      std::string_view comment = text_.substr(at_ + 1, end_ - at_ - 1);
      if (comment.starts_with(' ')) comment.remove_prefix(1);
      while (comment.ends_with('\r')) comment.remove_suffix(1);
      if (comment_style_ == Comments::whole_lines) passed_comments_.emplace_back(comment);
      continue;
    }
    if (comment_style_ == Comments::anywhere) end_ = at_ + std::min(text_.substr(at_, end_ - at_).find('#'), end_ - at_);
    return true;
  }
  ++line_;  // what is missing would stand on the line after the last
  line_start_ = at_ = end_ = next_;
  return false;
}

void LineScanner::expect_line(const char* what, Element element) {
  if (!next_line()) fail(std::string("the file ends where ") + what + " is expected", element);
}

std::string_view LineScanner::word() {
  while (at_ < end_ && is_blank(text_[at_])) ++at_;
  const std::size_t start = at_;
  while (at_ < end_ && !is_blank(text_[at_])) ++at_;
  return text_.substr(start, at_ - start);
}

std::string_view LineScanner::expect_word(const char* what, Element element) {
  const std::string_view found = word();
  if (found.empty()) fail(std::string("the line ends where ") + what + " is expected", element);
  return found;
}

void LineScanner::expect_end(Element element) {
  if (const std::string_view extra = word(); !extra.empty()) {
    fail("expected the end of the line, found " + quoted(extra), element);
  }
}

std::size_t LineScanner::words_left() const {
  std::size_t words = 0;
  for (std::size_t i = at_; i < end_; ++i) {
    if (!is_blank(text_[i]) && (i == at_ || is_blank(text_[i - 1]))) ++words;
  }
  return words;
}

Rational LineScanner::coordinate(Element element) {
  const std::string_view found = expect_word("a number", element);
  Rational value;
  Rational::ParseResult result = Rational::ParseResult::malformed;
  if (found.find('/') == std::string_view::npos) result = Rational::parse(found, value);
  switch (result) {
    case Rational::ParseResult::ok:
      if (!beyond_double(value, found.size())) break;
      [[fallthrough]];
    case Rational::ParseResult::out_of_range:
      fail("the number " + quoted(found) + " is beyond the range of a double", element);
    case Rational::ParseResult::not_finite:
      fail("the number " + quoted(found) + " is not finite", element);
    case Rational::ParseResult::malformed:
      fail("expected a number, found " + quoted(found), element);
  }
  budget_.spend(value, name_);
  return value;
}

Rational LineScanner::rational(Element element) {
  if (const auto small = small_integer()) return Rational(static_cast<long long>(*small));
  const std::string_view found = expect_word("a number", element);
  Rational value;
  if (!has_only(found, "+-0123456789/") || Rational::parse(found, value) != Rational::ParseResult::ok) {
    fail("expected a number p or p/q, found " + quoted(found), element);
  }
  budget_.spend(value, name_);
  return value;
}

QuadraticField LineScanner::quadratic(Element element) {
  if (const auto small = small_integer()) return QuadraticField(static_cast<long long>(*small));
  const std::string_view found = expect_word("a number", element);
  QuadraticField value;
  if (!has_only(found, "+-0123456789/*sqrt") || !QuadraticField::parse(found, value)) {
    fail("expected a number p, p/q or p/q+r/s*sqrt5, found " + quoted(found), element);
  }
  budget_.spend(value.rational_part(), name_);
  budget_.spend(value.sqrt5_part(), name_);
  return value;
}

std::optional<std::int64_t> LineScanner::small_integer() {
  constexpr std::size_t kDigits = 18;
  while (at_ < end_ && is_blank(text_[at_])) ++at_;
  std::size_t i = at_;
  const bool negative = i < end_ && text_[i] == '-';
  if (i < end_ && (text_[i] == '-' || text_[i] == '+')) ++i;
  const std::size_t first = i;
  std::int64_t value = 0;
  while (i < end_ && i - first < kDigits && text_[i] >= '0' && text_[i] <= '9') value = 10 * value + (text_[i++] - '0');
  if (i == first || (i < end_ && !is_blank(text_[i]))) return std::nullopt;
  at_ = i;
  return negative ? -value : value;
}

std::int64_t LineScanner::integer(const char* what, std::int64_t low, std::int64_t high, Element element) {
  while (at_ < end_ && is_blank(text_[at_])) ++at_;
  const std::size_t before = at_;
  // A count or an index has no sign, not even that of -0.
  const bool is_signed = at_ < end_ && (text_[at_] == '-' || text_[at_] == '+');
  const auto value = small_integer();
  if (value && *value >= low && *value <= high && (low < 0 || !is_signed)) return *value;
  at_ = before;
  const std::string_view found = expect_word(what, element);
  fail(std::string("expected ") + what + " from " + std::to_string(low) + " to " + std::to_string(high) + ", found " +
           quoted(found), element);
}

std::size_t LineScanner::count(const char* what, std::size_t bytes_each, std::int64_t high) {
  const std::string number = std::string("the number of ") + what;
  const auto value = static_cast<std::size_t>(integer(number.c_str(), 0, high));
  // The last line may lack its newline.
  if (value > (bytes_left() + 1) / bytes_each) {
    fail(std::to_string(value) + " " + what + " are announced, but only " + std::to_string(bytes_left()) +
         " bytes follow");
  }
  return value;
}

void LineScanner::fail(const std::string& message, Element element) const { fail_at(line_, message, element); }

void LineScanner::fail_at(std::uint64_t line, const std::string& message, Element element) const {
  const std::string text = element.str();
  throw ParseError(text.empty() ? message : text + ": " + message, name_, line, text);
}

}  // namespace hexact::io
