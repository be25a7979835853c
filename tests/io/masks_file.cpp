// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/io/masks_file.hpp"

#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

namespace hexact {
namespace {

SpectrumRow row_of(const std::string& json) {
  const MasksDocument document = io::parse_masks(json, "test");
  return spectrum_row(mask_subject(document, document.masks.at(0)));
}

std::string element_of(const std::string& json) {
  try {
    (void)row_of(json);
  } catch (const ParseError& e) {
    return e.element();
  } catch (const InvalidInput& e) {
    return e.findings().front().element;
  }
  return "accepted";
}

std::string document(const std::string& rest) { return R"({"hexact": "masks", "version": 1, )" + rest + "}"; }

}  // namespace

TEST_CASE("masks that spell a known scheme have its spectrum and its ring", "[spectrum][masks]") {
  // Catmull and Clark's vertex rule at valence 5: 1 − 7/20, 3/50, 1/100.
  const SpectrumRow own = row_of(document(R"("scheme": "catmull-clark", "masks": [{"valence": 5, "weights": [0.65, "3/50", 0.01]}])"));
  const SpectrumRow known = spectrum_row(scheme_subject(SpectrumScheme::catmull_clark, 5));
  CHECK(overall(own) == Verdict::proved);
  CHECK(own.subdominant->enclosure == known.subdominant->enclosure);
  CHECK(own.ring.jacobian == known.ring.jacobian);
  // Doo and Sabin's k-gon at 4 and 6, where its weights are rational.
  for (const auto& [k, weights] : {std::pair{4, R"(["9/16", "3/16", "1/16", "3/16"])"}, {6, R"(["11/24", "1/6", "1/12", "1/24", "1/12", "1/6"])"}}) {
    const SpectrumRow face = row_of(document(R"("scheme": "doo-sabin", "masks": [{"valence": )" + std::to_string(k) + R"(, "weights": )" + weights + "}]"));
    CHECK(overall(face) == Verdict::proved);
    CHECK(face.subdominant->enclosure.lo == Rational(1) / Rational(2));
  }
}

TEST_CASE("masks whose second eigenvalue is simple, of mode 0 or of mode 2, are told so", "[spectrum][masks]") {
  // Loop's ring with a heavy centre: mode 0 has 5/8 − a with a small.
  const SpectrumRow heavy = row_of(document(R"("scheme": "loop", "masks": [{"valence": 5, "weights": [0.95, 0.01]}])"));
  CHECK(heavy.ordering == Verdict::refuted);
  CHECK(heavy.ordering_witness.find("multiplicity 1") != std::string::npos);
  CHECK(heavy.c1 == Verdict::undecided);
  // A pentagon with 1/5 + (2/5)(b cos(2πd/5) + …) can be given the second eigenvalue in mode 2.
  const SpectrumRow twice = row_of(document(R"("scheme": "doo-sabin", "masks": [{"valence": 5, "weights": ["2/5", "1/20", "1/4", "1/4", "1/20"]}])"));
  CHECK(twice.ordering == Verdict::proved);
  CHECK(twice.subdominant->mode == 2);
  CHECK(twice.ring.verdict == Verdict::refuted);
  CHECK(twice.c1 == Verdict::refuted);
  CHECK(overall(twice) == Verdict::refuted);
}

TEST_CASE("blocks: the spectrum is decided, the ring is not known", "[spectrum][masks]") {
  const SpectrumRow row = row_of(document(R"("name": "halves", "masks": [{"valence": 3, "blocks": [[["1/2"]], [[0.25]], [[0.25]]]}])"));
  CHECK(row.modes[0].isolated[0].enclosure.lo == Rational(1));
  CHECK(row.ordering == Verdict::proved);  // 1, 1/4, 1/4
  CHECK(row.subdominant->enclosure.lo == Rational(1) / Rational(4));
  CHECK(row.ring.verdict == Verdict::undecided);
  CHECK(row.c1 == Verdict::undecided);
}

TEST_CASE("documents of masks that are wrong are refused at their place", "[spectrum][masks]") {
  CHECK(element_of(R"({"hexact": "masks", "version": 2, "masks": []})") != "accepted");
  CHECK(element_of(R"({"hexact": "curves", "version": 1})") != "accepted");
  CHECK(element_of(document(R"("masks": [])")) == "/masks");
  CHECK(element_of(document(R"("mask": [])")) == "/mask");
  CHECK(element_of(document(R"("scheme": "midedge6", "masks": [])")) == "/scheme");
  CHECK(element_of(document(R"("scheme": "loop", "masks": [{"valence": 2, "weights": [1, 0]}])")) == "/masks/0/valence");
  CHECK(element_of(document(R"("scheme": "loop", "masks": [{"valence": 5, "weights": [1, 0], "colour": 3}])")) == "/masks/0/colour");
  CHECK(element_of(document(R"("scheme": "loop", "masks": [{"valence": 5, "weights": ["a", 0]}])")) == "/masks/0/weights/0");
  CHECK(element_of(document(R"("scheme": "loop", "masks": [{"valence": 5, "blocks": []}])")) == "/masks/0/blocks");
  CHECK(element_of(document(R"("scheme": "loop", "masks": [{"valence": 5, "weights": [1, 0, 0]}])")) == "valence 5");
  CHECK(element_of(document(R"("scheme": "doo-sabin", "masks": [{"valence": 3, "weights": [0.5, 0.25, 0.2]}])")) == "valence 3");
  CHECK(element_of(document(R"("masks": [{"valence": 3, "blocks": [[[1]], [[0]]]}])")) == "valence 3");
  CHECK(element_of(document(R"("masks": [{"valence": 3, "blocks": [[[1, 0]], [[0]], [[0]]]}])")) == "/masks/0/blocks/0/0");
  CHECK(element_of(document(R"("masks": [{"valence": 3, "blocks": [[[1]], [[0.5]], [[0]]]}])")) == "mode matrix");
  const std::string one = R"({"valence": 5, "weights": [0.5, 0.1]})";
  CHECK(element_of(document(R"("scheme": "loop", "masks": [)" + one + ", " + one + "]")) == "/masks/1/valence");
}

}  // namespace hexact
