// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are a spectral certificate or one of our errors, in both readers. What the library accepts can be written
// and reads back as the same, and hexact-check reads the same numbers.
#include "../../app/check/certificate_text.hpp"
#include "../../app/check/spectrum.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/io/spectrum_certificate_file.hpp"
#include "hexact/kernel/errors.hpp"

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

using namespace hexact;

namespace {

void require(bool same) {
  if (!same) std::abort();
}

void require_same(const Rational& a, const mpq_class& b) { require(a.str() == b.get_str()); }

void require_same(const ModeSpectrum& a, const check::ListedMode& b) {
  require(a.isolated.size() == b.values.size() && a.remaining == b.rest);
  for (std::size_t i = 0; i < b.values.size(); ++i) {
    require_same(a.isolated[i].enclosure.lo, b.values[i].lo);
    require_same(a.isolated[i].enclosure.hi, b.values[i].hi);
    require(a.isolated[i].multiplicity == b.values[i].multiplicity);
  }
  require_same(a.remaining_bound, b.radius);
}

void require_same(const SpectrumCertificate::Row& a, const check::ListedRow& b) {
  require(a.valence == b.k && a.modes.size() == b.modes.size() && a.mask.has_value() == b.mask.has_value() && a.ring.has_value() == b.ring.has_value());
  require_same(a.cosine.lo, b.cosine_lo);
  require_same(a.cosine.hi, b.cosine_hi);
  for (std::size_t m = 0; m < b.modes.size(); ++m) require_same(a.modes[m], b.modes[m]);
  if (a.mask) {
    require(a.mask->weights.size() == b.mask->weights.size() && a.mask->blocks.size() == b.mask->blocks.size());
    for (std::size_t i = 0; i < b.mask->weights.size(); ++i) require_same(a.mask->weights[i], b.mask->weights[i]);
    for (std::size_t d = 0; d < b.mask->blocks.size(); ++d) {
      require(a.mask->blocks[d].size() == b.mask->blocks[d].size());
      for (std::size_t i = 0; i < b.mask->blocks[d].size(); ++i) require_same(a.mask->blocks[d][i], b.mask->blocks[d][i]);
    }
  }
  if (a.ring) {
    require(a.ring->level == b.ring->level);
    require_same(a.ring->jacobian, b.ring->jacobian);
    require_same(a.ring->half_plane, b.ring->half_plane);
  }
}

void require_same(const MassGrowth& a, const check::RegularBlock& b) {
  require_same(a.bounds.lo, b.low);
  require_same(a.bounds.hi, b.high);
  require(a.word == b.word && a.vertices.size() == b.vertices.size() && a.images.size() == b.images.size());
  for (std::size_t v = 0; v < b.vertices.size(); ++v) {
    require(static_cast<int>(a.vertices[v].parent) == b.vertices[v].parent && a.vertices[v].digit == b.vertices[v].digit);
    require(a.vertices[v].entries.size() == b.vertices[v].entries.size());
    for (std::size_t i = 0; i < b.vertices[v].entries.size(); ++i) require(a.vertices[v].entries[i].str() == b.vertices[v].entries[i].get_str());
  }
  for (std::size_t i = 0; i < b.images.size(); ++i) {
    const auto& x = a.images[i];
    const auto& y = b.images[i];
    require(static_cast<int>(x.vertex) == y.vertex && x.digit == y.digit && x.combination.size() == y.weights.size());
    for (std::size_t j = 0; j < y.weights.size(); ++j) {
      require(static_cast<int>(x.combination[j].first) == y.weights[j].first);
      require_same(x.combination[j].second, y.weights[j].second);
    }
  }
}

void require_same(const RegularEvidence& a, const check::RegularBlock& b) {
  require(a.continuity == b.continuity && a.directions.size() == b.directions.size() && a.link.size() == b.link.size());
  require(a.growth.has_value() == !b.link.empty());
  for (std::size_t i = 0; i < b.directions.size(); ++i) require(a.directions[i][0] == b.directions[i].first && a.directions[i][1] == b.directions[i].second);
  for (std::size_t i = 0; i < b.link.size(); ++i) require_same(a.link[i], b.link[i]);
  if (a.growth) require_same(*a.growth, b);
}

void require_same(const SpectrumCertificate& a, const check::SpectrumFile& b) {
  require(a.claims.size() == b.claims.size() && a.rows.size() == b.rows.size() && a.scheme.has_value() == (b.scheme != check::Scheme::blocks));
  for (std::size_t i = 0; i < b.claims.size(); ++i) {
    const std::size_t row = b.claims[i].row;
    require(text_of(a.claims[i]) == b.claims[i].text && a.claims[i].valence == (row < b.rows.size() ? b.rows[row].k : 0));
  }
  for (std::size_t i = 0; i < b.rows.size(); ++i) require_same(a.rows[i], b.rows[i]);
  require(a.regular.has_value() == b.regular.has_value());
  if (a.regular) require_same(*a.regular, *b.regular);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  // Without its digest nothing behind the reader's first lines would ever be reached.
  const std::string digest = io::sha256_hex(bytes);
  bytes += "sha256 " + digest + "\n";
  if (!io::is_spectrum_certificate(bytes)) return 0;  // neither program takes it for one
  std::optional<check::SpectrumFile> by_checker;
  try {
    by_checker = check::parse_spectrum(bytes, "fuzz");
  } catch (const check::Malformed&) {
  }
  try {
    const SpectrumCertificate certificate = io::parse_spectrum_certificate(bytes, "fuzz");
    const std::string text = io::spectrum_certificate_text(certificate);
    require(io::spectrum_certificate_text(io::parse_spectrum_certificate(text, "fuzz")) == text);
    require(by_checker.has_value());
    require_same(certificate, *by_checker);
  } catch (const ParseError&) {
    require(!by_checker.has_value());
  } catch (const Error&) {
  }
  return 0;
}
