// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rounded_mesh.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <future>

namespace check {
namespace {

double coordinate(Scanner& in) {
  const std::string word(in.word());
  char* end = nullptr;
  const double x = std::strtod(word.c_str(), &end);
  const bool decimal = !word.empty() && word.find_first_not_of("+-.0123456789eE") == std::string::npos;
  if (!decimal || *end != 0 || !std::isfinite(x)) in.fail("expected a coordinate, found " + word);
  return x;
}

Mesh read_off(Scanner& in) {
  Mesh mesh;
  mesh.points.resize(in.count());
  mesh.loops.resize(in.count());
  (void)in.word();  // number of edges
  for (auto& point : mesh.points) {
    for (double& x : point) x = coordinate(in);
  }
  const auto last = static_cast<std::int64_t>(mesh.points.size()) - 1;
  for (auto& loop : mesh.loops) {
    loop.resize(in.count());
    for (Index& v : loop) v = static_cast<Index>(in.integer(0, last));
  }
  return mesh;
}

// v, v/t, v//n or v/t/n of a facet; relative (negative) numbers are refused.
Index corner_of(const Scanner& in, std::string_view word, std::size_t points) {
  Index v = 0;
  std::from_chars(word.data(), word.data() + word.size(), v);
  if (v == 0 || v > points) in.fail("a corner that does not exist: " + std::string(word));
  return v - 1;
}

Mesh read_obj(Scanner& in) {
  Mesh mesh;
  bool in_facet = false;
  for (std::string_view w = in.word(); !w.empty(); w = in.word()) {
    if (in_facet && w.find_first_not_of("-0123456789/") == std::string_view::npos) {
      mesh.loops.back().push_back(corner_of(in, w, mesh.points.size()));
      continue;
    }
    in_facet = w == "f";
    if (w == "v") mesh.points.push_back({coordinate(in), coordinate(in), coordinate(in)});
    else if (in_facet) mesh.loops.emplace_back();
    else if (w == "g" || w == "o" || w == "s" || w == "usemtl" || w == "mtllib") (void)in.word();
    else in.fail("expected a line of an OBJ or OFF file, found " + std::string(w));
  }
  return mesh;
}

// x lies between the midpoints to the neighbours of m; a midpoint itself belongs to the even neighbour.
bool is_nearest(double m, const Number& x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &m, sizeof m);
  const double lower = std::nextafter(m, -HUGE_VAL), upper = std::nextafter(m, HUGE_VAL);
  if (!std::isfinite(lower) || !std::isfinite(upper)) return false;
  const int above_lower = sign(x - Number((mpq_class(m) + mpq_class(lower)) / 2));
  const int above_upper = sign(x - Number((mpq_class(m) + mpq_class(upper)) / 2));
  return (bits & 1) == 0 ? above_lower >= 0 && above_upper <= 0 : above_lower > 0 && above_upper < 0;
}

std::string vertex_fault(const Body& b, const Mesh& mesh, std::size_t v) {
  const auto& t = b.surface.triple[v];
  const std::array<Plane, 3> rows{b.planes[t[0]], b.planes[t[1]], b.planes[t[2]]};
  const std::string name = "vertex " + std::to_string(v);
  const Number w = det3(rows[0], rows[1], rows[2]);
  if (is_zero(w)) return name + ": det3 of its planes = 0";
  for (std::size_t k = 0; k < 3; ++k) {  // Cramer
    std::array<Plane, 3> changed = rows;
    for (Plane& p : changed) p[k] = p[3];
    const Number x = quotient(det3(changed[0], changed[1], changed[2]), w) * Number(power_of_two(b.scale)) + Number(b.shift[k]);
    if (!is_nearest(mesh.points[v][k], x)) return name + ": a coordinate is not the correct rounding of " + text(x);
  }
  return {};
}

std::string loops_fault(const Surface& s, const Mesh& mesh) {
  std::size_t facet = 0;
  for (std::size_t f = 0; f < s.facets(); ++f) {
    if (s.size(f) == 0) continue;
    const auto *first = s.corner.data() + s.start[f], *last = s.corner.data() + s.start[f + 1];
    if (facet == mesh.loops.size() || !std::equal(first, last, mesh.loops[facet].begin(), mesh.loops[facet].end())) {
      return "facet " + std::to_string(facet) + ": the mesh has another loop";
    }
    ++facet;
  }
  return facet == mesh.loops.size() ? "" : "the mesh has more facets";
}

}  // namespace

Mesh read_mesh(const std::string& path) { return parse_mesh(read_file(path), path); }

Mesh parse_mesh(std::string_view bytes, const std::string& name) {
  Scanner in(bytes, name, Layout::words);
  if (bytes.compare(0, 3, "OFF") != 0) return read_obj(in);
  (void)in.word();
  return read_off(in);
}

std::string rounding_fault(const Body& body, const Mesh& mesh) {
  const std::size_t vertices = body.surface.triple.size();
  if (mesh.points.size() != vertices) {
    return "the mesh has " + std::to_string(mesh.points.size()) + " vertices, expected " + std::to_string(vertices);
  }
  if (std::string fault = loops_fault(body.surface, mesh); !fault.empty()) return fault;
  const auto range = [&](std::size_t first, std::size_t last) {
    std::string fault;
    for (; first < last && fault.empty(); ++first) fault = vertex_fault(body, mesh, first);
    return fault;
  };
  auto second_half = std::async(std::launch::async, range, vertices / 2, vertices);
  const std::string first = range(0, vertices / 2), second = second_half.get();
  return first.empty() ? second : first;
}

}  // namespace check
