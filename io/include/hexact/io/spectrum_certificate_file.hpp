// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/spectrum_certificate.hpp"

#include <string>
#include <string_view>

namespace hexact::io {

/// Whether the bytes begin as a spectral certificate does: "hexact-spectrum".
[[nodiscard]] bool is_spectrum_certificate(std::string_view bytes);

/// Text of a certificate, ending with the line of its digest.
[[nodiscard]] std::string spectrum_certificate_text(const SpectrumCertificate& certificate);

/// Reads the text; `name` stands in messages. Throws ParseError (file, line) for whatever does not follow the format,
/// the digest included. Valences are 3 … 1000.
[[nodiscard]] SpectrumCertificate parse_spectrum_certificate(std::string_view bytes, const std::string& name);

/// Whether the file begins so; false when it cannot be opened.
[[nodiscard]] bool is_spectrum_certificate_file(const std::string& path);
/// Reads a file. Throws FileError, ParseError, ResourceLimit (more than 256 MiB).
[[nodiscard]] SpectrumCertificate read_spectrum_certificate(const std::string& path);

}  // namespace hexact::io
