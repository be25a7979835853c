// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command.hpp"

#include "hexact/exact/plane_body.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/progress.hpp"

#include <string>

namespace hexact::app {

/// Where a subcommand writes its result, and as what.
struct OutputChoice {
  std::string path;
  io::Format format = io::Format::planes;
  io::MeshWriteOptions mesh;
};

/// The format by the name given with --to, else by the ending of the path. Throws UsageError when neither tells, for
/// an unknown name, and for --json with standard output as the place of the result.
[[nodiscard]] OutputChoice choose_output(const std::string& path, const std::string& to, const Common& common);
/// What writing did to the numbers.
struct WrittenGeometry {
  bool exact = false;       ///< the file holds the exact result
  double max_rounding = 0;  ///< upper bound of the distance between exact and written vertices
};
/// Writes a body, exactly as `.planes` and with correctly rounded vertices in mesh formats: doubles, or float32 in binary
/// STL and ply-float. Throws FileError, InvalidInput (NotRepresentable), UsageError for certificates.
WrittenGeometry write_geometry(const OutputChoice& output, const PlaneBody& body, const ProgressPart& progress = {});
/// Writes polygons; as `.planes` they must bound a solid of exactly planar facets.
WrittenGeometry write_geometry(const OutputChoice& output, const PolygonSoup<Rational>& soup, const ProgressPart& progress = {});
WrittenGeometry write_geometry(const OutputChoice& output, const PolygonSoup<QuadraticField>& soup,
                               const ProgressPart& progress = {});
/// Writes polygons of doubles as they are, or their nearest float32. Throws also UsageError for `.planes`, ResourceLimit
/// for infinite coordinates.
WrittenGeometry write_geometry(const OutputChoice& output, const PolygonSoup<double>& soup, const ProgressPart& progress = {});

/// The offset n · p of the plane with normal n through p. Throws ResourceLimit where it is beyond the finite doubles.
[[nodiscard]] double finite_product(const Point3<double>& n, const Point3<double>& p);

}  // namespace hexact::app
