// SPDX-License-Identifier: GPL-3.0-or-later
// hexact-check's own readers: any bytes are a certificate of a polyhedron or a mesh, or malformed. Certificates that the
// library reads and whose claims are known are read by both, with as many planes, corners and vertices.
#include "../../app/check/certificate_text.hpp"
#include "../../app/check/rounded_mesh.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

using namespace hexact;

namespace {

bool is_known(const Claim& claim) {
  constexpr std::string_view kPlain[] = {"closed", "planar", "trivalent", "convex", "embedded", "smooth-limit"};
  constexpr std::string_view kAbout[] = {"inside", "tangent", "corner-cut-of"};
  return claim.reference.empty() ? std::find(std::begin(kPlain), std::end(kPlain), claim.name) != std::end(kPlain)
                                 : std::find(std::begin(kAbout), std::end(kAbout), claim.name) != std::end(kAbout);
}

void read_mesh(std::string_view bytes) {
  try {
    (void)check::parse_mesh(bytes, "fuzz");
  } catch (const check::Malformed&) {
  }
}

void read_certificate(const std::string& bytes) {
  std::optional<check::Certificate> by_checker;
  try {
    by_checker = check::parse_certificate(bytes, "fuzz");
  } catch (const check::Malformed&) {
  }
  try {
    const io::Geometry geometry = io::parse_geometry(bytes, io::Format::certificate, "fuzz");
    const auto& certificate = std::get<Certificate>(geometry);
    if (certificate.claims.empty() || !std::all_of(certificate.claims.begin(), certificate.claims.end(), is_known)) return;
    if (!by_checker || by_checker->body.planes.size() != certificate.body.plane_count() ||
        by_checker->body.surface.triple.size() != certificate.body.vertex_count() || by_checker->claims.size() != certificate.claims.size()) {
      std::abort();
    }
  } catch (const Error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.compare(0, 6, "hexact") != 0) {
    read_mesh(bytes);
    return 0;
  }
  const std::string digest = io::sha256_hex(bytes);
  read_certificate(bytes += "sha256 " + digest + "\n");
  return 0;
}
