// SPDX-License-Identifier: LGPL-3.0-or-later
// The subdivision rules, from their descriptions: faces, edges and vertices of the net around the centre.
#include "spectrum.hpp"

#include <cstdlib>

namespace check {
namespace {

void add(Form& to, const Form& f, const mpq_class& factor) {
  for (const auto& [place, waves] : f) {
    for (const auto& [exponent, w] : waves) {
      mpq_class& x = to[place][exponent];
      x += w * factor;
      if (x == 0) to[place].erase(exponent);
    }
    if (to[place].empty()) to.erase(place);
  }
}
Form total(std::initializer_list<std::pair<Form, mpq_class>> parts) {
  Form f;
  for (const auto& [part, factor] : parts) add(f, part, factor);
  return f;
}
mpq_class ratio(int p, int q) {
  mpq_class x(p, q);
  x.canonicalize();
  return x;
}

}  // namespace

std::string mask_fault(Scheme scheme, const ListedRow& row) {
  if (!row.mask) return scheme == Scheme::blocks ? "the row gives no blocks" : "";
  const std::vector<mpq_class>& w = row.mask->weights;
  const auto k = static_cast<std::size_t>(row.k);
  if (scheme == Scheme::blocks) return "";
  if (scheme == Scheme::midedge || scheme == Scheme::midedge6) return "masks replace a rule of loop, catmull-clark or doo-sabin";
  const std::size_t n = scheme == Scheme::loop ? 2 : scheme == Scheme::catmull_clark ? 3 : k;
  if (w.size() != n) return "there must be " + std::to_string(n) + " weights";
  for (std::size_t d = 1; scheme == Scheme::doo_sabin && d < k; ++d) {
    if (w[d] != w[k - d]) return "the weights have no mirror image";
  }
  return "";
}

ModeRule::ModeRule(Scheme scheme, const ListedRow& row, int mode) : scheme_(scheme), mask_(row.mask), k_(row.k), mode_(mode) {
  if (scheme == Scheme::blocks) {
    for (int i = 0; i < mask_->side; ++i) vertices_.push_back({i, 0});
    return;
  }
  if (scheme == Scheme::midedge6) q_ = ratio(3, 16 * (k_ - 2));
  const int side = scheme == Scheme::midedge6 ? 4 : 3;
  if (primal() && mode == 0) vertices_.push_back({0, 0});
  for (int i = primal() ? 1 : 0; i < side + (primal() ? 1 : 0); ++i) {
    for (int j = 0; j < side + (primal() ? 1 : 0); ++j) {
      if (scheme != Scheme::loop || i + j <= side) vertices_.push_back({i, j});
    }
  }
}

// Turning by one sector maps (x, y) of a quad lattice about a vertex to (-y, x), and about a face's centre, where
// vertices are half a step off, to (-y - 1, x); of a triangle lattice, where the next axis is y, to (-y, x + y).
Form ModeRule::vertex(int x, int y) const {
  int sector = 0;
  if (primal() && x == 0 && y == 0) return mode_ == 0 ? Form{{{0, 0}, {{0, 1}}}} : Form{};
  const auto inside = [&] { return primal() ? x > 0 && y >= 0 : x >= 0 && y >= 0; };
  const bool back = y < 0;  // then it lies in a sector before this one, else behind it
  while (!inside()) {
    const int a = x, b = y;
    if (scheme_ == Scheme::loop) x = back ? -b : a + b, y = back ? a + b : -a;
    else if (primal()) x = back ? -b : b, y = back ? a : -a;
    else x = back ? -b - 1 : b, y = back ? a : -a - 1;
    sector += back ? -1 : 1;
  }
  return {{{x, y}, {{mode_ == 0 ? 0 : sector, 1}}}};
}

// ---- midedge: cells by their lower corners, (-1, -1) being the k-gon; edges by the doubled middles --------------------

Form ModeRule::corner_sum(int cx, int cy) const {
  if (cx == -1 && cy == -1) return mode_ == 0 ? total({{vertex(0, 0), k_}}) : Form{};
  return total({{vertex(cx, cy), 1}, {vertex(cx + 1, cy), 1}, {vertex(cx + 1, cy + 1), 1}, {vertex(cx, cy + 1), 1}});
}

// The new vertex of the edge with middle (x, y)/2: (5/8 - 2 qf - 2 qg) times the midpoint, and qf and qg times the
// sums over the corners of the two faces.
Form ModeRule::middle(int x, int y) const {
  const bool along_x = x % 2 != 0;
  const int a = along_x ? (x - 1) / 2 : x / 2, b = along_x ? y / 2 : (y - 1) / 2;
  const Form both = total({{vertex(a, b), ratio(1, 2)}, {along_x ? vertex(a + 1, b) : vertex(a, b + 1), ratio(1, 2)}});
  if (scheme_ == Scheme::midedge) return both;
  Form out;
  mpq_class own = ratio(5, 8);
  for (int side = 0; side < 2; ++side) {
    const int cx = along_x ? a : a - side, cy = along_x ? b - side : b;
    const mpq_class q = cx == -1 && cy == -1 ? q_ : ratio(3, 32);
    add(out, corner_sum(cx, cy), q);
    own -= 2 * q;
  }
  add(out, both, own);
  return out;
}

Form ModeRule::middle_sum_of_cell(int cx, int cy) const {
  if (cx == -1 && cy == -1) return mode_ == 0 ? total({{middle(0, -1), k_}}) : Form{};
  return total({{middle(2 * cx + 1, 2 * cy), 1}, {middle(2 * cx + 1, 2 * cy + 2), 1}, {middle(2 * cx, 2 * cy + 1), 1}, {middle(2 * cx + 2, 2 * cy + 1), 1}});
}

// The second step: the edge that joins the new vertices of two edges at a corner (x, y) of a cell. Its faces are the
// cell's and the corner's.
Form ModeRule::midedge_fine(int i, int j) const {
  const int x = i / 2, y = j / 2, sx = i % 2 != 0 ? 1 : -1, sy = j % 2 != 0 ? 1 : -1;
  const Form both = total({{middle(2 * x + sx, 2 * y), ratio(1, 2)}, {middle(2 * x, 2 * y + sy), ratio(1, 2)}});
  if (scheme_ == Scheme::midedge) return both;
  const int cx = sx > 0 ? x : x - 1, cy = sy > 0 ? y : y - 1;
  const mpq_class q = cx == -1 && cy == -1 ? q_ : ratio(3, 32);
  Form out = total({{both, ratio(5, 8) - 2 * q - ratio(3, 16)}, {middle_sum_of_cell(cx, cy), q}});
  for (const int s : {1, -1}) add(out, total({{middle(2 * x + s, 2 * y), 1}, {middle(2 * x, 2 * y + s), 1}}), ratio(3, 32));
  return out;
}

Form ModeRule::doo_sabin_fine(int i, int j) const {
  if (i == 0 && j == 0 && mask_) return sectors(0, mask_->weights);
  if (i == 0 && j == 0) return total({{vertex(0, 0), mode_ == 0 ? ratio(1, 1) : mode_ == 1 ? ratio(1, 2) : ratio(1, 4)}});
  const int x = i / 2, y = j / 2, sx = i % 2 != 0 ? 1 : -1, sy = j % 2 != 0 ? 1 : -1;
  return total({{vertex(x, y), ratio(9, 16)}, {vertex(x + sx, y), ratio(3, 16)}, {vertex(x, y + sy), ratio(3, 16)}, {vertex(x + sx, y + sy), ratio(1, 16)}});
}

// ---- Catmull and Clark: face points, edge points, vertex points ------------------------------------------------------

Form ModeRule::spline_fine(int i, int j) const {
  const int x = i / 2, y = j / 2;
  const auto face = [&](int cx, int cy) { return total({{corner_sum(cx, cy), ratio(1, 4)}}); };
  if (i % 2 != 0 && j % 2 != 0) return face(x, y);
  if (i % 2 != 0) return total({{vertex(x, y), ratio(1, 4)}, {vertex(x + 1, y), ratio(1, 4)}, {face(x, y), ratio(1, 4)}, {face(x, y - 1), ratio(1, 4)}});
  if (j % 2 != 0) return total({{vertex(x, y), ratio(1, 4)}, {vertex(x, y + 1), ratio(1, 4)}, {face(x, y), ratio(1, 4)}, {face(x - 1, y), ratio(1, 4)}});
  Form out = total({{vertex(x, y), ratio(1, 2)}});  // (Q + 2R + S)/4
  for (const int a : {0, -1}) {
    for (const int b : {0, -1}) add(out, face(x + a, y + b), ratio(1, 16));
  }
  for (const int s : {1, -1}) add(out, total({{vertex(x + s, y), 1}, {vertex(x, y + s), 1}}), ratio(1, 16));
  return out;
}

Form ModeRule::box_fine(int i, int j) const {
  const int x = i / 2, y = j / 2;
  const auto edge = [&](const Form& a, const Form& b, const Form& c, const Form& d) {
    return total({{a, ratio(3, 8)}, {b, ratio(3, 8)}, {c, ratio(1, 8)}, {d, ratio(1, 8)}});
  };
  if (i % 2 != 0 && j % 2 != 0) return edge(vertex(x + 1, y), vertex(x, y + 1), vertex(x, y), vertex(x + 1, y + 1));
  if (i % 2 != 0) return edge(vertex(x, y), vertex(x + 1, y), vertex(x, y + 1), vertex(x + 1, y - 1));
  if (j % 2 != 0) return edge(vertex(x, y), vertex(x, y + 1), vertex(x + 1, y), vertex(x - 1, y + 1));
  Form out = total({{vertex(x, y), ratio(5, 8)}});
  for (const int s : {1, -1}) add(out, total({{vertex(x + s, y), 1}, {vertex(x, y + s), 1}, {vertex(x + s, y - s), 1}}), ratio(1, 16));
  return out;
}

// The central vertex; mode 0 only, where all sectors are alike.
Form ModeRule::centre() const {
  const Form s = vertex(0, 0), e = vertex(1, 0);
  if (mask_) {
    Form out = total({{s, mask_->weights[0]}, {e, k_ * mask_->weights[1]}});
    if (scheme_ == Scheme::catmull_clark) add(out, vertex(1, 1), k_ * mask_->weights[2]);
    return out;
  }
  if (scheme_ == Scheme::catmull_clark) {  // (Q + 2R + (k - 3) S)/k
    const Form r = total({{s, ratio(1, 2)}, {e, ratio(1, 2)}}), q = total({{s, ratio(1, 4)}, {e, ratio(1, 2)}, {vertex(1, 1), ratio(1, 4)}});
    return total({{q, ratio(1, k_)}, {r, ratio(2, k_)}, {s, ratio(k_ - 3, k_)}});
  }
  Waves square;  // (3/8 + z/8 + 1/(8 z))^2: the part of the old centre and more, 3/8 + that; the ring has 5/8 - that
  const std::map<int, mpq_class> b{{-1, ratio(1, 8)}, {0, ratio(3, 8)}, {1, ratio(1, 8)}};
  for (const auto& [m, u] : b) {
    for (const auto& [n, w] : b) square[m + n] += u * w;
  }
  Form out;
  for (const auto& [exponent, w] : square) out[{0, 0}][exponent] = w, out[{1, 0}][exponent] = -w;
  out[{0, 0}][0] += ratio(3, 8);
  out[{1, 0}][0] += ratio(5, 8);
  return out;
}

// ---- matrices that are given: weights of the sectors 0 ... k-1 ---------------------------------------------------------

// Powers of z between -k/2 and k/2; half a turn is one half each way.
Form ModeRule::sectors(std::size_t c, const std::vector<mpq_class>& by_sector) const {
  Form out;
  const std::pair<int, int> place = vertices_[c];
  for (int d = 0; d < k_; ++d) {
    const mpq_class& w = by_sector[static_cast<std::size_t>(d)];
    if (mode_ == 0) add(out, {{place, {{0, 1}}}}, w);
    else if (2 * d == k_) add(out, {{place, {{d, 1}, {-d, 1}}}}, w / 2);
    else add(out, {{place, {{2 * d < k_ ? d : d - k_, 1}}}}, w);
  }
  return out;
}

Form ModeRule::block_row(int i) const {
  const auto n = static_cast<std::size_t>(mask_->side), r = static_cast<std::size_t>(i);
  Form out;
  for (std::size_t c = 0; c < n; ++c) {
    std::vector<mpq_class> by_sector;
    for (const auto& block : mask_->blocks) by_sector.push_back(block[r * n + c]);
    add(out, sectors(c, by_sector), 1);
  }
  return out;
}

Form ModeRule::fine(int i, int j) const {
  if (scheme_ == Scheme::blocks) return block_row(i);
  if (primal() && i == 0 && j == 0) return centre();
  switch (scheme_) {
    case Scheme::loop: return box_fine(i, j);
    case Scheme::catmull_clark: return spline_fine(i, j);
    case Scheme::doo_sabin: return doo_sabin_fine(i, j);
    default: return midedge_fine(i, j);
  }
}

}  // namespace check
