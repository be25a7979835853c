// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command.hpp"
#include "hexact/io/mesh_file.hpp"

#include <string>

namespace hexact::app {

/// What the command line of `subdivide` asks for, over all schemes; each scheme reads the options that it has.
struct SubdivideOptions {
  std::string input, output, from, to;
  std::string scheme = "phs";
  unsigned levels = 1;
  std::string parameters = "static";
  std::string arithmetic;  ///< set to the scheme's default before the scheme is called
  int bits = 0;
  std::string certificate;
  std::string limit_points;
  double stop_min_edge = 0;
  double stop_max_panel = 0;
  std::string all_levels;
  std::string color;
  std::string boundary = "dual";
  bool keep_size = false;
  bool limit = false;
  std::string then;   ///< "chamfer:K" or empty
  std::string lifts;  ///< empty: auto
  std::string keep;   ///< empty: 0.5
};

/// The format of an output by `--to`, else by the ending of its path. Throws UsageError.
[[nodiscard]] io::Format output_format(const std::string& path, const std::string& name);
/// The format of a level among `--all-levels`: by the ending of its path, in the encoding of `--to` where that is one of the
/// same format (`ply-ascii` for `.ply`); by `--to` alone where the ending tells nothing. Throws UsageError.
[[nodiscard]] io::Format level_format(const std::string& path, const std::string& name);
/// The path of one level from a pattern with %d or %0Nd. Throws UsageError for other patterns.
[[nodiscard]] std::string level_path(const std::string& pattern, unsigned level);

// One function per family of schemes, each in a source file of its name.
[[nodiscard]] Outcome subdivide_honeycomb(const SubdivideOptions& options, const Common& common);
[[nodiscard]] Outcome subdivide_chamfer(const SubdivideOptions& options, const Common& common);
[[nodiscard]] Outcome subdivide_midedge(const SubdivideOptions& options, const Common& common);

}  // namespace hexact::app
