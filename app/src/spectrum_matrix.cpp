// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrum_matrix.hpp"

#include "hexact/io/output_file.hpp"

#include <nlohmann/json.hpp>

namespace hexact::app {
namespace {

using Json = nlohmann::ordered_json;

/// "p/q", or the coefficients of a polynomial in a cosine, the constant first.
Json entry_json(const CosinePolynomial& p) {
  std::size_t length = p.size();
  while (length > 0 && p[length - 1].is_zero()) --length;
  if (length <= 1) return length == 0 ? "0" : p.front().str();
  Json out = Json::array();
  for (std::size_t i = 0; i < length; ++i) out.push_back(p[i].str());
  return out;
}

Json entries_json(const std::vector<CosinePolynomial>& entries) {
  Json out = Json::array();
  for (const CosinePolynomial& p : entries) out.push_back(entry_json(p));
  return out;
}

Json block_json(const SubdivisionMatrix& matrix, int d) {
  const std::vector<CosinePolynomial> block = sector_block(matrix, d);
  Json rows = Json::array();
  for (auto row = block.begin(); row != block.end(); row += static_cast<std::ptrdiff_t>(matrix.size())) {
    rows.push_back(entries_json({row, row + static_cast<std::ptrdiff_t>(matrix.size())}));
  }
  return rows;
}

Json centre_json(const SubdivisionMatrix& matrix) {
  if (!matrix.has_centre) return nullptr;
  Json to = Json::array();
  for (const Rational& w : matrix.centre_to) to.push_back(w.str());
  return {{"self", entry_json(matrix.centre)}, {"from", entries_json(matrix.centre_from)}, {"to", std::move(to)}};
}

/// Coefficients over Q where the cosine is rational.
Json factor_json(const CharacteristicFactor& factor, int k) {
  const RationalCosine c = rational_cosine(factor.angle, k);
  std::vector<CosinePolynomial> coefficients = factor.coefficients;
  for (CosinePolynomial& p : coefficients) {
    if (!c.found) continue;
    Rational value;
    for (std::size_t i = p.size(); i-- > 0;) value = value * c.value + p[i];
    p = {value};
  }
  return {{"angle", factor.angle}, {"coefficients", entries_json(coefficients)}};
}

Json mode_json(const SubdivisionMatrix& matrix, int mode) {
  Json factors = Json::array();
  for (const CharacteristicFactor& factor : characteristic_factors(matrix, mode)) factors.push_back(factor_json(factor, matrix.valence));
  return {{"mode", mode}, {"factors", std::move(factors)}};
}

const char* name_of(SectorLattice lattice) {
  switch (lattice) {
    case SectorLattice::dual: return "dual";
    case SectorLattice::quads: return "quads";
    case SectorLattice::triangles: return "triangles";
  }
  return "";
}

Json matrix_json(const SubdivisionMatrix& matrix) {
  Json json = {{"k", matrix.valence}, {"lattice", name_of(matrix.lattice)}, {"vertices", matrix.vertices}};
  json["centre"] = centre_json(matrix);
  json["blocks"] = Json::array();
  for (int d = 0; d < matrix.valence; ++d) json["blocks"].push_back(block_json(matrix, d));
  json["modes"] = Json::array();
  for (int mode = 0; 2 * mode <= matrix.valence; ++mode) json["modes"].push_back(mode_json(matrix, mode));
  return json;
}

}  // namespace

void write_subdivision_matrices(const std::string& path, const std::string& scheme, const std::vector<SpectrumSubject>& subjects) {
  Json document = {{"hexact", "subdivision-matrix"}, {"version", 1}, {"scheme", scheme}, {"matrices", Json::array()}};
  for (const SpectrumSubject& subject : subjects) document["matrices"].push_back(matrix_json(subject.matrix));
  io::write_file(path, document.dump() + "\n");
}

}  // namespace hexact::app
