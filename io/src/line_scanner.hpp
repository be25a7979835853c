// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hexact::io {

/// The thing that is being read, for messages: "facet 12". Built into a string only when something is wrong.
struct Element {
  const char* kind = nullptr;
  std::size_t number = 0;
  [[nodiscard]] std::string str() const {
    return kind == nullptr ? std::string() : std::string(kind) + " " + std::to_string(number);
  }
};

/// A word as it may stand in a message: quoted, short, printable.
[[nodiscard]] std::string quoted(std::string_view word);

/// An upper bound on the bytes that the numbers of one input may take, so that a small hostile file whose exponents
/// are long cannot fill the memory.
class NumberBudget {
 public:
  /// Throws ResourceLimit when the sum passes 2 GiB.
  void spend(const Rational& value, const std::string& file);

 private:
  std::uint64_t bytes_ = 0;
};

/// Text as lines of words. Lines are counted from 1; blank lines and comments are skipped.
class LineScanner {
 public:
  /// Where '#' starts a comment.
  enum class Comments { whole_lines, anywhere };

  LineScanner(std::string_view bytes, std::string name, Comments comments);

  /// Moves to the next line that holds a word; false at the end of the text.
  [[nodiscard]] bool next_line();
  /// The same where the format promises a line; `what` names it in the error.
  void expect_line(const char* what, Element element = {});
  [[nodiscard]] std::uint64_t line() const noexcept { return line_; }
  /// The next word of the line; empty at its end.
  [[nodiscard]] std::string_view word();
  /// A further word that must be there.
  [[nodiscard]] std::string_view expect_word(const char* what, Element element = {});
  /// Throws unless the line has been used up.
  void expect_end(Element element = {});
  /// Number of words that are left on the line.
  [[nodiscard]] std::size_t words_left() const;

  /// A finite coordinate: the exact decimal the word spells.
  [[nodiscard]] Rational coordinate(Element element);
  /// A number `p` or `p/q` of any length.
  [[nodiscard]] Rational rational(Element element);
  /// A number `p`, `p/q` or `p/q+r/s*sqrt5`.
  [[nodiscard]] QuadraticField quadratic(Element element);
  /// An integer of at most 18 digits, when the next word is one; the word is consumed only then.
  [[nodiscard]] std::optional<std::int64_t> small_integer();
  /// An integer in [low, high].
  [[nodiscard]] std::int64_t integer(const char* what, std::int64_t low, std::int64_t high, Element element = {});
  /// The number of `what` that follow, each of which takes at least `bytes_each` bytes of the rest of the text.
  [[nodiscard]] std::size_t count(const char* what, std::size_t bytes_each, std::int64_t high = 0xfffffffe);

  /// A place in the current line to come back to.
  struct Mark {
    std::size_t at;
  };
  [[nodiscard]] Mark mark() const noexcept { return {at_}; }
  void reset(Mark mark) noexcept { at_ = mark.at; }

  [[nodiscard]] std::size_t bytes_left() const noexcept { return text_.size() - next_; }
  /// Position of the first byte of this line.
  [[nodiscard]] std::size_t line_start() const noexcept { return line_start_; }
  /// Position of the first byte after this line.
  [[nodiscard]] std::size_t next_start() const noexcept { return next_; }
  /// The comment lines that were passed, without '#'.
  [[nodiscard]] const std::vector<std::string>& comments() const noexcept { return passed_comments_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  [[noreturn]] void fail(const std::string& message, Element element = {}) const;
  [[noreturn]] void fail_at(std::uint64_t line, const std::string& message, Element element = {}) const;

 private:
  std::string_view text_;
  std::string name_;
  Comments comment_style_;
  NumberBudget budget_;
  std::uint64_t line_ = 0;
  std::size_t line_start_ = 0;
  std::size_t next_ = 0;  ///< start of the next line
  std::size_t at_ = 0;    ///< reading position
  std::size_t end_ = 0;   ///< end of this line, or of its part before a comment
  std::vector<std::string> passed_comments_;
};

}  // namespace hexact::io
