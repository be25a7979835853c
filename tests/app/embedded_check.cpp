// SPDX-License-Identifier: GPL-3.0-or-later
// The claim embedded by the library and by hexact-check, which decide it by different methods.
#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/certify.hpp"
#include "hexact/exact/sample_solids.hpp"
#include "hexact/io/mesh_file.hpp"
#include "program.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace hexact;

namespace {

PlaneBody sample(const char* name) {
  return std::visit([](const auto& soup) { return body_from_soup(soup, SoupRule::planar); }, sample_solid(name));
}

/// Planes moved, loops turned or exchanged: most results cross themselves, some do not.
void edit(PlaneBody& b, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return random() % n; };
  const std::size_t kind = below(5), i = below(b.plane_count());
  if (kind < 3) {
    const auto by = static_cast<long long>(below(9)) - 4;
    if (b.field == Field::sqrt5) {
      b.planes_sqrt5[i].d += QuadraticField(by);
    } else {
      Plane<Integer> p = b.planes[i];
      (kind == 0 ? p.a : p.d) += Integer(by);
      b.planes.set(i, p);
    }
    return;
  }
  FacetLoops loops;
  for (std::size_t f = 0; f < b.loops.size(); ++f) {
    std::vector<VertexId> loop(b.loops[f].begin(), b.loops[f].end());
    if (f == i && kind == 3) loop.clear();
    if (f == i && kind == 4 && !loop.empty()) std::swap(loop[below(loop.size())], loop[below(loop.size())]);
    loops.add(loop);
  }
  b.loops = loops;
}

}  // namespace

TEST_CASE("edited bodies: library and hexact-check agree on embedded", "[hexact-check][embedded]") {
  const program::Folder folder;
  const std::string path = (folder.path() / "c.cert").string();
  const std::vector<PlaneBody> bodies{sample("l-prism"), sample("frame"), sample("star-prism"), planar_saddle(), samples::honeycomb(samples::cube(), 1),
                                      sample("dodecahedron")};
  std::mt19937 random(4);
  std::size_t proved = 0, refuted = 0;
  for (std::size_t trial = 0; trial < 240; ++trial) {
    PlaneBody body = bodies[trial % bodies.size()];
    if (trial >= bodies.size()) edit(body, random);
    const Certificate certificate = make_certificate(body, {{"embedded", ""}}, {}, {});
    io::write_certificate(path, certificate);
    const Verdict verdict = verify(certificate).front().verdict;
    const program::Run run = program::run(folder, "\"$check\" c.cert");
    CAPTURE(trial, run.out, run.err, verify(certificate).front().witness);
    if (run.status == 3) continue;  // a normal of 0, a loop of two: malformed
    REQUIRE(run.status == (verdict == Verdict::proved ? 0 : 1));
    (verdict == Verdict::proved ? proved : refuted) += 1;
    if (trial < bodies.size()) CHECK(verdict == Verdict::proved);
  }
  CHECK(proved >= 40);
  CHECK(refuted >= 60);
}

TEST_CASE("make, certify and check a solid that is not convex", "[app][embedded]") {
  const program::Folder folder;
  CHECK(program::run(folder, "\"$hexact\" make frame -o frame.planes").status == 0);
  CHECK(program::run(folder, "\"$hexact\" certify frame.planes --prove closed,planar,trivalent,embedded -o frame.cert").status == 0);
  CHECK(program::run(folder, "\"$check\" frame.cert").status == 0);
  CHECK(program::run(folder, "\"$hexact\" check frame.cert").status == 0);
  CHECK(program::run(folder, "\"$hexact\" certify frame.planes --prove convex").status == 1);
  CHECK(program::run(folder, "\"$hexact\" make planar-saddle -o saddle.planes").status == 0);
  CHECK(program::run(folder, "\"$hexact\" certify saddle.planes --prove planar,embedded -o saddle.cert").status == 0);
  CHECK(program::run(folder, "\"$check\" saddle.cert").status == 0);
  CHECK(program::run(folder, "\"$hexact\" certify saddle.planes --prove closed").status == 1);
}

TEST_CASE("subdivide --scheme chamfer on surfaces that are not convex", "[app][embedded]") {
  const program::Folder folder;
  for (const std::string name : {"l-prism", "frame", "planar-saddle"}) {
    CHECK(program::run(folder, "\"$hexact\" make " + name + " -o in.planes").status == 0);
    const program::Run run = program::run(folder, "\"$hexact\" subdivide in.planes --scheme chamfer --levels 2 -o out.planes --certificate out.cert --json");
    CAPTURE(name, run.out, run.err);
    REQUIRE(run.status == 0);
    CHECK(run.out.find("\"concave_edges\"") != std::string::npos);
    CHECK(program::run(folder, "\"$check\" out.cert").status == 0);
    CHECK(program::run(folder, "\"$hexact\" certify out.planes --prove planar,embedded").status == 0);
  }
  CHECK(program::run(folder, "\"$hexact\" make octahedron -o octahedron.planes").status == 0);
  const program::Run refused = program::run(folder, "\"$hexact\" subdivide octahedron.planes --scheme chamfer -o out.planes");
  CHECK(refused.status == 3);
  CHECK(refused.err.find("vertex 0") != std::string::npos);
  CHECK(program::run(folder, "\"$hexact\" subdivide in.planes --scheme chamfer --keep 0.5 -o out.planes").status == 2);
}
