// SPDX-License-Identifier: LGPL-3.0-or-later
#include "certificate_text.hpp"

#include "sha256.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <future>
#include <memory>

namespace check {
namespace {

using Text = std::string_view;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
bool is_space(char c) { return c == '\n' || is_blank(c); }

bool whole_integer(Text w, std::int64_t& x) {
  const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), x);
  return !w.empty() && error == std::errc() && end == w.data() + w.size();
}

void read_plane(Scanner& in, Body& b) {
  std::array<Text, 4> words;
  Row row{};
  bool is_short = true;
  for (std::size_t k = 0; k < 4; ++k) {
    words[k] = in.word();
    is_short = is_short && whole_integer(words[k], row[k]) && magnitude(row[k]) < (std::uint64_t{1} << 62);
  }
  if (is_short) {
    if (row[0] == 0 && row[1] == 0 && row[2] == 0) in.fail("a plane without a normal");
    b.planes.add(row);
  } else {
    Plane p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = in.number(words[k], b.root5);
    if (is_zero(p[0]) && is_zero(p[1]) && is_zero(p[2])) in.fail("a plane without a normal");
    b.planes.add(p);
  }
  const auto level = static_cast<Index>(in.integer(0, kNone - 1));
  const Text word = in.word();
  Index parent = kNone;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), parent);
  if (word != "-" && (word.empty() || error != std::errc() || end != word.data() + word.size() || parent == kNone)) {
    in.fail("expected a vertex number or -, found " + std::string(word));
  }
  b.address.push_back({level, parent});
}

void read_loops(Scanner& in, Body& b) {
  Surface& s = b.surface;
  if (in.count() != b.planes.size()) in.fail("one loop for each plane is expected");
  s.start.reserve(b.planes.size() + 1);
  s.corner.reserve(6 * b.planes.size());
  for (std::size_t f = 0; f < b.planes.size(); ++f) {
    in.next_line();
    const std::size_t size = in.count();
    if (size == 1 || size == 2) in.fail("a facet needs 3 corners");
    for (std::size_t k = 0; k < size; ++k) s.corner.push_back(static_cast<Index>(in.integer(0, 1 << 30)));
    s.start.push_back(static_cast<Index>(s.corner.size()));
  }
}

// The first word of the next line.
Text next_keyword(Scanner& in) {
  in.next_line();
  return in.word();
}

void need(const Scanner& in, Text keyword, Text expected) {
  if (keyword != expected) in.fail("expected " + std::string(expected) + ", found " + std::string(keyword));
}

// Field, scale, shift: up to the line `planes`, whose keyword is read.
void read_frame(Scanner& in, Body& b) {
  need(in, next_keyword(in), "field");
  const Text field = in.word();
  if (field != "Q" && field != "Q(sqrt5)") in.fail("unknown field " + std::string(field));
  b.root5 = field != "Q";
  need(in, next_keyword(in), "scale");
  b.scale = static_cast<long>(in.integer(-100000, 100000));
  Text keyword = next_keyword(in);
  if (keyword == "shift") {
    for (mpq_class& x : b.shift) {
      x = in.number(in.word(), false).a;
      if (mpz_scan1(x.get_den_mpz_t(), 0) + 1 != mpz_sizeinbase(x.get_den_mpz_t(), 2)) in.fail("a shift must be dyadic");
    }
    keyword = next_keyword(in);
  }
  need(in, keyword, "planes");
}

// A body, from the line behind this one. The keyword of the first line that is none of its own.
Text read_body(Scanner& in, Body& b) {
  read_frame(in, b);
  const std::size_t n = in.count();
  b.planes.reserve(n);
  b.address.reserve(n);
  for (std::size_t i = 0; i < n; ++i) in.next_line(), read_plane(in, b);
  need(in, next_keyword(in), "loops");
  read_loops(in, b);
  const Text keyword = next_keyword(in);
  if (keyword != "vertices") return keyword;
  b.has_vertices = true;
  b.surface.triple.resize(in.count());
  const auto last = static_cast<std::int64_t>(b.planes.size()) - 1;
  for (auto& t : b.surface.triple) {
    in.next_line();
    for (Index& f : t) f = static_cast<Index>(in.integer(0, last));
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) in.fail("the three defining planes must differ");
  }
  return next_keyword(in);
}

// Every loop names vertices that exist; without `vertices` the three facets of each vertex define it.
void finish(const Scanner& in, Body& b) {
  Surface& s = b.surface;
  const std::size_t named = s.corner.empty() ? 0 : std::size_t{*std::max_element(s.corner.begin(), s.corner.end())} + 1;
  if (b.has_vertices ? named > s.triple.size() : named > s.corner.size()) in.fail("a loop names a vertex that does not exist");
  if (b.has_vertices) return;
  s.triple.assign(named, {kNone, kNone, kNone});
  std::vector<unsigned char> filled(named, 0);
  for (std::size_t f = 0; f < s.facets(); ++f) {
    for (Index h = s.start[f]; h < s.start[f + 1]; ++h) {
      unsigned char& k = filled[s.corner[h]];
      if (k == 3) in.fail("without vertices every vertex lies on exactly three facets");
      s.triple[s.corner[h]][k++] = static_cast<Index>(f);
    }
  }
  for (const unsigned char k : filled) {
    if (k != 3) in.fail("without vertices every vertex lies on exactly three facets");
  }
}

Claim read_claim(Scanner& in) {
  const std::string word(in.word()), name = word.substr(0, word.find('='));
  const bool about = name == "inside" || name == "tangent" || name == "corner-cut-of";
  if (!about && word != "closed" && word != "planar" && word != "trivalent" && word != "convex" && word != "embedded" &&
      word != "smooth-limit") {
    in.fail("unknown claim " + word);
  }
  if (about && word.size() < name.size() + 2) in.fail("claim " + name + " needs a body");
  return {name, about ? word.substr(name.size() + 1) : ""};
}

void check_names(const Scanner& in, const Certificate& c) {
  for (const Claim& claim : c.claims) {
    if (!claim.reference.empty() && !c.bodies.count(claim.reference)) in.fail("there is no body " + claim.reference);
  }
  for (const auto& [name, list] : c.supports) {
    const auto body = c.bodies.find(name);
    if (body == c.bodies.end()) in.fail("a support names body " + name + ", which does not exist");
    for (const auto& [plane, vertex] : list) {
      if (plane >= body->second.planes.size()) in.fail("a support names plane " + std::to_string(plane) + ", which does not exist");
      if (vertex >= c.body.surface.triple.size()) in.fail("a support names vertex " + std::to_string(vertex) + ", which does not exist");
    }
  }
}

Certificate parse(Scanner& in, std::string& digest) {
  if (in.word() != "hexact-certificate") in.fail("is no certificate; `hexact certify` makes one");
  if (in.word() != "1") in.fail("only version 1 is known");
  Certificate c;
  for (Text w = read_body(in, c.body); w != "sha256";) {
    if (w.empty()) in.fail("the digest is missing");
    if (w == "body") {
      const Text name = in.word();
      if (name.empty()) in.fail("a body without a name");
      const auto [it, is_new] = c.bodies.try_emplace(std::string(name));
      if (!is_new) in.fail("a second body of that name");
      w = read_body(in, it->second);
      continue;
    }
    if (w == "claim") {
      c.claims.push_back(read_claim(in));
    } else if (w == "support") {
      auto& list = c.supports[std::string(in.word())];
      const auto plane = static_cast<std::size_t>(in.integer(0, kNone)), vertex = static_cast<std::size_t>(in.integer(0, kNone));
      list.emplace(plane, vertex);  // the first one counts
    } else {
      in.fail("unexpected " + std::string(w));
    }
    w = next_keyword(in);
  }
  finish(in, c.body);
  for (auto& [name, b] : c.bodies) finish(in, b);
  check_names(in, c);
  digest = std::string(in.word());
  in.next_line();
  if (!in.word().empty()) in.fail("bytes follow the digest");
  return c;
}

}  // namespace

std::string read_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  std::string bytes;
  if (file && std::fseek(file.get(), 0, SEEK_END) == 0) {
    const long size = std::ftell(file.get());
    if (size > 0 && size < (1L << 40)) bytes.reserve(static_cast<std::size_t>(size));
    std::rewind(file.get());
  }
  std::array<char, 1 << 16> block;
  for (std::size_t n = 1; file && n > 0;) {
    n = std::fread(block.data(), 1, block.size(), file.get());
    bytes.append(block.data(), n);
  }
  if (!file || std::ferror(file.get()) != 0) throw Malformed(path, 0, "cannot be read");
  if (bytes.empty()) throw Malformed(path, 0, "is empty");
  return bytes;
}

Certificate read_certificate(const std::string& path) { return parse_certificate(read_file(path), path); }

Certificate parse_certificate(std::string_view bytes, const std::string& name) {
  const Text signed_bytes = bytes.substr(0, last_line(bytes));
  auto expected = std::async(std::launch::async, [&] { return sha256(signed_bytes); });  // half the time of reading
  Scanner in(bytes, name, Layout::lines);
  std::string digest;
  Certificate c = parse(in, digest);
  if (!has_digest(bytes)) in.fail("bytes follow the digest");
  if (expected.get() != digest) in.fail("the digest does not match: the file was changed");
  if (c.claims.empty()) throw Malformed(name, 0, "has no claims; `hexact certify` adds them");
  return c;
}

std::size_t last_line(std::string_view bytes) {
  if (!bytes.empty() && bytes.back() == '\n') bytes.remove_suffix(1);
  return bytes.rfind('\n') + 1;  // 0 if there is none
}

bool has_digest(std::string_view bytes) {
  std::string_view line = bytes.substr(last_line(bytes));
  while (!line.empty() && is_space(line[0])) line.remove_prefix(1);
  return line.substr(0, 6) == "sha256";
}

std::string_view Scanner::word() {
  if (layout_ == Layout::words) skip_lines();
  const char *p = rest_.data(), *const end = p + rest_.size();
  while (p != end && is_blank(*p)) ++p;
  const char* const begin = p;
  while (p != end && !is_space(*p)) ++p;
  rest_ = {p, static_cast<std::size_t>(end - p)};
  return {begin, static_cast<std::size_t>(p - begin)};
}

void Scanner::next_line() {
  if (const Text extra = word(); !extra.empty()) fail("expected the end of the line, found " + std::string(extra));
  skip_lines();
}

// Over spaces, line ends and comments to the next word.
void Scanner::skip_lines() {
  const char *p = rest_.data(), *const end = p + rest_.size();
  for (; p != end && (is_space(*p) || *p == '#'); p += p != end ? 1 : 0) {
    if (*p == '#') p = std::find(p, end, '\n');
    if (p == end) break;
    if (*p == '\n') ++line_;
  }
  rest_ = {p, static_cast<std::size_t>(end - p)};
}

std::int64_t Scanner::integer(std::int64_t low, std::int64_t high) {
  const Text w = word();
  // A count or an index has no sign, and no integer more than 18 digits.
  const bool has_sign = !w.empty() && (w[0] == '-' || w[0] == '+');
  const Text digits = w.substr(has_sign ? 1 : 0);
  std::int64_t x = 0;
  if (digits.size() > 18 || digits.substr(0, 1) == "-" || !whole_integer(digits, x) || (has_sign && low >= 0)) x = low - 1;
  else if (has_sign && w[0] == '-') x = -x;
  if (x < low || x > high) {
    fail("expected an integer from " + std::to_string(low) + " to " + std::to_string(high) + ", found " + std::string(w));
  }
  return x;
}

std::size_t Scanner::count() {
  return static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(std::min<std::size_t>(rest_.size(), 1u << 31))));
}

Number Scanner::number(Text w, bool root5) const {
  const Text tail = "*sqrt5";
  if (!root5 || w.size() <= tail.size() || w.substr(w.size() - tail.size()) != tail) return Number(rational(w));
  const Text both = w.substr(0, w.size() - tail.size());
  const std::size_t split = both.find_last_of("+-");
  if (split == Text::npos || split == 0) return Number(0, rational(both));
  return Number(rational(both.substr(0, split)), rational(both[split] == '+' ? both.substr(split + 1) : both.substr(split)));
}

mpq_class Scanner::rational(Text w) const {
  const std::size_t slash = w.find('/');
  Text p = w.substr(0, slash), q = slash == Text::npos ? "1" : w.substr(slash + 1);
  if (p.size() > 1 && p[0] == '+' && p[1] != '-') p.remove_prefix(1);
  const auto digits = [](Text t) { return !t.empty() && t.find_first_not_of("0123456789") == Text::npos; };
  if (p.empty() || !digits(p.substr(p[0] == '-' ? 1 : 0)) || !digits(q)) fail("expected a number, found " + std::string(w));
  mpq_class x{mpz_class(std::string(p), 10), mpz_class(std::string(q), 10)};  // a leading 0 does not mean octal
  if (x.get_den() == 0) fail("a denominator is 0");
  x.canonicalize();
  return x;
}

}  // namespace check
