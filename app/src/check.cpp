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

Outcome check(const CheckOptions& options, const Common& common) {
  if (io::is_spectrum_certificate_file(options.certificate)) {
    if (!options.mesh.empty()) throw UsageError("a spectral certificate has no mesh to compare");
    const SpectrumCertificate certificate = io::read_spectrum_certificate(options.certificate);
    if (certificate.claims.empty()) throw InvalidInput("NoClaims", options.certificate + " states no claims", "");
    return claim_outcome(verify(certificate));
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
