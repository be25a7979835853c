// SPDX-License-Identifier: LGPL-3.0-or-later
// Certificates of spectra: that the eigenvalues of subdivision matrices are what they are said to be, and that the
// rings of characteristic maps are regular and injective. What is proved, and why it suffices, is in docs/spectrum.md.
#pragma once

#include "ball.hpp"
#include "regular.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace check {

// A matrix whose polynomials would take minutes; exit 4.
struct TooMuchWork : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ListedValue {
  mpq_class lo, hi;
  int multiplicity;
};
struct ListedMode {
  std::vector<ListedValue> values;
  int rest = 0;      // further eigenvalues, of modulus below radius
  mpq_class radius;
};
struct Mask {
  std::vector<mpq_class> weights;               // in place of the scheme's rule for the centre or the k-gon
  std::vector<std::vector<mpq_class>> blocks;   // or D_0 ... D_{k-1}, side x side numbers each
  int side = 0;
};
struct RingBounds {
  int level = 0;
  mpq_class jacobian, half_plane;
};
struct ListedRow {
  int k = 0;
  std::optional<Mask> mask;
  mpq_class cosine_lo, cosine_hi;
  std::vector<ListedMode> modes;
  std::optional<RingBounds> ring;
};
enum class Scheme { midedge, midedge6, loop, catmull_clark, doo_sabin, blocks };
enum class Statement { ordering, ring, c1, ordering_fails, ring_fails, c1_fails, regular };
struct SpectrumClaim {
  std::string text;
  Statement statement;
  std::size_t row;  // which it is about; of `regular` the number of rows
};
struct SpectrumFile {
  Scheme scheme = Scheme::midedge6;
  std::vector<SpectrumClaim> claims;
  std::vector<ListedRow> rows;
  std::optional<RegularBlock> regular;
};

// Whether the file begins with the word hexact-spectrum.
bool is_spectrum_file(const std::string& path);
// Throws Malformed.
SpectrumFile read_spectrum(const std::string& path);
SpectrumFile parse_spectrum(std::string_view bytes, const std::string& name);
// What the claims are about: the scheme, and the masks if there are some. As JSON members, and as lines.
std::string subject_json(const SpectrumFile& file);
std::string subject_text(const SpectrumFile& file);
// For every claim of the file its name and what is wrong with its proof; empty if nothing is.
std::vector<std::pair<std::string, std::string>> spectrum_faults(const SpectrumFile& file);

// ---- matrices ----------------------------------------------------------------------------------------------------

using Waves = std::map<int, mpq_class>;                      // sum of weight · z^exponent
using Form = std::map<std::pair<int, int>, Waves>;           // weights of the vertices (i, j) of sector 0

// The rule of a scheme on nets with u(sector s) = z^s u(sector 0), z = e^{2 pi i mode/k}; in mode 0 z = 1, but z stands
// for e^{2 pi i/k} where the rule's own numbers contain cos(2 pi/k). The central vertex is (0, 0) in primal schemes.
class ModeRule {
 public:
  ModeRule(Scheme scheme, const ListedRow& row, int mode);
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
  Form sectors(std::size_t c, const std::vector<mpq_class>& by_sector) const;
  Form block_row(int i) const;
  Scheme scheme_;
  const std::optional<Mask>& mask_;
  int k_, mode_;
  mpq_class q_;
  std::vector<std::pair<int, int>> vertices_;
};

// Why a row's mask is none for the scheme; empty if it is one, or the scheme's own rule holds.
std::string mask_fault(Scheme scheme, const ListedRow& row);

// ---- eigenvalues -------------------------------------------------------------------------------------------------

// What is wrong with the row's eigenvalues, which must be all of the matrix; empty if nothing is.
std::string spectrum_fault(Scheme scheme, const ListedRow& row);

// What follows from a complete list of eigenvalues about 1 > L2 = L3 > |L4|.
struct Order {
  enum { holds, fails, unknown } outcome = unknown;
  std::string reason;                   // unless it holds
  const ListedValue* second = nullptr;  // if it holds
  int second_mode = 0;
};
Order order_of(const ListedRow& row);

// ---- rings -------------------------------------------------------------------------------------------------------

// What is wrong with the proof of the ring of a row whose subdominant eigenvalue, of mode 1, is in [lo, hi]. The row has
// bounds of a ring.
std::string ring_fault(Scheme scheme, const ListedRow& row, const ListedValue& eigenvalue);

// e^{2 pi i j/k} for j = 0 ... k - 1, from a proven interval for the cosine.
std::vector<ComplexBall> turns(const ListedRow& row);
ComplexBall at_turn(const Waves& w, const std::vector<ComplexBall>& turns, int mode);

}  // namespace check
