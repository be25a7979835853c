// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/spectrum.hpp"

#include <string>
#include <vector>

namespace hexact::app {

/// Writes the exact matrices and their characteristic polynomials: a document `subdivision-matrix`.
void write_subdivision_matrices(const std::string& path, const std::string& scheme, const std::vector<SpectrumSubject>& subjects);

}  // namespace hexact::app
