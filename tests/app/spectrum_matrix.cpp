// SPDX-License-Identifier: GPL-3.0-or-later
// The document of spectrum --matrix: what stands in it is one matrix, and its polynomials are those of that matrix.
#include "hexact/exact/rational.hpp"
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace hexact;
using Json = nlohmann::json;

namespace {

Rational number(const Json& text) {
  Rational value;
  REQUIRE(Rational::parse(text.get<std::string>(), value) == Rational::ParseResult::ok);
  return value;
}

using Matrix = std::vector<std::vector<Rational>>;

/// An entry at the cosine c.
Rational at(const Json& entry, const Rational& c) {
  if (entry.is_string()) return number(entry);
  Rational value;
  for (std::size_t i = entry.size(); i-- > 0;) value = value * c + number(entry[i]);
  return value;
}

/// The matrix on vectors that are the same in all sectors (sign 1), or change their sign from one to the next (−1).
Matrix mode_matrix(const Json& m, const Rational& c, int sign) {
  const std::size_t n = m["vertices"].size();
  const bool centre = sign == 1 && !m["centre"].is_null();
  Matrix out(n, std::vector<Rational>(n));
  for (std::size_t d = 0; d < m["blocks"].size(); ++d) {
    for (std::size_t r = 0; r < n; ++r) {
      for (std::size_t s = 0; s < n; ++s) out[r][s] += Rational(d % 2 == 0 ? 1 : sign) * at(m["blocks"][d][r][s], c);
    }
  }
  if (!centre) return out;
  for (std::size_t r = 0; r < n; ++r) out[r].push_back(at(m["centre"]["to"][r], c));
  out.emplace_back();
  for (std::size_t s = 0; s < n; ++s) out.back().push_back(Rational(m["k"].get<int>()) * at(m["centre"]["from"][s], c));
  out.back().push_back(at(m["centre"]["self"], c));
  return out;
}

Rational determinant(Matrix a) {
  Rational det(1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t pivot = i;
    while (pivot < a.size() && a[pivot][i].is_zero()) ++pivot;
    if (pivot == a.size()) return Rational(0);
    if (pivot != i) std::swap(a[i], a[pivot]), det = -det;
    det *= a[i][i];
    for (std::size_t r = i + 1; r < a.size(); ++r) {
      const Rational f = a[r][i] / a[i][i];
      for (std::size_t s = i; s < a.size(); ++s) a[r][s] -= f * a[i][s];
    }
  }
  return det;
}

Rational determinant_at(Matrix a, const Rational& x) {  // det(x − A)
  for (std::size_t r = 0; r < a.size(); ++r) {
    for (Rational& entry : a[r]) entry = -entry;
    a[r][r] += x;
  }
  return determinant(std::move(a));
}

Rational polynomial_at(const Json& mode, const Rational& x) {
  Rational product(1);
  for (const Json& factor : mode["factors"]) {
    Rational value;
    for (std::size_t i = factor["coefficients"].size(); i-- > 0;) value = value * x + at(factor["coefficients"][i], Rational(0));
    product *= value;
  }
  return product;
}

}  // namespace

TEST_CASE("spectrum --matrix: blocks and polynomials belong together", "[spectrum][program]") {
  const program::Folder folder;
  for (const std::string scheme : {"midedge", "midedge6", "loop", "catmull-clark", "doo-sabin"}) {
    for (const int k : {3, 4, 6}) {  // cos(2π/k) is rational: all of it can be computed here
      CAPTURE(scheme, k);
      (void)program::run(folder, "$hexact spectrum --scheme " + scheme + " --valence " + std::to_string(k) + " --matrix m.json");
      const Json document = Json::parse(program::read_bytes((folder.path() / "m.json").string()));
      CHECK(program::run(folder, "python3 -W ignore -m jsonschema -i m.json " HEXACT_SOURCE_DIR "/io/schema/subdivision-matrix.schema.json").status == 0);
      REQUIRE(document["matrices"].size() == 1);
      const Json& m = document["matrices"][0];
      REQUIRE(m["blocks"].size() == static_cast<std::size_t>(k));
      REQUIRE(m["modes"].size() == static_cast<std::size_t>(k / 2 + 1));
      const Rational c = k == 3 ? Rational(-1) / Rational(2) : k == 4 ? Rational(0) : Rational(1) / Rational(2);

      const Matrix even = mode_matrix(m, c, 1);
      for (const auto& row : even) {
        Rational sum;
        for (const Rational& x : row) sum += x;
        CHECK(sum == Rational(1));
      }
      for (const Rational& x : {Rational(2), Rational(-3), Rational(1) / Rational(7)}) {
        CHECK(polynomial_at(m["modes"][0], x) == determinant_at(even, x));
        if (k % 2 == 0) CHECK(polynomial_at(m["modes"].back(), x) == determinant_at(mode_matrix(m, c, -1), x));
      }
      CHECK(polynomial_at(m["modes"][0], Rational(1)).is_zero());
    }
  }
}

TEST_CASE("spectrum --matrix: polynomials in cosines, masks, standard output", "[spectrum][program]") {
  const program::Folder folder;
  program::Run r = program::run(folder, "$hexact spectrum --scheme loop --valence 5..7 --matrix -");
  CHECK(r.status == 0);
  const Json document = Json::parse(r.out);
  CHECK(document["matrices"].size() == 3);
  CHECK(document["matrices"][0]["centre"]["self"].is_array());  // depends on cos 2π/5
  CHECK(document["matrices"][1]["centre"]["self"].is_array());  // entries of the matrix stay polynomials
  CHECK(program::run(folder, "$hexact spectrum --valence 5 --matrix - --json").status == 2);
  CHECK(program::run(folder, "$hexact spectrum --valence 5 --matrix - --certificate -").status == 2);
  CHECK(program::run(folder, "$hexact spectrum --valence 5 --matrix no/such/folder.json").status == 3);
  program::write_bytes((folder.path() / "own.json").string(),
                       R"({"hexact": "masks", "version": 1, "name": "own", "masks": [{"valence": 3, "blocks": [[["1/2"]], [["1/4"]], [["1/4"]]]}]})");
  CHECK(program::run(folder, "$hexact spectrum --masks own.json --matrix own_matrix.json").status != 3);
  const Json own = Json::parse(program::read_bytes((folder.path() / "own_matrix.json").string()));
  CHECK(own["scheme"] == "own");
  CHECK(own["matrices"][0]["blocks"] == Json::parse(R"([[["1/2"]], [["1/4"]], [["1/4"]]])"));
}
