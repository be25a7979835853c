// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/spectrum.hpp"

#include <string>

namespace hexact::app {

/// Writes an SVG drawing of all sectors of the ring. Throws InvalidInput (NoRing) when the row has none.
void write_ring_picture(const std::string& path, const SpectrumSubject& subject, const SpectrumRow& row);

}  // namespace hexact::app
