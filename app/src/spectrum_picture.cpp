// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrum_picture.hpp"

#include "hexact/io/output_file.hpp"
#include "hexact/kernel/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hexact::app {

void write_ring_picture(const std::string& path, const SpectrumSubject& subject, const SpectrumRow& row) {
  RingLines lines;
  if (subject.regular && row.subdominant && row.subdominant->mode == 1) {
    lines = ring_lines(*subject.regular, subject.matrix, row.subdominant->enclosure);
  }
  if (lines.empty()) throw InvalidInput("NoRing", "there is no characteristic ring to draw", "valence " + std::to_string(row.valence));
  double extent = 0;
  for (const auto& line : lines) {
    for (const auto& [x, y] : line) extent = std::max(extent, std::hypot(x, y));
  }
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"800\" height=\"800\" viewBox=\"-1.05 -1.05 2.1 2.1\">\n"
                    "<rect x=\"-1.05\" y=\"-1.05\" width=\"2.1\" height=\"2.1\" fill=\"white\"/>\n"
                    "<g fill=\"none\" stroke=\"#30507c\" stroke-width=\"0.004\">\n";
  for (int s = 0; s < row.valence; ++s) {
    const double angle = 2 * std::numbers::pi * s / row.valence, c = std::cos(angle), d = std::sin(angle);
    for (const auto& line : lines) {
      svg += "<polyline points=\"";
      for (const auto& [x, y] : line) {
        svg += fmt::format("{:.5f},{:.5f} ", (c * x - d * y) / extent, -(d * x + c * y) / extent);
      }
      svg.back() = '"';
      svg += "/>\n";
    }
  }
  io::write_file(path, svg + "</g>\n</svg>\n");
}

}  // namespace hexact::app
