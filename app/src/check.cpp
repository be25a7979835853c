// SPDX-License-Identifier: GPL-3.0-or-later
#include "claim_report.hpp"
#include "command.hpp"
#include "hexact/exact/mesh_difference.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/io/spectrum_certificate_file.hpp"
#include "hexact/kernel/errors.hpp"

#include <memory>
#include <variant>

namespace hexact::app {
namespace {

struct CheckOptions {
  std::string certificate, mesh;
};

nlohmann::ordered_json texts(const std::vector<Rational>& numbers) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Rational& x : numbers) out.push_back(x.str());
  return out;
}

/// The report says what the claims are about, as a file does not vouch for the masks that its user has in mind.
Outcome check_spectrum(const std::string& path) {
  const SpectrumCertificate certificate = io::read_spectrum_certificate(path);
  if (certificate.claims.empty()) throw InvalidInput("NoClaims", path + " states no claims", "");
  Outcome outcome = claim_outcome(verify(certificate));
  const std::string scheme = certificate.scheme ? name_of(*certificate.scheme) : "blocks";
  nlohmann::ordered_json masks = nlohmann::ordered_json::object();
  std::string text = "scheme: " + scheme + "\n";
  for (const SpectrumCertificate::Row& row : certificate.rows) {
    if (!row.mask) continue;
    const std::string k = std::to_string(row.valence);
    text += "mask " + k + ":";
    for (const Rational& w : row.mask->weights) text += " " + w.str();
    if (!row.mask->blocks.empty()) text += " blocks, see --json";
    text += "\n";
    masks[k] = texts(row.mask->weights);
    for (const auto& block : row.mask->blocks) masks[k].push_back(texts(block));
  }
  outcome.report["scheme"] = scheme;
  if (!masks.empty()) outcome.report["masks"] = std::move(masks);
  outcome.text = text + outcome.text;
  return outcome;
}

Outcome check(const CheckOptions& options, const Common& common) {
  if (io::is_spectrum_certificate_file(options.certificate)) {
    if (!options.mesh.empty()) throw UsageError("a spectral certificate has no mesh to compare");
    return check_spectrum(options.certificate);
  }
  const io::Geometry geometry = io::read_geometry(options.certificate);
  const auto* certificate = std::get_if<Certificate>(&geometry);
  if (certificate == nullptr || certificate->claims.empty()) {
    throw InvalidInput("NoClaims", options.certificate + " has no claims; hexact certify proves some and writes them", "");
  }
  std::vector<ClaimVerdict> verdicts = verify(*certificate, common.work.part(0.2, 0.8));
  if (!options.mesh.empty()) {
    const io::Geometry mesh = io::read_geometry(options.mesh);
    const auto* soup = std::get_if<PolygonSoup<Rational>>(&mesh);
    if (soup == nullptr) throw InvalidInput("NotAMesh", options.mesh + " is no mesh of rounded coordinates", "");
    const std::string difference = mesh_difference(certificate->body, *soup);
    verdicts.push_back({"mesh", difference.empty() ? Verdict::proved : Verdict::refuted, difference});
  }
  return claim_outcome(verdicts);
}

}  // namespace

void add_check(const Registry& registry) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = registry.add("check", "Verify a certificate again, and that a mesh is its correct rounding");
  command->add_option("certificate", options->certificate, "Certificate")->required();
  command->add_option("mesh", options->mesh, "Mesh whose every coordinate must be the nearest double, or float32 in binary STL and PLY float");
  command->callback([registry, options] {
    registry.selected = [options, &common = registry.common] { return check(*options, common); };
  });
}

}  // namespace hexact::app
