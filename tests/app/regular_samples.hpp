// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/regular_smoothness.hpp"
#include "hexact/exact/spectrum_certificate.hpp"
#include "hexact/io/spectrum_certificate_file.hpp"

#include <string>

namespace hexact::spectrum_test {

/// The certificate that states the smoothness of a scheme's regular regions and nothing else.
inline std::string regular_certificate(SpectrumScheme scheme) {
  SpectrumCertificate certificate;
  certificate.scheme = scheme;
  certificate.claims.push_back({SpectrumClaimKind::regular, 0});
  certificate.regular = regular_smoothness(scheme).evidence;
  return io::spectrum_certificate_text(certificate);
}

}  // namespace hexact::spectrum_test
