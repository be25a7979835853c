// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads a certificate of a polyhedron: what it says, and whether its digest is right. Nothing is believed here.
#pragma once

#include "exact_signs.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace check {

// A file that cannot be read or is not what it should be; exit 3.
struct Malformed : std::runtime_error {
  Malformed(std::string file_, std::size_t line_, const std::string& what)
      : std::runtime_error(what), file(std::move(file_)), line(line_) {}
  std::string file;
  std::size_t line;  // 0: no line
};

struct Surface {
  std::vector<Index> start{0}, corner;          // facet f has the corners from start[f] to start[f + 1]
  std::vector<std::array<Index, 3>> triple;     // the defining planes of each vertex
  std::size_t facets() const { return start.size() - 1; }
  std::size_t size(std::size_t f) const { return start[f + 1] - start[f]; }
};

struct Address {
  Index level = 0, parent = kNone;
  friend bool operator==(const Address&, const Address&) = default;
};

struct Body {
  bool root5 = false, has_vertices = false;
  long scale = 0;
  std::array<mpq_class, 3> shift;
  Planes planes;
  std::vector<Address> address;
  Surface surface;
};

struct Claim {
  std::string name, reference;
};

struct Certificate {
  Body body;
  std::vector<Claim> claims;
  std::map<std::string, Body> bodies;
  std::map<std::string, std::map<std::size_t, std::size_t>> supports;  // of a body: plane → vertex of the solid
};

// Throws Malformed.
std::string read_file(const std::string& path);
Certificate read_certificate(const std::string& path);
Certificate parse_certificate(std::string_view bytes, const std::string& name);

// Where the last line begins, which is that of the digest; all bytes before it are signed.
std::size_t last_line(std::string_view bytes);
// Whether the last line begins with the word sha256.
bool has_digest(std::string_view bytes);

// Whether words run on over line ends and `#` starts a comment at each of them, as in meshes; or every line is a record of
// its own and a comment is a line that begins with `#`, as in certificates.
enum class Layout { words, lines };

// Splits text into words and counts the lines.
class Scanner {
 public:
  Scanner(std::string_view bytes, std::string file, Layout layout) : rest_(bytes), file_(std::move(file)), layout_(layout) {
    if (rest_.substr(0, 3) == "\xef\xbb\xbf") rest_.remove_prefix(3);  // a byte order mark
    if (layout_ == Layout::lines) skip_lines();
  }
  [[noreturn]] void fail(const std::string& what) const { throw Malformed(file_, line_, what); }
  std::string_view word();                                     // empty at the end, of the line or of the file
  void next_line();                                            // to the next that has words; of this one none may be left
  std::int64_t integer(std::int64_t low, std::int64_t high);   // the next word, an integer within these bounds
  std::size_t count();                                         // a number of things that may still follow
  Number number(std::string_view word, bool root5) const;      // p, p/q or p/q+r/s*sqrt5

 private:
  void skip_lines();
  mpq_class rational(std::string_view word) const;
  std::string_view rest_;
  std::string file_;
  Layout layout_;
  std::size_t line_ = 1;
};

}  // namespace check
