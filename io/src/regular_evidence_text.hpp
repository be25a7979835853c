// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/regular_smoothness.hpp"
#include "line_scanner.hpp"

#include <string>

namespace hexact::io {

/// The block `regular` of a spectral certificate, described in docs/spectrum.md.
[[nodiscard]] std::string regular_evidence_text(const RegularEvidence& evidence);

/// Reads the block; the word `regular` of its first line has been read. Throws ParseError for what does not follow the
/// format: 64 directions, 64 vertices of 64 entries and words of 4 digits at most.
[[nodiscard]] RegularEvidence read_regular_evidence(LineScanner& scanner);

}  // namespace hexact::io
