// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates are read by lines, and a comment is a whole line: both programs agree on what that makes malformed.
#include "hexact/exact/certify.hpp"
#include "layout_edits.hpp"
#include "regular_samples.hpp"
#include "solid_samples.hpp"
#include "spectrum_samples.hpp"

#include <catch2/catch.hpp>

using namespace hexact;
using namespace hexact::spectrum_test;

namespace {

/// Of a polyhedron.
int status_by_library(const std::string& text) {
  try {
    return overall(verify(std::get<Certificate>(io::parse_geometry(text, io::Format::certificate, "test")))) == Verdict::proved ? 0 : 1;
  } catch (const ParseError&) {
    return 3;
  }
}

}  // namespace

TEST_CASE("lines of spectral certificates: both programs agree on which are malformed", "[certificate][layout]") {
  const program::Folder folder;
  Dice samples(6);
  for (const std::string& text : {text_of_masks(random_blocks(3, 2, samples)), text_of_masks(complex_centre(5)), text_of_scheme(SpectrumScheme::loop, {3}),
                                  regular_certificate(SpectrumScheme::midedge6)}) {
    for (const layout_edits::Edit& edit : layout_edits::of(text)) {
      const std::string edited = with_digest(edit.text);
      INFO(edit.what);
      CHECK(by_library(edited).status == (edit.is_harmless ? 0 : 3));
      CHECK(by_checker(folder, edited).status == (edit.is_harmless ? 0 : 3));
    }
  }
}

TEST_CASE("lines of certificates of polyhedra: both programs agree on which are malformed", "[certificate][layout]") {
  const program::Folder folder;
  const PlaneBody cube = samples::cube();
  const std::vector<Claim> claims{{"convex", ""}, {"inside", "base"}};
  // With a section `vertices`, and with supports.
  PlaneBody shifted = cube;
  shifted.shift = {fraction(1, 2), Rational(0), Rational(-3)};
  for (const Certificate& c : {make_certificate(shifted, {{"convex", ""}}, {}, {"test"}), make_certificate(cube, claims, {{"base", samples::cube(2)}}, {"test"})}) {
    const std::string text = io::certificate_text(c);
    for (const layout_edits::Edit& edit : layout_edits::of(text)) {
      const std::string edited = with_digest(edit.text);
      INFO(edit.what << "\n" << edited);
      CHECK(status_by_library(edited) == (edit.is_harmless ? 0 : 3));
      CHECK(by_checker(folder, edited).status == (edit.is_harmless ? 0 : 3));
    }
  }
  // Sections have one order, and none stands twice.
  const std::string text = io::certificate_text(make_certificate(shifted, {{"convex", ""}}, {}, {}));
  for (const char* section : {"field ", "scale ", "shift "}) {
    const std::size_t at = text.find(section), end = text.find('\n', at) + 1;
    REQUIRE(at != std::string::npos);
    const std::string line = text.substr(at, end - at);
    for (const std::string& edited : {with_digest(std::string(text).insert(end, line)), with_digest(std::string(text).erase(at, line.size())),
                                      with_digest(std::string(text).erase(at, line.size()).insert(text.find('\n') + 1, line))}) {
      INFO(edited);
      CHECK(by_checker(folder, edited).status == status_by_library(edited));
    }
  }
}
