// SPDX-License-Identifier: LGPL-3.0-or-later
// Freedom from self-intersection with exact points: facets whose boxes overlap are tested edge by edge.
#include "embedded.hpp"

#include "surface.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace check {
namespace {

using Point = std::array<Number, 3>;

Number operator/(const Number& x, const Number& y) { return quotient(x, y); }

// The point of three planes by Cramer's rule.
Point meet(const Plane& p, const Plane& q, const Plane& r) {
  const Number w = det3(p, q, r);
  const auto with = [](Plane x, std::size_t k) { return x[k] = x[3], x; };
  Point x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = det3(with(p, k), with(q, k), with(r, k)) / w;
  return x;
}

// Bounds of a number: doubles by truncation are off by less than one unit in the last place.
struct Bounds {
  double low, high;
  explicit Bounds(const Number& x) {
    const double s = x.a.get_d(), t = x.b.get_d() * std::sqrt(5.0), error = 0x1p-48 * (std::fabs(s) + std::fabs(t)) + 0x1p-1060;
    low = s + t - error, high = s + t + error;
  }
};

struct Box {
  std::array<double, 3> low, high;
  Box() { low.fill(INFINITY), high.fill(-INFINITY); }
  void include(const Box& b) {
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], b.low[k]), high[k] = std::max(high[k], b.high[k]);
  }
  bool meets(const Box& b) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (low[k] > b.high[k] || b.low[k] > high[k]) return false;
    }
    return true;
  }
};

class Polygons {
 public:
  explicit Polygons(const Body& body) : planes_(body.planes), s_(body.surface) {
    for (const auto& t : s_.triple) {
      point_.push_back(meet(planes_[t[0]], planes_[t[1]], planes_[t[2]]));
      Box box;
      for (std::size_t k = 0; k < 3; ++k) {
        const Bounds b(point_.back()[k]);
        box.low[k] = b.low, box.high[k] = b.high;
      }
      near_.push_back(box);
    }
    for (std::size_t f = 0; f < s_.facets(); ++f) {
      Box box;
      for (std::size_t i = 0; i < size(f); ++i) box.include(near_[at(f, i)]);
      box_.push_back(box);
      const Plane p = planes_[f];
      axis_.push_back(!is_zero(p[0]) ? 0 : !is_zero(p[1]) ? 1 : 2);
    }
  }

  std::string simple_fault(std::size_t f) const {
    const std::string fault = facet_name(f) + ": is no simple polygon: ";
    const std::size_t n = size(f);
    if (is_convex(f)) return {};
    for (std::size_t i = 0; i < n; ++i) {
      const Index a = at(f, i), b = at(f, i + 1), c = at(f, i + 2);
      if (equal(a, b)) return fault + vertex_name(a) + " is " + vertex_name(b);
      if (turn(f, point_[a], point_[b], point_[c]) == 0 && ahead(point_[b], point_[a], point_[c])) return fault + "turns back at " + vertex_name(b);
      for (std::size_t j = i + 2; j < n; ++j) {
        if (i == 0 && j == n - 1) continue;
        if (segments_meet(f, a, b, at(f, j), at(f, j + 1))) {
          return fault + "edges at " + vertex_name(a) + " and " + vertex_name(at(f, j)) + " meet";
        }
      }
    }
    return sign(doubled_area(f)) * facing(f) > 0 ? "" : facet_name(f) + ": runs clockwise about its normal";
  }

  // Sorted by where their boxes begin along x.
  std::string contact_fault() const {
    std::vector<std::size_t> order(s_.facets());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t f, std::size_t g) { return box_[f].low[0] < box_[g].low[0]; });
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = i + 1; j < order.size() && box_[order[j]].low[0] <= box_[order[i]].high[0]; ++j) {
        const std::size_t f = order[i], g = order[j];
        if (size(f) == 0 || size(g) == 0 || !box_[f].meets(box_[g])) continue;
        if (pair_meets(f, g)) return facet_name(std::min(f, g)) + " and " + facet_name(std::max(f, g)) + ": meet outside of common vertices and edges";
      }
    }
    return {};
  }

  // Six times the volume: from doubles where their error cannot change the sign.
  int volume_sign() const {
    double sum = 0, error = 0;
    std::vector<Number> exact;
    for (const bool fast : {true, false}) {
      for (std::size_t f = 0; f < s_.facets(); ++f) {
        for (std::size_t i = 1; i + 1 < size(f); ++i) {
          const Index a = at(f, 0), b = at(f, i), c = at(f, i + 1);
          if (!fast) exact.push_back(dot(point_[a], cross(point_[b], point_[c])));
          else add_volume(near_[a], near_[b], near_[c], sum, error);
        }
      }
      if (fast && std::fabs(sum) > error * static_cast<double>(s_.corner.size() + 16)) return sign_of(sum);
    }
    for (std::size_t step = 1; step < exact.size(); step *= 2) {
      for (std::size_t i = 0; i + step < exact.size(); i += 2 * step) exact[i] = exact[i] + exact[i + step];
    }
    return exact.empty() ? 0 : sign(exact[0]);
  }

 private:
  static Point cross(const Point& p, const Point& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  }
  static Number dot(const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
  static Point minus(const Point& p, const Point& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
  // Products of the middles of bounds. The error of each: what the bounds leave open, and 2^-48 of its size for rounding.
  static void add_volume(const Box& a, const Box& b, const Box& c, double& sum, double& error) {
    const auto add = [&](int sign, std::size_t k, std::size_t l, std::size_t m) {
      double product = sign, largest = 1;
      for (const auto& [box, i] : {std::pair{&a, k}, {&b, l}, {&c, m}}) {
        product *= box->low[i] / 2 + box->high[i] / 2;
        largest *= std::max(std::fabs(box->low[i]), std::fabs(box->high[i]));
      }
      sum += product;
      error += (largest - std::fabs(product)) + 0x1p-48 * largest + 0x1p-900;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      add(1, k, (k + 1) % 3, (k + 2) % 3);
      add(-1, k, (k + 2) % 3, (k + 1) % 3);
    }
  }

  std::size_t size(std::size_t f) const { return s_.size(f); }
  Index at(std::size_t f, std::size_t i) const { return s_.corner[s_.start[f] + i % size(f)]; }
  bool has(std::size_t f, Index v) const {
    const auto first = s_.corner.begin() + s_.start[f], last = s_.corner.begin() + s_.start[f + 1];
    return std::find(first, last, v) != last;
  }
  bool has_edge(std::size_t f, Index a, Index b) const {
    for (std::size_t i = 0; i < size(f); ++i) {
      if ((at(f, i) == a && at(f, i + 1) == b) || (at(f, i) == b && at(f, i + 1) == a)) return true;
    }
    return false;
  }
  bool equal(Index a, Index b) const {
    if (!near_[a].meets(near_[b])) return false;
    const Point d = minus(point_[a], point_[b]);
    return is_zero(d[0]) && is_zero(d[1]) && is_zero(d[2]);
  }
  int facing(std::size_t f) const { return sign(planes_[f][static_cast<std::size_t>(axis_[f])]); }
  // Turn of a → b → c seen along the axis of facet f.
  int turn(std::size_t f, const Point& a, const Point& b, const Point& c) const {
    const auto u = static_cast<std::size_t>((axis_[f] + 1) % 3), v = static_cast<std::size_t>((axis_[f] + 2) % 3);
    return sign((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
  }
  // Of three points on a line: a and c on the same side of b.
  static bool ahead(const Point& b, const Point& a, const Point& c) { return sign(dot(minus(a, b), minus(c, b))) > 0; }
  // x on the line of a and b lies between them or is one of them.
  static bool between(const Point& a, const Point& b, const Point& x) { return sign(dot(minus(a, x), minus(b, x))) <= 0; }

  bool is_convex(std::size_t f) const {
    const auto u = static_cast<std::size_t>((axis_[f] + 1) % 3);
    int first = 0, last = 0, changes = 0;
    for (std::size_t i = 0; i < size(f); ++i) {
      const Point &a = point_[at(f, i)], &b = point_[at(f, i + 1)];
      if (turn(f, a, b, point_[at(f, i + 2)]) != facing(f)) return false;
      const int s = sign(b[u] - a[u]);
      if (s == 0) continue;
      if (first == 0) first = s;
      changes += last != 0 && s != last ? 1 : 0;
      last = s;
    }
    return changes + (first != last ? 1 : 0) == 2;
  }
  Number doubled_area(std::size_t f) const {
    const auto u = static_cast<std::size_t>((axis_[f] + 1) % 3), v = static_cast<std::size_t>((axis_[f] + 2) % 3);
    Number area;
    for (std::size_t i = 0; i < size(f); ++i) {
      const Point &a = point_[at(f, i)], &b = point_[at(f, i + 1)];
      area = area + (a[u] * b[v] - a[v] * b[u]);
    }
    return area;
  }
  // Closed segments in the plane of facet f.
  bool segments_meet(std::size_t f, Index a, Index b, Index c, Index d) const {
    Box e = near_[a], h = near_[c];
    e.include(near_[b]), h.include(near_[d]);
    if (!e.meets(h)) return false;
    const Point &p = point_[a], &q = point_[b], &r = point_[c], &t = point_[d];
    const int i = turn(f, p, q, r), j = turn(f, p, q, t);
    if (i == 0 && j == 0) return between(p, q, r) || between(p, q, t) || between(r, t, p);
    return i * j <= 0 && turn(f, r, t, p) * turn(f, r, t, q) <= 0;
  }
  // The closed polygon f contains the point x of its plane: parity of the edges that a ray along u crosses.
  bool contains(std::size_t f, const Point& x) const {
    const auto u = static_cast<std::size_t>((axis_[f] + 1) % 3), v = static_cast<std::size_t>((axis_[f] + 2) % 3);
    bool inside = false;
    for (std::size_t i = 0; i < size(f); ++i) {
      const Point &a = point_[at(f, i)], &b = point_[at(f, i + 1)];
      const int av = sign(a[v] - x[v]), bv = sign(b[v] - x[v]);
      if (av * bv > 0) continue;
      const int t = turn(f, a, b, x);
      if (t == 0 && sign(a[u] - x[u]) * sign(b[u] - x[u]) <= 0) return true;
      if ((av <= 0) != (bv <= 0) && (t > 0) == (bv > av)) inside = !inside;
    }
    return inside;
  }
  Point middle(Index a, Index b) const {
    Point x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = (point_[a][k] + point_[b][k]) * Number(mpq_class(1, 2));
    return x;
  }

  // Positive beyond the plane of g.
  int side(Index v, std::size_t g) const {
    const auto& t = s_.triple[v];
    if (t[0] == g || t[1] == g || t[2] == g) return 0;
    return -sign3(planes_, t[0], t[1], t[2]) * sign4(planes_, t[0], t[1], t[2], g);
  }
  // Two facets in two planes meet in segments of a line, each of which ends on the boundary of one of them; so an edge
  // of one meets the other, or a segment between two common vertices lies in both.
  bool pair_meets(std::size_t f, std::size_t g) const { return edges_meet(f, g) || edges_meet(g, f) || chord_meets(f, g); }

  bool edges_meet(std::size_t f, std::size_t g) const {
    std::vector<int> sides;
    for (std::size_t i = 0; i < size(f); ++i) sides.push_back(side(at(f, i), g));
    bool all_common = true;
    for (std::size_t i = 0; i < size(f); ++i) {
      const Index a = at(f, i), b = at(f, i + 1);
      const int s = sides[i], t = sides[(i + 1) % size(f)];
      if (s == 0 && !has(g, a) && contains(g, point_[a])) return true;
      if (s * t < 0 && contains(g, crossing(a, b, g))) return true;
      const bool common = has_edge(g, a, b);
      if (s == 0 && t == 0 && !common && flat_edge_meets(a, b, g)) return true;
      all_common = all_common && common;
    }
    return all_common;
  }
  Point crossing(Index a, Index b, std::size_t g) const {
    const Plane p = planes_[g];
    const auto height = [&](const Point& x) { return p[0] * x[0] + p[1] * x[1] + p[2] * x[2] - p[3]; };
    const Number s = height(point_[a]), share = s / (s - height(point_[b]));
    Point x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = point_[a][k] + share * (point_[b][k] - point_[a][k]);
    return x;
  }
  // An edge in the plane of g that is no edge of g meets it outside of common vertices.
  bool flat_edge_meets(Index a, Index b, std::size_t g) const {
    if (contains(g, middle(a, b))) return true;
    for (std::size_t j = 0; j < size(g); ++j) {
      const Index c = at(g, j), d = at(g, j + 1);
      const bool at_a = a == c || a == d, at_b = b == c || b == d;
      if (!at_a && !at_b) {
        if (segments_meet(g, a, b, c, d)) return true;
        continue;
      }
      const Index apex = at_a ? a : b, p = at_a ? b : a, q = c == apex ? d : c;
      if (turn(g, point_[apex], point_[p], point_[q]) == 0 && ahead(point_[apex], point_[p], point_[q])) return true;
    }
    return false;
  }
  // A segment between neighbours among the common vertices, not a common edge, that lies in both facets.
  bool chord_meets(std::size_t f, std::size_t g) const {
    std::vector<Index> common;
    for (std::size_t i = 0; i < size(f); ++i) {
      if (has(g, at(f, i))) common.push_back(at(f, i));
    }
    if (common.size() < 2) return false;
    for (const Index a : common) {
      for (const Index b : common) {
        if (a >= b || (has_edge(f, a, b) && has_edge(g, a, b))) continue;
        const bool interrupted = std::any_of(common.begin(), common.end(), [&](Index c) {
          return c != a && c != b && turn_in_space(a, b, c) && between(point_[a], point_[b], point_[c]);
        });
        if (interrupted) continue;
        const Point x = middle(a, b);
        if (contains(f, x) && contains(g, x)) return true;
      }
    }
    return false;
  }
  bool turn_in_space(Index a, Index b, Index c) const {
    const Point n = cross(minus(point_[b], point_[a]), minus(point_[c], point_[a]));
    return is_zero(n[0]) && is_zero(n[1]) && is_zero(n[2]);
  }

  const Planes& planes_;
  const Surface& s_;
  std::vector<Point> point_;
  std::vector<Box> near_, box_;
  std::vector<int> axis_;
};

// Every directed edge once; the facets at a vertex hang together by edges; so do all facets. Sets `closed`.
std::string sheet_fault(const Surface& s, bool& closed) {
  std::map<std::pair<Index, Index>, std::size_t> facet_of;
  std::vector<std::vector<std::size_t>> at(s.triple.size());
  std::vector<std::vector<std::pair<Index, Index>>> edges(s.facets());
  std::size_t facets = 0;
  for (std::size_t f = 0; f < s.facets(); ++f) {
    facets += s.size(f) > 0 ? 1 : 0;
    for (std::size_t i = 0; i < s.size(f); ++i) {
      const Index a = s.corner[s.start[f] + i], b = s.corner[s.start[f] + (i + 1) % s.size(f)];
      if (!at[a].empty() && at[a].back() == f) return facet_name(f) + ": passes " + vertex_name(a) + " twice";
      if (!facet_of.emplace(std::pair(a, b), f).second) return facet_name(f) + ": an edge is used twice in one direction";
      at[a].push_back(f);
      edges[f].push_back({a, b});
    }
  }
  closed = true;
  // The facets reached from the first over edges that `along` accepts.
  const auto reached = [&](std::size_t first, const auto& along) {
    std::set<std::size_t> seen{first};
    std::vector<std::size_t> todo{first};
    while (!todo.empty()) {
      const std::size_t f = todo.back();
      todo.pop_back();
      for (const auto& [a, b] : edges[f]) {
        const auto twin = facet_of.find({b, a});
        if (twin == facet_of.end()) closed = false;
        else if (along(a, b) && seen.insert(twin->second).second) todo.push_back(twin->second);
      }
    }
    return seen.size();
  };
  for (Index v = 0; v < at.size(); ++v) {
    if (at[v].empty()) return vertex_name(v) + ": is in no facet";
    if (reached(at[v][0], [&](Index a, Index b) { return a == v || b == v; }) != at[v].size()) {
      return vertex_name(v) + ": its facets are not one fan";
    }
  }
  if (facets == 0) return "there is no facet";
  return reached(at[0][0], [](Index, Index) { return true; }) == facets ? "" : "the surface is not connected";
}

}  // namespace

std::string embedded_fault(const Body& body) {
  bool closed = false;
  if (std::string fault = sheet_fault(body.surface, closed); !fault.empty()) return fault;
  if (std::string fault = planar_fault(body.planes, body.surface); !fault.empty()) return fault;
  const Polygons polygons(body);
  for (std::size_t f = 0; f < body.surface.facets(); ++f) {
    if (body.surface.size(f) == 0) continue;
    if (std::string fault = polygons.simple_fault(f); !fault.empty()) return fault;
  }
  if (std::string fault = polygons.contact_fault(); !fault.empty()) return fault;
  return !closed || polygons.volume_sign() > 0 ? "" : "the normals point inward";
}

}  // namespace check
