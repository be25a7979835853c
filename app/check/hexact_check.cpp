// SPDX-License-Identifier: LGPL-3.0-or-later
// hexact-check CERT [MESH]: verifies a certificate of a polyhedron with GMP alone. A second implementation: it shares
// no code with the library. Claims and their proofs are described in docs/certificates.md.
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

using Index = std::uint32_t;
using Text = std::string_view;
constexpr Index kNone = UINT32_MAX;

struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// ---- numbers a + b√5 -------------------------------------------------------------------------------------------

struct Number {
  mpq_class a, b;
};
Number operator*(const Number& x, const Number& y) {
  if (x.b == 0 && y.b == 0) return {x.a * y.a, 0};
  return {x.a * y.a + 5 * x.b * y.b, x.a * y.b + x.b * y.a};
}
Number operator+(const Number& x, const Number& y) { return {x.a + y.a, x.b + y.b}; }
Number operator-(const Number& x, const Number& y) { return {x.a - y.a, x.b - y.b}; }
bool is_zero(const Number& x) { return x.a == 0 && x.b == 0; }
int sign(const Number& x) {
  const int s = sgn(x.a), t = sgn(x.b);
  if (t == 0 || s == t) return s;
  if (s == 0) return t;
  const mpq_class a2 = x.a * x.a, b2 = 5 * x.b * x.b;  // never equal: √5 is irrational
  return a2 > b2 ? s : t;
}
Number quotient(const Number& x, const Number& y) {
  const mpq_class norm = y.a * y.a - 5 * y.b * y.b;
  return {(x.a * y.a - 5 * x.b * y.b) / norm, (x.b * y.a - x.a * y.b) / norm};
}
mpq_class power_of_two(long e) {
  mpq_class q(1);
  if (e >= 0) mpq_mul_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(e));
  else mpq_div_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(-e));
  return q;
}
std::string text(const Number& x) {
  return x.b == 0 ? x.a.get_str() : x.a.get_str() + "+" + x.b.get_str() + "*sqrt5";
}

// ---- planes ----------------------------------------------------------------------------------------------------

using Row = std::array<std::int64_t, 4>;
using Plane = std::array<Number, 4>;  // a b c d

struct Planes {
  std::vector<Row> rows;     // short ones
  std::vector<Index> wide;   // kNone, or the place in `big`
  std::vector<Plane> big;
  std::size_t size() const { return rows.size(); }
  Plane operator[](std::size_t i) const {
    if (wide[i] != kNone) return big[wide[i]];
    Plane p;
    for (int k = 0; k < 4; ++k) p[k].a = static_cast<long>(rows[i][k]);
    return p;
  }
  void add(const Plane& p) {
    Row row{};
    bool fits = true;
    for (int k = 0; k < 4; ++k) {
      fits = fits && p[k].b == 0 && p[k].a.get_den() == 1 && mpz_sizeinbase(p[k].a.get_num_mpz_t(), 2) <= 62;
      if (fits) row[k] = p[k].a.get_num().get_si();
    }
    rows.push_back(row);
    wide.push_back(fits ? kNone : static_cast<Index>(big.size()));
    if (!fits) big.push_back(p);
  }
};

Number det3(const Plane& p, const Plane& q, const Plane& r) {
  return p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
}
Number det4(const Plane& p, const Plane& q, const Plane& r, const Plane& s) {
  return s[3] * det3(p, q, r) - r[3] * det3(p, q, s) + q[3] * det3(p, r, s) - p[3] * det3(q, r, s);
}
int sign_of(__int128 x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
bool below(std::int64_t x, int bits) { return ((x ^ (x >> 63)) >> bits) == 0; }
bool normals_below(const Planes& P, std::initializer_list<std::size_t> list, int bits) {
  return std::all_of(list.begin(), list.end(), [&](std::size_t i) {
    return P.wide[i] == kNone && below(P.rows[i][0], bits) && below(P.rows[i][1], bits) && below(P.rows[i][2], bits);
  });
}
// Entries below 2^40: products of three below 2^120, six of them below 2^123.
int sign3(const Planes& P, std::size_t i, std::size_t j, std::size_t k) {
  if (!normals_below(P, {i, j, k}, 40)) return sign(det3(P[i], P[j], P[k]));
  using W = __int128;
  const Row &p = P.rows[i], &q = P.rows[j], &r = P.rows[k];
  return sign_of(W(p[0]) * (W(q[1]) * r[2] - W(q[2]) * r[1]) - W(p[1]) * (W(q[0]) * r[2] - W(q[2]) * r[0]) +
                 W(p[2]) * (W(q[0]) * r[1] - W(q[1]) * r[0]));
}
// Normals below 2^22, offsets below 2^50: 24 terms below 2^116. Behind it doubles: every entry, product and sum has
// a relative error of 2^-53, at most 12 of them on a path, so 2^-48 times the sum of magnitudes bounds the error.
int sign4(const Planes& P, std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
  const std::array<std::size_t, 4> at{i, j, k, l};
  const bool narrow = std::all_of(at.begin(), at.end(), [&](std::size_t x) { return P.wide[x] == kNone; });
  if (!narrow) return sign(det4(P[i], P[j], P[k], P[l]));
  const auto expand = [&]<class W>(W, bool absolute) {
    const auto e = [&](int r, int c) { const W x = static_cast<W>(P.rows[at[r]][c]); return absolute && x < 0 ? -x : x; };
    const W s = absolute ? W(1) : W(-1);
    const auto minor = [&](int a, int b, int c) {
      return e(a, 0) * (e(b, 1) * e(c, 2) + s * e(b, 2) * e(c, 1)) + s * e(a, 1) * (e(b, 0) * e(c, 2) + s * e(b, 2) * e(c, 0)) +
             e(a, 2) * (e(b, 0) * e(c, 1) + s * e(b, 1) * e(c, 0));
    };
    return e(3, 3) * minor(0, 1, 2) + s * e(2, 3) * minor(0, 1, 3) + e(1, 3) * minor(0, 2, 3) + s * e(0, 3) * minor(1, 2, 3);
  };
  const bool is_short = normals_below(P, {i, j, k, l}, 22) &&
                        std::all_of(at.begin(), at.end(), [&](std::size_t x) { return below(P.rows[x][3], 50); });
  if (is_short) return sign_of(expand(__int128(0), false));
  const double d = expand(0.0, false), bound = 0x1p-48 * expand(0.0, true);
  if (std::fabs(d) > bound) return d > 0 ? 1 : -1;
  return sign(det4(P[i], P[j], P[k], P[l]));
}
int cross(const Planes& P, std::size_t f, std::size_t g, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (P.wide[f] == kNone && P.wide[g] == kNone) {
    return sign_of(static_cast<__int128>(P.rows[f][u]) * P.rows[g][v] - static_cast<__int128>(P.rows[f][v]) * P.rows[g][u]);
  }
  const Plane p = P[f], q = P[g];
  return sign(p[u] * q[v] - p[v] * q[u]);
}

// ---- the surface -----------------------------------------------------------------------------------------------

struct Surface {
  std::vector<Index> start{0}, corner;
  std::vector<std::array<Index, 3>> triple;
  std::size_t facets() const { return start.size() - 1; }
};
struct Body {
  bool root5 = false, seen_planes = false, seen_loops = false, seen_vertices = false;
  long scale = 0;
  std::array<mpq_class, 3> shift;
  Planes planes;
  std::vector<std::pair<Index, Index>> address;  // level, parent or kNone
  Surface surface;
};

std::string facet_name(std::size_t f) { return "facet " + std::to_string(f); }
std::string vertex_name(std::size_t v) { return "vertex " + std::to_string(v); }

struct Edges {
  std::vector<Index> facet, next, previous, twin, leaving;
};

// Fills `e`; returns what refutes `closed`, or nothing.
std::string connect(const Surface& s, Edges& e) {
  const std::size_t n = s.corner.size(), vertices = s.triple.size();
  e = {std::vector<Index>(n), std::vector<Index>(n), std::vector<Index>(n), std::vector<Index>(n, kNone), std::vector<Index>(vertices, kNone)};
  std::vector<Index> seen(vertices, kNone), count(vertices + 1, 0), order(n), valence(vertices, 0);
  std::size_t used = 0, first_used = s.facets();
  for (std::size_t f = 0; f < s.facets(); ++f) {
    const Index b = s.start[f], size = s.start[f + 1] - b;
    if (size == 0) continue;
    if (used++ == 0) first_used = f;
    if (size < 3) return facet_name(f) + ": fewer than 3 corners";
    for (Index j = 0; j < size; ++j) {
      const Index h = b + j, v = s.corner[h];
      if (seen[v] == f) return facet_name(f) + ": passes " + vertex_name(v) + " twice";
      seen[v] = static_cast<Index>(f);
      e.facet[h] = static_cast<Index>(f);
      e.next[h] = b + (j + 1) % size;
      e.previous[h] = b + (j + size - 1) % size;
      if (e.leaving[v] == kNone) e.leaving[v] = h;
      ++valence[v];
    }
  }
  if (used == 0) return "there is no facet";
  const auto low = [&](Index h) { return std::min(s.corner[h], s.corner[e.next[h]]); };
  const auto high = [&](Index h) { return std::max(s.corner[h], s.corner[e.next[h]]); };
  for (Index h = 0; h < n; ++h) ++count[low(h) + 1];
  for (std::size_t v = 0; v < vertices; ++v) count[v + 1] += count[v];
  std::vector<Index> at(count.begin(), count.end() - 1);
  for (Index h = 0; h < n; ++h) order[at[low(h)]++] = h;
  for (std::size_t v = 0; v < vertices; ++v) {
    std::sort(order.begin() + count[v], order.begin() + count[v + 1], [&](Index x, Index y) { return high(x) != high(y) ? high(x) < high(y) : x < y; });
    for (Index i = count[v]; i < count[v + 1]; i += 2) {
      const Index g = order[i], h = i + 1 < count[v + 1] ? order[i + 1] : kNone;
      const bool pair = h != kNone && high(g) == high(h) && s.corner[g] != s.corner[h];
      const bool third = pair && i + 2 < count[v + 1] && high(order[i + 2]) == high(g);
      if (!pair || third) return "edge " + std::to_string(low(g)) + "-" + std::to_string(high(g)) + ": is not used once in each direction";
      e.twin[g] = h, e.twin[h] = g;
    }
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (e.leaving[v] == kNone) return vertex_name(v) + ": is in no facet";
    Index round = 0, h = e.leaving[v];
    do ++round, h = e.twin[e.previous[h]];
    while (h != e.leaving[v]);
    if (round != valence[v]) return vertex_name(v) + ": its facets are not one fan";
  }
  std::vector<bool> reached(s.facets(), false);
  std::vector<Index> todo{static_cast<Index>(first_used)};
  reached[first_used] = true;
  std::size_t found = 1;
  while (!todo.empty()) {
    const Index f = todo.back();
    todo.pop_back();
    for (Index h = s.start[f]; h < s.start[f + 1]; ++h) {
      const Index g = e.facet[e.twin[h]];
      if (!reached[g]) reached[g] = true, ++found, todo.push_back(g);
    }
  }
  if (found != used) return "the surface is not connected";
  return {};
}

std::string planar(const Planes& P, const Surface& s) {
  for (std::size_t v = 0; v < s.triple.size(); ++v) {
    if (sign3(P, s.triple[v][0], s.triple[v][1], s.triple[v][2]) == 0) return vertex_name(v) + ": det3 of its planes = 0";
  }
  for (std::size_t f = 0; f < s.facets(); ++f) {
    for (Index h = s.start[f]; h < s.start[f + 1]; ++h) {
      const auto& t = s.triple[s.corner[h]];
      if (t[0] == f || t[1] == f || t[2] == f) continue;
      if (sign4(P, t[0], t[1], t[2], f) == 0) continue;
      return facet_name(f) + ": does not contain " + vertex_name(s.corner[h]) + ", det4 = " + text(det4(P[t[0]], P[t[1]], P[t[2]], P[f]));
    }
  }
  return {};
}

int turning_axis(const Planes& P, std::size_t f) {
  const Plane p = P[f];
  return !is_zero(p[0]) ? 1 : !is_zero(p[1]) ? 2 : 0;
}
// Number of sign changes of the component of n_f × n_g along an axis that is not parallel to n_f.
int sign_changes(const Planes& P, std::size_t f, const std::vector<Index>& others, bool cyclic) {
  const int axis = turning_axis(P, f);
  int first = 0, last = 0, changes = 0;
  for (const Index g : others) {
    const int s = cross(P, f, g, axis);
    if (s == 0) continue;
    if (first == 0) first = s;
    if (last != 0 && s != last) ++changes;
    last = s;
  }
  return changes + (cyclic && first != last ? 1 : 0);
}

// Strict local convexity everywhere on a closed planar surface.
std::string convex_signs(const Planes& P, const Surface& s, const Edges& e) {
  const auto right = [&](Index h) { return e.facet[e.twin[h]]; };
  for (Index h = 0; h < s.corner.size(); ++h) {
    const Index f = e.facet[h], g = right(h), k = right(e.previous[h]), v = s.corner[h], w = s.corner[e.next[h]];
    if (sign3(P, f, k, g) <= 0) return facet_name(f) + ": corner at " + vertex_name(v) + " is not convex, det3 = " + text(det3(P[f], P[k], P[g]));
    if (h > e.twin[h]) continue;
    // w = v + t·(n_f × n_g) with t > 0: look from the plane k through v, whose normal is independent of f and g.
    const auto& t = s.triple[w];
    if (sign3(P, t[0], t[1], t[2]) * sign4(P, t[0], t[1], t[2], k) <= 0) {
      return "edge " + std::to_string(std::min(v, w)) + "-" + std::to_string(std::max(v, w)) + ": is not strictly convex, det4 = " +
             text(det4(P[t[0]], P[t[1]], P[t[2]], P[k]));
    }
  }
  std::vector<Index> around;
  for (std::size_t f = 0; f < s.facets(); ++f) {
    around.clear();
    for (Index h = s.start[f]; h < s.start[f + 1]; ++h) around.push_back(right(h));
    if (!around.empty() && sign_changes(P, f, around, true) != 2) return facet_name(f) + ": does not turn exactly once";
  }
  for (std::size_t v = 0; v < s.triple.size(); ++v) {
    around.clear();
    Index h = e.leaving[v];
    do around.push_back(e.facet[h]), h = e.twin[e.previous[h]];
    while (h != e.leaving[v]);
    if (around.size() == 3) continue;
    bool once = true;  // all edges but its own lie inside the first facet, and the lines there make less than a half turn
    for (std::size_t i = 1; i + 1 < around.size(); ++i) once = once && sign3(P, around[0], around[i + 1], around[i]) < 0;
    const Index base = around[0];
    around.erase(around.begin());
    if (!once || sign_changes(P, base, around, false) > 1) return vertex_name(v) + ": its facets do not go round once";
  }
  return {};
}

std::string convex(const Planes& P, const Surface& s, Edges& e) {
  if (std::string w = connect(s, e); !w.empty()) return w;
  if (std::string w = planar(P, s); !w.empty()) return w;
  long facets = 0;
  for (std::size_t f = 0; f < s.facets(); ++f) facets += s.start[f + 1] > s.start[f] ? 1 : 0;
  const long euler = static_cast<long>(s.triple.size()) - static_cast<long>(s.corner.size() / 2) + facets;
  if (euler != 2) return "Euler characteristic " + std::to_string(euler);
  return convex_signs(P, s, e);
}

std::string trivalent(const Surface& s) {
  std::vector<Index> valence(s.triple.size(), 0);
  for (const Index v : s.corner) ++valence[v];
  for (std::size_t v = 0; v < valence.size(); ++v) {
    if (valence[v] != 3) return vertex_name(v) + ": " + std::to_string(valence[v]) + " facets";
  }
  return {};
}

// ---- claims about a reference ----------------------------------------------------------------------------------

struct Certificate {
  Body body;
  std::vector<std::pair<std::string, std::string>> claims;
  std::map<std::string, Body> bodies;
  std::map<std::string, std::map<std::size_t, std::size_t>> supports;
};

// One representative of all positive multiples: the first coefficient of the normal that is not 0 becomes ±1.
std::string key(Plane p) {
  for (int k = 0; k < 3; ++k) {
    if (is_zero(p[k])) continue;
    Number pivot = p[k];
    if (sign(pivot) < 0) pivot = Number{0, 0} - pivot;
    std::string out;
    for (const Number& x : p) out += text(quotient(x, pivot)) + " ";
    return out;
  }
  return {};
}
// Half-space i of `of` in the coordinates of `frame`.
Plane in_frame(const Body& of, std::size_t i, const Body& frame) {
  Plane p = of.planes[i];
  if (of.scale == frame.scale && of.shift == frame.shift) return p;
  Number d = p[3] * Number{power_of_two(of.scale), 0};
  for (int k = 0; k < 3; ++k) d = d - p[k] * Number{frame.shift[k] - of.shift[k], 0};
  p[3] = d * Number{power_of_two(-frame.scale), 0};
  return p;
}

std::string inside(const Certificate& c, const std::string& name, const Edges& e, bool tangent) {
  const Body &body = c.body, &reference = c.bodies.at(name);
  Planes all = body.planes;
  std::map<std::string, bool> found;
  for (std::size_t i = 0; i < reference.planes.size(); ++i) found[key(in_frame(reference, i, body))] = false;
  for (std::size_t f = 0; f < body.planes.size(); ++f) {
    if (body.surface.start[f] == body.surface.start[f + 1]) continue;
    if (const auto it = found.find(key(body.planes[f])); it != found.end()) it->second = true;
  }
  for (std::size_t i = 0; i < reference.planes.size(); ++i) {
    const Plane p = in_frame(reference, i, body);
    if (found[key(p)]) continue;
    const std::string what = "half-space " + std::to_string(i) + " of " + name;
    if (tangent && reference.surface.start[i + 1] > reference.surface.start[i]) return what + ": is no facet half-space";
    const auto list = c.supports.find(name);
    if (list == c.supports.end() || !list->second.count(i)) return what + ": no support is given";
    const std::size_t v = list->second.at(i), n = all.size();
    if (v >= body.surface.triple.size()) return what + ": " + vertex_name(v) + " does not exist";
    all.add(p);
    const auto& t = body.surface.triple[v];
    if (sign3(all, t[0], t[1], t[2]) * sign4(all, t[0], t[1], t[2], n) < 0) return what + ": " + vertex_name(v) + " is beyond it, det4 = " + text(det4(all[t[0]], all[t[1]], all[t[2]], p));
    Index h = e.leaving[v];
    do {
      const Index f = e.facet[h], g = e.facet[e.twin[h]];
      if (sign3(all, n, f, g) > 0) return what + ": " + vertex_name(v) + " does not support it, det3 = " + text(det3(p, all[f], all[g]));
      h = e.twin[e.previous[h]];
    } while (h != e.leaving[v]);
  }
  return {};
}

// phs (b.2): corner h of the old loops is vertex h; old facets keep their corners; vertex v becomes a hexagon.
Surface refined(const Surface& s, const Edges& e) {
  Surface r;
  r.start = s.start;
  r.corner.resize(s.corner.size());
  r.triple.resize(s.corner.size());
  const Index facets = static_cast<Index>(s.facets());
  for (Index h = 0; h < s.corner.size(); ++h) {
    r.corner[h] = h;
    r.triple[h] = {e.facet[h], facets + s.corner[h], facets + s.corner[e.next[h]]};
  }
  for (Index v = 0; v < s.triple.size(); ++v) {
    Index h = e.leaving[v];
    for (int k = 0; k < 3; ++k, h = e.twin[e.previous[h]]) r.corner.insert(r.corner.end(), {h, e.previous[h]});
    r.start.push_back(static_cast<Index>(r.corner.size()));
  }
  return r;
}

std::string corner_cut(const Certificate& c, const std::string& name) {
  const Body &body = c.body, &base = c.bodies.at(name);
  if (std::string w = trivalent(base.surface); !w.empty()) return w;
  if (base.planes.size() > body.planes.size()) return "fewer planes than " + name;
  for (std::size_t i = 0; i < base.planes.size(); ++i) {
    if (base.surface.start[i] == base.surface.start[i + 1]) return facet_name(i) + " of " + name + ": has no loop";
    if (key(in_frame(base, i, body)) != key(body.planes[i])) return facet_name(i) + ": is not the plane of " + name;
  }
  Surface s = base.surface;
  std::vector<std::pair<Index, Index>> address = base.address;
  for (Index level = 0;; ++level) {
    Edges e;
    const std::string at = "level " + std::to_string(level) + ": ";
    if (std::string w = convex(body.planes, s, e); !w.empty()) return at + w;
    if (s.facets() == body.planes.size()) break;
    if (s.facets() + s.triple.size() > body.planes.size()) return at + "the next level needs more planes than there are";
    for (std::size_t v = 0; v < s.triple.size(); ++v) {
      const auto& t = s.triple[v];
      const std::size_t own = s.facets() + v;
      if (sign3(body.planes, t[0], t[1], t[2]) * sign4(body.planes, t[0], t[1], t[2], own) >= 0) {
        return at + vertex_name(v) + ": is not beyond its own plane, det4 = " +
               text(det4(body.planes[t[0]], body.planes[t[1]], body.planes[t[2]], body.planes[own]));
      }
      address.emplace_back(level + 1, static_cast<Index>(v));
    }
    s = refined(s, e);
  }
  for (std::size_t f = 0; f < s.facets(); ++f) {
    if (!std::equal(s.corner.begin() + s.start[f], s.corner.begin() + s.start[f + 1], body.surface.corner.begin() + body.surface.start[f],
                    body.surface.corner.begin() + body.surface.start[f + 1])) return facet_name(f) + ": another loop than that of the honeycomb step";
    if (address[f] != body.address[f]) return facet_name(f) + ": level or parent is not the one of its place";
  }
  return {};
}

std::string decide(const Certificate& c, const std::string& claim, const std::string& reference) {
  Edges e;
  if (claim == "closed") return connect(c.body.surface, e);
  if (claim == "planar") return planar(c.body.planes, c.body.surface);
  if (claim == "trivalent") return trivalent(c.body.surface);
  if (std::string w = convex(c.body.planes, c.body.surface, e); claim == "convex" || !w.empty()) return w;
  const Body& r = c.bodies.at(reference);
  if (r.root5 != c.body.root5) return "body " + reference + " is over another field";
  Edges of_reference;
  if (std::string w = convex(r.planes, r.surface, of_reference); !w.empty()) return "body " + reference + " is not convex: " + w;
  return claim == "corner-cut-of" ? corner_cut(c, reference) : inside(c, reference, e, claim == "tangent");
}

// ---- reading ---------------------------------------------------------------------------------------------------

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  if (!in || bytes.empty()) throw Malformed(path + ": cannot be read, or is empty");
  return bytes;
}

std::uint32_t root_bits(unsigned prime, unsigned root) {  // first 32 bits behind the point of a root of a prime, FIPS 180-4
  mpz_class x = prime;
  x <<= 32 * root;
  mpz_root(x.get_mpz_t(), x.get_mpz_t(), root);
  return static_cast<std::uint32_t>(mpz_class(x & 0xffffffffUL).get_ui());
}
std::string sha256(std::string bytes) {
  std::array<std::uint32_t, 64> k{}, w{};
  std::array<std::uint32_t, 8> state{};
  unsigned prime = 2;
  for (unsigned i = 0; i < 64; ++i, ++prime) {
    for (unsigned d = 2; d * d <= prime; ++d) if (prime % d == 0) ++prime, d = 1;
    k[i] = root_bits(prime, 3);
    if (i < 8) state[i] = root_bits(prime, 2);
  }
  const std::uint64_t bits = bytes.size() * 8;
  bytes.push_back(static_cast<char>(0x80));
  while (bytes.size() % 64 != 56) bytes.push_back(0);
  for (int i = 7; i >= 0; --i) bytes.push_back(static_cast<char>(bits >> (8 * i)));
  const auto rot = [](std::uint32_t x, int n) { return (x >> n) | (x << (32 - n)); };
  for (std::size_t at = 0; at < bytes.size(); at += 64) {
    for (std::size_t i = 0; i < 16; ++i) {
      w[i] = 0;
      for (std::size_t j = 0; j < 4; ++j) w[i] = (w[i] << 8) | static_cast<unsigned char>(bytes[at + 4 * i + j]);
    }
    for (std::size_t i = 16; i < 64; ++i) {
      const std::uint32_t x = w[i - 15], y = w[i - 2];
      w[i] = w[i - 16] + (rot(x, 7) ^ rot(x, 18) ^ (x >> 3)) + w[i - 7] + (rot(y, 17) ^ rot(y, 19) ^ (y >> 10));
    }
    std::array<std::uint32_t, 8> s = state;
    for (std::size_t i = 0; i < 64; ++i) {
      const std::uint32_t t = s[7] + (rot(s[4], 6) ^ rot(s[4], 11) ^ rot(s[4], 25)) + ((s[4] & s[5]) ^ (~s[4] & s[6])) + k[i] + w[i];
      const std::uint32_t u = (rot(s[0], 2) ^ rot(s[0], 13) ^ rot(s[0], 22)) + ((s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]));
      s = {t + u, s[0], s[1], s[2], s[3] + t, s[4], s[5], s[6]};
    }
    for (std::size_t i = 0; i < 8; ++i) state[i] += s[i];
  }
  char hex[65];
  for (std::size_t i = 0; i < 8; ++i) std::snprintf(hex + 8 * i, 9, "%08x", state[i]);
  return hex;
}

class Scanner {
 public:
  Scanner(Text bytes, std::string name) : rest_(bytes), name_(std::move(name)) {}
  [[noreturn]] void fail(const std::string& what) const { throw Malformed(name_ + ":" + std::to_string(line_) + ": " + what); }
  Text line_before_word() const { return rest_; }
  Text word() {  // over line ends and comments; empty at the end
    for (;; rest_.remove_prefix(1)) {
      if (rest_.empty()) return {};
      if (rest_[0] == '#') rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size() - 1));
      if (rest_[0] == '\n') ++line_;
      else if (rest_[0] != ' ' && rest_[0] != '\t' && rest_[0] != '\r' && rest_[0] != '#') break;
    }
    const std::size_t n = std::min(rest_.find_first_of(" \t\r\n"), rest_.size());
    const Text w = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return w;
  }
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    const Text w = word();
    std::int64_t x = 0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), x);
    if (w.empty() || error != std::errc() || end != w.data() + w.size() || x < low || x > high) fail("expected an integer from " + std::to_string(low) + " to " + std::to_string(high) + ", found " + std::string(w));
    return x;
  }
  std::size_t count() { return static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(std::min<std::size_t>(rest_.size(), 1u << 31)))); }
  Number number(bool root5) {
    const Text w = word();
    std::int64_t x = 0;
    if (const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), x); !w.empty() && error == std::errc() && end == w.data() + w.size()) return {mpq_class(static_cast<long>(x)), 0};
    const Text tail = "*sqrt5";
    if (!(root5 && w.size() > tail.size() && w.substr(w.size() - tail.size()) == tail)) return {rational(w), 0};
    const Text both = w.substr(0, w.size() - tail.size());
    const std::size_t split = both.find_last_of("+-");
    if (split == Text::npos || split == 0) return {0, rational(both)};
    return {rational(both.substr(0, split)), rational(both[split] == '+' ? both.substr(split + 1) : both.substr(split))};
  }
  mpq_class rational(Text w) const {
    const std::size_t slash = w.find('/');
    const Text p = w.substr(0, slash), q = slash == Text::npos ? "1" : w.substr(slash + 1);
    const auto digits = [](Text t) { return !t.empty() && t.find_first_not_of("0123456789") == Text::npos; };
    if (!digits(p.substr(!p.empty() && p[0] == '-')) || !digits(q)) fail("expected a number, found " + std::string(w));
    mpq_class x{mpz_class(std::string(p)), mpz_class(std::string(q))};
    if (x.get_den() == 0) fail("a denominator is 0");
    x.canonicalize();
    return x;
  }

 private:
  Text rest_;
  std::string name_;
  std::size_t line_ = 1;
};

void read_plane(Scanner& in, Body& b) {
  Plane p;
  mpz_class common = 1;
  for (Number& x : p) x = in.number(b.root5), common = lcm(lcm(common, x.a.get_den()), x.b.get_den());
  for (Number& x : p) if (common != 1) x = x * Number{mpq_class(common), 0};
  if (is_zero(p[0]) && is_zero(p[1]) && is_zero(p[2])) in.fail("a plane without a normal");
  b.planes.add(p);
  const auto level = static_cast<Index>(in.integer(0, kNone - 1));
  const Text parent = in.word();
  Index number = kNone;
  const auto [end, error] = std::from_chars(parent.data(), parent.data() + parent.size(), number);
  if (parent != "-" && (parent.empty() || error != std::errc() || end != parent.data() + parent.size())) in.fail("expected a parent");
  b.address.emplace_back(level, number);
}

void read_section(Scanner& in, Body& b, Text keyword) {
  Surface& s = b.surface;
  if (keyword == "field") {
    const Text field = in.word();
    if (field != "Q" && field != "Q(sqrt5)") in.fail("unknown field");
    b.root5 = field != "Q";
  } else if (keyword == "scale") {
    b.scale = static_cast<long>(in.integer(-100000000, 100000000));
  } else if (keyword == "shift") {
    for (auto& x : b.shift) x = in.number(false).a;
  } else if (keyword == "planes" && !b.seen_planes) {
    b.seen_planes = true;
    for (std::size_t n = in.count(); n > 0; --n) read_plane(in, b);
  } else if (keyword == "loops" && b.seen_planes && !b.seen_loops) {
    b.seen_loops = true;
    if (in.count() != b.planes.size()) in.fail("one loop for each plane is expected");
    for (std::size_t f = 0; f < b.planes.size(); ++f) {
      for (std::size_t k = in.count(); k > 0; --k) s.corner.push_back(static_cast<Index>(in.integer(0, (1 << 30))));
      s.start.push_back(static_cast<Index>(s.corner.size()));
    }
  } else if (keyword == "vertices" && b.seen_loops && !b.seen_vertices) {
    b.seen_vertices = true;
    s.triple.resize(in.count());
    for (auto& t : s.triple) for (Index& f : t) f = static_cast<Index>(in.integer(0, static_cast<std::int64_t>(b.planes.size()) - 1));
  } else {
    in.fail("unexpected " + std::string(keyword));
  }
}

void finish(const Scanner& in, Body& b) {
  Surface& s = b.surface;
  if (!b.seen_loops) in.fail("a body without planes and loops");
  const std::size_t bound = s.corner.empty() ? 0 : std::size_t{*std::max_element(s.corner.begin(), s.corner.end())} + 1;
  if (b.seen_vertices ? bound > s.triple.size() : bound > s.corner.size()) in.fail("a loop names a vertex that does not exist");
  if (b.seen_vertices) return;
  s.triple.assign(bound, {kNone, kNone, kNone});
  std::vector<int> filled(bound, 0);
  for (std::size_t f = 0; f < s.facets(); ++f) {
    for (Index h = s.start[f]; h < s.start[f + 1]; ++h) {
      if (int& k = filled[s.corner[h]]; k++ < 3) s.triple[s.corner[h]][k - 1] = static_cast<Index>(f);
    }
  }
  if (std::any_of(filled.begin(), filled.end(), [](int k) { return k != 3; })) in.fail("without vertices every vertex lies on three facets");
}

Certificate parse(const std::string& bytes, const std::string& name) {
  Scanner in(bytes, name);
  if (in.word() != "hexact-certificate") throw Malformed(name + ": is no certificate; `hexact certify` makes one");
  if (in.word() != "1") in.fail("only version 1 is known");
  Certificate c;
  Body* body = &c.body;
  for (Text w = in.word(); w != "sha256"; w = in.word()) {
    if (w.empty()) in.fail("the digest is missing");
    if (w == "claim") {
      const std::string claim(in.word()), head = claim.substr(0, claim.find('='));
      const bool about = head == "inside" || head == "tangent" || head == "corner-cut-of";
      if (!about && claim != "closed" && claim != "planar" && claim != "trivalent" && claim != "convex") in.fail("unknown claim " + claim);
      if (about && claim.size() < head.size() + 2) in.fail("a claim without a body");
      c.claims.emplace_back(head, about ? claim.substr(head.size() + 1) : "");
    } else if (w == "body") {
      const auto [it, is_new] = c.bodies.try_emplace(std::string(in.word()));
      if (!is_new) in.fail("a second body of that name");
      body = &it->second;
    } else if (w == "support") {
      auto& list = c.supports[std::string(in.word())];
      const std::size_t plane = in.count(), vertex = in.count();
      list.emplace(plane, vertex);
    } else {
      read_section(in, *body, w);
    }
  }
  finish(in, c.body);
  for (auto& [key_, b] : c.bodies) finish(in, b);
  const std::string found(in.word());
  if (!in.word().empty()) in.fail("bytes follow the digest");
  const std::size_t last = bytes.rfind("\nsha256 ");
  if (last == std::string::npos || sha256(bytes.substr(0, last + 1)) != found) in.fail("the digest does not match");
  if (c.claims.empty()) throw Malformed(name + ": has no claims; `hexact certify` adds them");
  for (const auto& [claim, reference] : c.claims) if (!reference.empty() && !c.bodies.count(reference)) in.fail("there is no body " + reference);
  return c;
}

// ---- the mesh --------------------------------------------------------------------------------------------------

struct Mesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<Index>> loops;
};

Mesh read_mesh(const std::string& path) {
  const std::string bytes = read_file(path);
  Scanner in(bytes, path);
  Mesh mesh;
  const auto coordinate = [&] {
    const std::string w(in.word());
    char* end = nullptr;
    const double x = std::strtod(w.c_str(), &end);
    if (w.empty() || *end != 0 || !std::isfinite(x)) in.fail("expected a coordinate, found " + w);
    return x;
  };
  if (bytes.compare(0, 3, "OFF") == 0) {
    in.word();
    mesh.points.resize(in.count());
    mesh.loops.resize(in.count());
    in.word();
    for (auto& p : mesh.points) for (double& x : p) x = coordinate();
    for (auto& loop : mesh.loops) {
      loop.resize(in.count());
      for (Index& v : loop) v = static_cast<Index>(in.integer(0, static_cast<std::int64_t>(mesh.points.size()) - 1));
    }
    return mesh;
  }
  bool in_face = false;
  for (Text w = in.word(); !w.empty(); w = in.word()) {
    if (in_face && w.find_first_not_of("0123456789/") == Text::npos) {
      Index v = 0;
      std::from_chars(w.data(), w.data() + w.size(), v);
      if (v == 0 || v > mesh.points.size()) in.fail("a corner that does not exist");
      mesh.loops.back().push_back(v - 1);
      continue;
    }
    in_face = w == "f";
    if (w == "v") mesh.points.push_back({coordinate(), coordinate(), coordinate()});
    else if (in_face) mesh.loops.emplace_back();
    else if (w == "g" || w == "o" || w == "s" || w == "usemtl" || w == "mtllib") in.word();
    else in.fail("expected a line of an OBJ or OFF file, found " + std::string(w));
  }
  return mesh;
}

// Whether m is the double nearest to x, ties to even: x lies between the midpoints to the neighbours of m.
bool is_nearest(double m, const Number& x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &m, sizeof m);
  const double lower = std::nextafter(m, -HUGE_VAL), upper = std::nextafter(m, HUGE_VAL);
  if (!std::isfinite(lower) || !std::isfinite(upper)) return false;
  const int below_x = sign(x - Number{(mpq_class(m) + mpq_class(lower)) / 2, 0});
  const int above_x = sign(x - Number{(mpq_class(m) + mpq_class(upper)) / 2, 0});
  return (bits & 1) == 0 ? below_x >= 0 && above_x <= 0 : below_x > 0 && above_x < 0;
}

std::string wrong_vertex(const Body& b, const Mesh& mesh, std::size_t v) {
  const auto& t = b.surface.triple[v];
  const std::array<Plane, 3> rows{b.planes[t[0]], b.planes[t[1]], b.planes[t[2]]};
  const Number w = det3(rows[0], rows[1], rows[2]);
  if (is_zero(w)) return vertex_name(v) + ": det3 of its planes = 0";
  for (int k = 0; k < 3; ++k) {
    std::array<Plane, 3> changed = rows;
    for (Plane& p : changed) p[k] = p[3];
    const Number x = quotient(det3(changed[0], changed[1], changed[2]), w) * Number{power_of_two(b.scale), 0} + Number{b.shift[k], 0};
    if (!is_nearest(mesh.points[v][k], x)) return vertex_name(v) + ": a coordinate is not the correct rounding of " + text(x);
  }
  return {};
}

std::string rounding(const Body& b, const Mesh& mesh) {
  if (mesh.points.size() != b.surface.triple.size()) return "the mesh has " + std::to_string(mesh.points.size()) + " vertices, expected " + std::to_string(b.surface.triple.size());
  std::size_t facet = 0;
  for (std::size_t f = 0; f < b.surface.facets(); ++f) {
    if (b.surface.start[f] == b.surface.start[f + 1]) continue;
    if (facet == mesh.loops.size() || !std::equal(b.surface.corner.begin() + b.surface.start[f], b.surface.corner.begin() + b.surface.start[f + 1],
                                                  mesh.loops[facet].begin(), mesh.loops[facet].end())) return facet_name(facet) + ": the mesh has another loop";
    ++facet;
  }
  if (facet != mesh.loops.size()) return "the mesh has more facets";
  const std::size_t half = mesh.points.size() / 2;
  const auto range = [&](std::size_t first, std::size_t last) {
    for (; first < last; ++first) if (std::string w = wrong_vertex(b, mesh, first); !w.empty()) return w;
    return std::string();
  };
  auto second = std::async(std::launch::async, range, half, mesh.points.size());
  std::string w = range(0, half);
  const std::string rest = second.get();
  return w.empty() ? rest : w;
}

std::string quoted(const std::string& s) {
  std::string out = "\"";
  for (const char c : s) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) out += c;
  }
  return out + "\"";
}

int run(const std::vector<std::string>& files, bool json) {
  const Certificate c = parse(read_file(files[0]), files[0]);
  std::optional<Mesh> mesh;
  if (files.size() == 2) mesh = read_mesh(files[1]);
  std::string claims, lines, witness;
  const auto add = [&](const std::string& name, const std::string& fault) {
    const std::string verdict = fault.empty() ? "proved" : "refuted";
    claims += (claims.empty() ? "" : ", ") + quoted(name) + ": " + quoted(verdict);
    lines += name + ": " + verdict + (fault.empty() ? "" : ": " + fault) + "\n";
    if (witness.empty() && !fault.empty()) witness = name + ": " + fault;
  };
  for (const auto& [claim, reference] : c.claims) add(reference.empty() ? claim : claim + "=" + reference, decide(c, claim, reference));
  if (mesh) add("mesh", rounding(c.body, *mesh));
  const std::string verdict = witness.empty() ? "proved" : "refuted";
  if (json) {
    std::printf("{\"verdict\": %s, \"claims\": {%s}%s%s}\n", quoted(verdict).c_str(), claims.c_str(), witness.empty() ? "" : ", \"witness\": ", witness.empty() ? "" : quoted(witness).c_str());
  } else {
    std::printf("%s%s\n", lines.c_str(), verdict.c_str());
  }
  return std::fflush(stdout) != 0 ? 3 : witness.empty() ? 0 : 1;
}

constexpr const char* kHelp =
    "hexact-check [--json] CERT [MESH]\n"
    "Verifies every claim of the certificate CERT with exact arithmetic and, given MESH (OBJ or OFF), that it is the\n"
    "correct rounding: the same loops, every coordinate the double nearest to the exact one (ties to even).\n"
    "Exit status: 0 all claims hold; 1 a claim does not hold (the witness is printed); 2 wrong usage;\n"
    "3 a file cannot be read or is malformed.\n";

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  bool json = false;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    if (a == "--help" || a == "-h") return std::fputs(kHelp, stdout) < 0 ? 3 : 0;
    if (a == "--version") return std::printf("hexact-check 0.1.0\nGMP %s\n", gmp_version) < 0 ? 3 : 0;
    if (a == "--json") json = true;
    else if (a.size() > 1 && a[0] == '-') files.resize(3);
    else files.push_back(a);
  }
  if (files.empty() || files.size() > 2) return std::fputs(kHelp, stderr), 2;
  try {
    return run(files, json);
  } catch (const std::exception& e) {
    if (json) std::printf("{\"error\": {\"code\": \"ParseError\", \"message\": %s}}\n", quoted(e.what()).c_str());
    std::fprintf(stderr, "hexact-check: %s\n", e.what());
    return 3;
  }
}
