// SPDX-License-Identifier: LGPL-3.0-or-later
// Certificates of spectra: that the eigenvalues of subdivision matrices are what they are said to be, and that the
// rings of characteristic maps are regular and injective. What is proved, and why it suffices, is in docs/spectrum.md.
#pragma once

#include "ball.hpp"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace check {

struct ListedValue {
  mpq_class lo, hi;
  int multiplicity;
};
struct ListedRow {
  int k = 0;
  mpq_class cosine_lo, cosine_hi;
  std::vector<std::vector<ListedValue>> modes;
  int level = 0;
  mpq_class jacobian, half_plane;
};
enum class Scheme { midedge, midedge6, loop, catmull_clark, doo_sabin };
struct SpectrumFile {
  Scheme scheme = Scheme::midedge6;
  std::vector<ListedRow> rows;
};

// Whether the file begins with the word hexact-spectrum.
bool is_spectrum_file(const std::string& path);
// Throws Malformed.
SpectrumFile read_spectrum(const std::string& path);
// For every claim of the file its name and what is wrong with its proof; empty if nothing is.
std::vector<std::pair<std::string, std::string>> spectrum_faults(const SpectrumFile& file);

// ---- matrices ----------------------------------------------------------------------------------------------------

using Waves = std::map<int, mpq_class>;                      // sum of weight · z^exponent
using Form = std::map<std::pair<int, int>, Waves>;           // weights of the vertices (i, j) of sector 0

// The rule of a scheme on nets with u(sector s) = z^s u(sector 0), z = e^{2 pi i mode/k}; in mode 0 z = 1, but z stands
// for e^{2 pi i/k} where the rule's own numbers contain cos(2 pi/k). The central vertex is (0, 0) in primal schemes.
class ModeRule {
 public:
  ModeRule(Scheme scheme, int k, int mode);
  bool primal() const { return scheme_ == Scheme::loop || scheme_ == Scheme::catmull_clark; }
  // The vertices of sector 0, the central one first if there is one.
  const std::vector<std::pair<int, int>>& vertices() const { return vertices_; }
  Form fine(int i, int j) const;
  // The coarse vertex with coordinates of sector 0, continued over its sides.
  Form vertex(int x, int y) const;

 private:
  Form corner_sum(int cx, int cy) const;
  Form middle(int x, int y) const;
  Form middle_sum_of_cell(int cx, int cy) const;
  Form midedge_fine(int i, int j) const;
  Form spline_fine(int i, int j) const;
  Form box_fine(int i, int j) const;
  Form doo_sabin_fine(int i, int j) const;
  Form centre() const;
  Scheme scheme_;
  int k_, mode_;
  mpq_class q_;
  std::vector<std::pair<int, int>> vertices_;
};

// ---- rings -------------------------------------------------------------------------------------------------------

// What is wrong with the proof of the ring of a row whose subdominant eigenvalue, of mode 1, is in [lo, hi].
std::string ring_fault(Scheme scheme, const ListedRow& row, const ListedValue& eigenvalue);

// e^{2 pi i j/k} for j = 0 ... k - 1, from a proven interval for the cosine.
std::vector<ComplexBall> turns(const ListedRow& row);
ComplexBall at_turn(const Waves& w, const std::vector<ComplexBall>& turns, int mode);

}  // namespace check
