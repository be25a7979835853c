// SPDX-License-Identifier: GPL-3.0-or-later
// hexact-check against the library and against the definitions, on certificates that were edited.
#include "dice.hpp"
#include "chamfer_samples.hpp"
#include "hexact/exact/certify.hpp"
#include "hexact/exact/honeycomb.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"
#include "program.hpp"
#include "slow_smooth_limit.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <variant>

using namespace hexact;

namespace {

std::vector<Claim> all_claims() {
  return {{"closed", ""}, {"planar", ""}, {"trivalent", ""}, {"convex", ""}, {"inside", "base"}, {"tangent", "base"}, {"corner-cut-of", "base"}};
}

PlaneBody over_sqrt5(PlaneBody b) {
  b.field = Field::sqrt5;
  for (std::size_t i = 0; i < b.planes.size(); ++i) {
    const Plane<Integer> p = b.planes[i];
    b.planes_sqrt5.push_back({Rational(p.a), Rational(p.b), Rational(p.c), Rational(p.d)});
  }
  b.planes = {};
  return b;
}

/// One honeycomb step on a chamfered body, the levels counted on.
PlaneBody honeycomb_behind(const PlaneBody& chamfered, std::uint32_t level) {
  PlaneBody body = samples::honeycomb(chamfered, 1);
  for (std::size_t f = 0; f < body.addresses.size(); ++f) {
    if (f < chamfered.addresses.size()) body.addresses[f] = chamfered.addresses[f];
    else body.addresses[f].level = level;
  }
  return body;
}

/// Chamfers alone, behind honeycombs, before honeycombs, and over the larger field.
std::vector<Certificate> chamfers() {
  auto claims = all_claims();
  claims.push_back({"smooth-limit", ""});
  const PlaneBody cube = samples::cube(), tetrahedron = samples::tetrahedron(), generic = samples::generic_dodecahedron();
  std::vector<Certificate> out;
  out.push_back(make_certificate(samples::chamfer(cube, 1), claims, {{"base", cube}}, {}));
  out.push_back(make_certificate(samples::narrow_budget(tetrahedron, {0}, 9), claims, {{"base", tetrahedron}}, {}));
  out.push_back(make_certificate(samples::chamfer(generic, 1, 1, 44), claims, {{"base", generic}}, {}));
  out.push_back(make_certificate(samples::chamfer(samples::honeycomb(cube, 1), 1, 2), claims, {{"base", cube}}, {}));
  out.push_back(make_certificate(honeycomb_behind(samples::chamfer(tetrahedron, 1), 2), claims, {{"base", tetrahedron}}, {}));
  out.push_back(make_certificate(over_sqrt5(samples::chamfer(tetrahedron, 1)), claims, {{"base", over_sqrt5(tetrahedron)}}, {}));
  return out;
}

/// A generic solid with pentagons, one level with λ₅ = (11 − 3√5)/38.
Certificate pentagons_over_sqrt5() {
  auto level = honeycomb_start<QuadraticField>(over_sqrt5(samples::generic_dodecahedron()));
  const PlaneBody base = to_plane_body(level);
  level = honeycomb_step(level, static_policy_sqrt5()).level;
  return make_certificate(to_plane_body(level), all_claims(), {{"base", base}}, {});
}

std::vector<Certificate> originals() {
  std::vector<Certificate> out;
  for (int k = 1; k <= 2; ++k) {
    out.push_back(make_certificate(samples::honeycomb(samples::cube(), k), all_claims(), {{"base", samples::cube()}}, {}));
  }
  out.push_back(make_certificate(samples::honeycomb(samples::tetrahedron(), 1), all_claims(), {{"base", samples::tetrahedron()}}, {}));
  const PlaneBody generic = samples::generic_dodecahedron();
  out.push_back(make_certificate(samples::honeycomb(generic, 1), all_claims(), {{"base", generic}}, {}));
  out.push_back(pentagons_over_sqrt5());
  // Evidence: a reference whose half-spaces are no facets of the body.
  out.push_back(make_certificate(samples::honeycomb(samples::tetrahedron(), 1), {{"convex", ""}, {"inside", "base"}},
                                 {{"base", samples::cube(2)}}, {}));
  const PlaneBody around = samples::simple_body({{-1, -1, -1, 4}, {-1, 1, 2, 5}, {1, -2, 1, 5}, {3, 1, -1, 6}});
  out.push_back(make_certificate(samples::cube(), {{"inside", "base"}}, {{"base", around}}, {}));
  for (Certificate& c : chamfers()) out.insert(out.end() - 1, std::move(c));
  return out;
}

std::vector<std::vector<VertexId>> lists(const FacetLoops& loops) {
  std::vector<std::vector<VertexId>> out;
  for (std::size_t f = 0; f < loops.size(); ++f) out.emplace_back(loops[f].begin(), loops[f].end());
  return out;
}
FacetLoops loops_of(const std::vector<std::vector<VertexId>>& lists) {
  FacetLoops out;
  for (const auto& loop : lists) out.add(loop);
  return out;
}

template <class S>
S& coefficient(Plane<S>& p, std::size_t k) { return k == 0 ? p.a : k == 1 ? p.b : k == 2 ? p.c : p.d; }

/// Adds 10^place, as a changed digit does, with either sign.
void change_digit(PlaneBody& b, Dice& dice) {
  const std::size_t i = dice.below(b.plane_count()), k = dice.below(4);
  long long by = dice.below(2) == 0 ? 1 : -1;
  for (std::size_t place = dice.below(5); place > 0; --place) by *= 10;
  if (b.field == Field::sqrt5) {
    coefficient(b.planes_sqrt5[i], k) += QuadraticField(by);
    return;
  }
  Plane<Integer> p = b.planes[i];
  coefficient(p, k) += Integer(by);
  b.planes.set(i, p);
}

void swap_planes(PlaneBody& b, Dice& dice) {
  const std::size_t i = dice.below(b.plane_count()), j = dice.below(b.plane_count());
  if (b.field == Field::sqrt5) return std::swap(b.planes_sqrt5[i], b.planes_sqrt5[j]);
  const Plane<Integer> p = b.planes[i], q = b.planes[j];
  b.planes.set(i, q);
  b.planes.set(j, p);
}

/// Two facets change places with all that belongs to them: the same solid in another order.
void swap_facets(PlaneBody& b, Dice& dice) {
  const std::size_t i = dice.below(b.plane_count()), j = dice.below(b.plane_count());
  if (b.field == Field::sqrt5) {
    std::swap(b.planes_sqrt5[i], b.planes_sqrt5[j]);
  } else {
    const Plane<Integer> p = b.planes[i], q = b.planes[j];
    b.planes.set(i, q);
    b.planes.set(j, p);
  }
  auto loops = lists(b.loops);
  std::swap(loops[i], loops[j]);
  b.loops = loops_of(loops);
  if (dice.below(2) == 0) std::swap(b.addresses[i], b.addresses[j]);
  for (auto& t : b.triples) {
    for (FacetId& f : t) f = index(f) == i ? make_id<FacetId>(j) : index(f) == j ? make_id<FacetId>(i) : f;
  }
}

void change_loops(PlaneBody& b, Dice& dice, std::size_t kind) {
  auto loops = lists(b.loops);
  auto &loop = loops[dice.below(loops.size())], &other = loops[dice.below(loops.size())];
  const std::size_t i = dice.below(loop.size()), j = dice.below(loop.size());
  if (kind == 0) loop.clear();
  else if (kind == 1) loop[i] = make_id<VertexId>(dice.below(b.vertex_count()));
  else if (kind == 2) std::swap(loop[i], loop[j]);
  else if (kind == 3) std::swap(loop, other);
  else if (kind == 4) std::reverse(loop.begin(), loop.end());
  else if (kind == 5) std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(i), loop.end());
  else loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
  b.loops = loops_of(loops);
}

/// One edit. Every index stays in range, so that the file can be read and the claims have to be decided.
void edit(Certificate& c, Dice& dice) {
  PlaneBody& b = c.body;
  const std::size_t f = dice.below(b.plane_count()), v = dice.below(b.vertex_count()), kind = dice.below(20);
  if (kind < 4) change_digit(b, dice);
  else if (kind == 4) swap_planes(b, dice);
  else if (kind < 12) change_loops(b, dice, kind - 5);
  else if (kind == 12) b.addresses[f].level += dice.below(2) == 0 || b.addresses[f].level == 0 ? 1 : -1;
  else if (kind == 13) b.addresses[f].parent = make_id<VertexId>(dice.below(b.vertex_count()));
  else if (kind == 14) b.triples[v][dice.below(3)] = make_id<FacetId>(f);
  else if (kind == 15) std::swap(b.triples[v], b.triples[dice.below(b.vertex_count())]);
  else if (kind == 16 && !c.supports.empty()) c.supports[dice.below(c.supports.size())].vertex = make_id<VertexId>(v);
  else if (kind == 17 && !c.supports.empty()) c.supports.erase(c.supports.begin());
  else if (kind == 18) swap_facets(b, dice);
  else change_digit(c.bodies.front().body, dice);
}

std::vector<bool> by_library(const Certificate& c) {
  std::vector<bool> out;
  for (const ClaimVerdict& v : verify(c)) out.push_back(v.verdict == Verdict::proved);
  return out;
}
std::vector<bool> by_definition(const Certificate& c) {
  return c.body.field == Field::rational ? slow::decide<Rational>(c) : slow::decide<QuadraticField>(c);
}
std::vector<bool> by_program(const program::Run& run, const Certificate& c) {
  const auto report = nlohmann::json::parse(run.out);
  std::vector<bool> out;
  for (const Claim& claim : c.claims) out.push_back(report["claims"][claim_text(claim)] == "proved");
  return out;
}
int exit_status(const Certificate& c) {
  const Verdict v = overall(verify(c));
  return v == Verdict::proved ? 0 : v == Verdict::refuted ? 1 : 5;
}
bool all_true(const std::vector<bool>& list) { return std::find(list.begin(), list.end(), false) == list.end(); }

/// The certificate in `text`, or nothing when it is malformed.
std::optional<Certificate> parsed(const std::string& text) {
  try {
    return std::get<Certificate>(io::parse_geometry(text, io::Format::certificate, "edited"));
  } catch (const ParseError&) {
    return std::nullopt;
  }
}

}  // namespace

TEST_CASE("edited certificates: program, library and definitions give the same verdict on every claim", "[hexact-check]") {
  const program::Folder folder;
  const std::string path = (folder.path() / "c.cert").string();
  const std::vector<Certificate> certificates = originals();
  std::size_t proved = 0;
  for (const Certificate& c : certificates) {
    io::write_certificate(path, c);
    const bool is_proved = all_true(by_definition(c));
    CHECK(program::run(folder, "\"$check\" c.cert").status == (is_proved ? 0 : 5));
    CHECK(is_proved == (overall(verify(c)) == Verdict::proved));
    proved += is_proved ? 1 : 0;
  }
  CHECK(proved == certificates.size() - 2);  // smooth-limit of the chamfer with a honeycomb behind it, and over Q(√5)
  std::size_t rejected = 0;
  for (std::uint64_t seed = 1; seed <= 1700; ++seed) {
    Dice dice(seed);
    Certificate edited = certificates[seed % certificates.size()];
    edit(edited, dice);
    const std::string text = io::certificate_text(edited);
    program::write_bytes(path, text);
    const program::Run run = program::run(folder, "\"$check\" --json c.cert");
    const std::optional<Certificate> read = parsed(text);
    CAPTURE(seed, run.out, run.err);
    REQUIRE(run.status == (read ? exit_status(*read) : 3));
    if (run.status != 0) ++rejected;
    if (!read) continue;
    const std::vector<bool> expected = by_definition(*read);
    REQUIRE(by_library(*read) == expected);
    REQUIRE(by_program(run, *read) == expected);
  }
  CHECK(rejected >= 1200);
}

TEST_CASE("a certificate with one changed byte is rejected", "[hexact-check]") {
  const program::Folder folder;
  const std::string path = (folder.path() / "c.cert").string();
  const std::string good = io::certificate_text(originals().front());
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = bad[i] == '1' ? '2' : '1';
    CHECK_FALSE(parsed(bad));
    if (i % 9 != 0) continue;
    program::write_bytes(path, bad);
    CHECK(program::run(folder, "\"$check\" c.cert").status == 3);
  }
  program::write_bytes(path, good.substr(0, good.size() / 2));
  CHECK(program::run(folder, "\"$check\" c.cert").status == 3);
}

TEST_CASE("both programs take the same characters for blanks, and leading zeros for nothing", "[hexact-check]") {
  const program::Folder folder;
  const std::string path = (folder.path() / "c.cert").string(), good = io::certificate_text(make_certificate(samples::cube(), {{"convex", ""}}, {}, {}));
  const auto proves = [&](std::string text) {
    text.erase(text.rfind("sha256 "));
    text += "sha256 " + io::sha256_hex(text) + "\n";
    program::write_bytes(path, text);
    const int checker = program::run(folder, "\"$check\" c.cert").status, library = program::run(folder, "\"$hexact\" check c.cert").status;
    CHECK(checker == library);
    return checker == 0;
  };
  const std::size_t blank = good.find(' ', good.find("\nplanes ") + 8), line = good.find('\n', good.find("\nplanes ") + 1);
  REQUIRE(blank != std::string::npos);
  CHECK(proves(good));
  CHECK(proves("\xef\xbb\xbf" + good));
  for (const char* other : {"\t", "\f", "\v", " \v\f ", "\r"}) CHECK(proves(std::string(good).replace(blank, 1, other)));
  // 8/10 of the first plane, with leading zeros: neither octal nor an error.
  const std::string plane = good.substr(line + 1, good.find('\n', line + 1) - line - 1);
  std::string scaled;
  std::istringstream numbers(plane);
  for (long n = 0; numbers >> n;) {
    scaled += (n < 0 ? "-00" : "00") + std::to_string(8 * std::labs(n)) + "/010 ";
    if (std::count(scaled.begin(), scaled.end(), ' ') == 4) break;
  }
  CHECK(proves(std::string(good).replace(line + 1, plane.size(), scaled + "0 -")));
}

TEST_CASE("the line of the digest is the last one, for both programs", "[hexact-check]") {
  const program::Folder folder;
  const std::string path = (folder.path() / "c.cert").string(), good = io::certificate_text(make_certificate(samples::cube(), {{"convex", ""}}, {}, {}));
  const std::string before = good.substr(0, good.rfind("sha256 ")), digest = io::sha256_hex(before);
  const auto status = [&](const std::string& last) {
    program::write_bytes(path, before + last);
    const int checker = program::run(folder, "\"$check\" c.cert").status;
    CHECK(checker == program::run(folder, "\"$hexact\" check c.cert").status);
    return checker;
  };
  for (const char* blank : {" ", "\t ", "\f"}) {
    CHECK(status("sha256" + std::string(blank) + digest + "\n") == 0);
    CHECK(status(blank + ("sha256 " + digest) + blank) == 0);
  }
  for (const char* tail : {"\n\n", "\n ", "\n# no more\n", " more\n", "\nclaim closed\n"}) CHECK(status("sha256 " + digest + tail) == 3);
  CHECK(status("sha256\n" + digest + "\n") == 3);
  CHECK(status("sha256 " + digest.substr(1) + "\n") == 3);
  CHECK(status("sha256 \n") == 3);
  CHECK(status("") == 3);
}

TEST_CASE("a coordinate changed by one ulp is rejected by both programs", "[hexact-check]") {
  const program::Folder folder;
  const std::string cert = (folder.path() / "c.cert").string(), obj = (folder.path() / "m.obj").string();
  Dice dice(7);
  for (const Certificate& c : {originals()[0], originals()[4]}) {
    io::write_certificate(cert, c);
    const RoundedVertices rounded = rounded_vertices(c.body);
    const auto write = [&](const std::vector<Point3<double>>& points) { io::write_mesh(obj, io::Format::obj, {points, c.body.loops, {}}); };
    write(rounded.points);
    CHECK(program::run(folder, "\"$check\" c.cert m.obj").status == 0);
    CHECK(program::run(folder, "\"$hexact\" check c.cert m.obj").status == 0);
    for (std::size_t v = 0; v < rounded.points.size(); ++v) {
      for (const auto axis : {&Point3<double>::x, &Point3<double>::y, &Point3<double>::z}) {
        std::vector<Point3<double>> points = rounded.points;
        const double to = dice.below(2) == 0 ? -1 : 1;
        points[v].*axis = std::nextafter(points[v].*axis, to * std::numeric_limits<double>::infinity());
        write(points);
        CHECK(program::run(folder, "\"$check\" c.cert m.obj").status == 1);
        if (v % 8 == 0) CHECK(program::run(folder, "\"$hexact\" check c.cert m.obj").status == 1);
      }
    }
  }
}

TEST_CASE("hexact-check says what is wrong with a file, and where", "[hexact-check]") {
  const program::Folder folder;
  const std::string path = (folder.path() / "c.cert").string();
  Certificate c = originals().back();
  const auto status_of = [&](const Certificate& certificate) {
    io::write_certificate(path, certificate);
    CHECK_FALSE(parsed(program::read_bytes(path)));
    return program::run(folder, "\"$check\" c.cert").status;
  };
  REQUIRE_FALSE(c.supports.empty());
  Certificate wrong = c;
  wrong.supports[0].plane = 1000;
  CHECK(status_of(wrong) == 3);
  wrong = c;
  wrong.supports[0].vertex = make_id<VertexId>(1000);
  CHECK(status_of(wrong) == 3);
  CHECK(program::run(folder, "\"$check\" nothing.cert").status == 3);
  CHECK(program::run(folder, "\"$check\" .").status == 3);
  CHECK(program::run(folder, "\"$check\"").status == 2);
  CHECK(program::run(folder, "\"$check\" --nonsense c.cert").status == 2);
  program::write_bytes(path, "hexact-certificate 1\nfield Q\nscale 0\nplanes 1\n0 0 x 1 0 -\n");
  const program::Run run = program::run(folder, "\"$check\" --json c.cert");
  CHECK(run.status == 3);
  CHECK(nlohmann::json::parse(run.out)["error"]["line"] == 5);
}
