// SPDX-License-Identifier: GPL-3.0-or-later
// The subcommand spectrum, and its certificates under edits: hexact-check and the library agree on every claim.
#include "dice.hpp"
#include "spectrum_edits.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>

using namespace hexact;
using namespace hexact::spectrum_test;

namespace {

SpectrumCertificate certificate(SpectrumScheme scheme, const std::vector<int>& valences) {
  std::vector<SpectrumSubject> subjects;
  for (const int k : valences) subjects.push_back(scheme_subject(scheme, k));
  return make_spectrum_certificate(scheme, spectrum_rows(subjects), {"test"});
}

}  // namespace

TEST_CASE("spectral certificates are read back and proved by both checkers", "[spectrum][certificate]") {
  const program::Folder folder;
  for (const auto& [scheme, valences] : {std::pair{SpectrumScheme::midedge6, std::vector{3, 4, 6, 10, 17}}, {SpectrumScheme::midedge, std::vector{4, 5, 30}},
                                         {SpectrumScheme::loop, std::vector{3, 6, 7, 50}}, {SpectrumScheme::catmull_clark, std::vector{3, 4, 8, 50}},
                                         {SpectrumScheme::doo_sabin, std::vector{3, 4, 6, 50}}}) {
    const std::string text = io::spectrum_certificate_text(certificate(scheme, valences));
    CHECK(io::is_spectrum_certificate(text));
    CHECK(io::spectrum_certificate_text(io::parse_spectrum_certificate(text, "test")) == text);
    const Outcome library = by_library(text), checker = by_checker(folder, text);
    CHECK(library.status == 0);
    CHECK(checker.status == 0);
    CHECK(library.claims.size() == 3 * valences.size());
    CHECK(library.claims == checker.claims);
  }
}

TEST_CASE("edited spectral certificates: hexact-check and the library agree on every claim", "[spectrum][certificate]") {
  const program::Folder folder;
  const std::vector<std::string> originals{io::spectrum_certificate_text(certificate(SpectrumScheme::midedge6, {7, 8})),
                                           io::spectrum_certificate_text(certificate(SpectrumScheme::midedge, {4, 5})),
                                           io::spectrum_certificate_text(certificate(SpectrumScheme::loop, {3, 7})),
                                           io::spectrum_certificate_text(certificate(SpectrumScheme::catmull_clark, {5, 6})),
                                           io::spectrum_certificate_text(certificate(SpectrumScheme::doo_sabin, {4, 5}))};
  constexpr std::uint64_t kSeed = 20261125;
  Dice dice(kSeed);
  int malformed = 0, refuted = 0, proved = 0;
  for (int i = 0; i < 400; ++i) {
    const std::string text = edited(originals[static_cast<std::size_t>(i) % originals.size()], dice);
    const Outcome library = by_library(text), checker = by_checker(folder, text);
    INFO("seed " << kSeed << ", edit " << i << ":\n" << text);
    REQUIRE(library.status == checker.status);
    REQUIRE(library.claims == checker.claims);
    ++(library.status == 3 ? malformed : library.status == 1 ? refuted : proved);
  }
  INFO(malformed << " malformed, " << refuted << " refuted, " << proved << " still proved");
  CHECK(malformed > 50);
  CHECK(refuted > 150);
  CHECK(proved > 3);  // a digit behind the last that matters, a weaker bound
}

TEST_CASE("what a forger would try", "[spectrum][certificate]") {
  const program::Folder folder;
  const std::string text = io::spectrum_certificate_text(certificate(SpectrumScheme::midedge6, {6}));
  const auto refused = [&](const std::string& forged) {
    const Outcome library = by_library(forged), checker = by_checker(folder, forged);
    CHECK(library.claims == checker.claims);
    CHECK(library.status == checker.status);
    return library.status;
  };
  CHECK(refused(text) == 0);
  const auto of_valence = [&](const std::string& k) {
    std::string other = replaced(text, "row 6", "row " + k);
    for (const char* claim : {"ordering=", "ring=", "c1="}) other = replaced(other, std::string("claim ") + claim + "6", std::string("claim ") + claim + k);
    return other;
  };
  CHECK(refused(replaced(text, "row 6", "row 7")) == 3);             // nothing is said of the row that is claimed
  CHECK(refused(of_valence("7")) == 1);
  CHECK(refused(of_valence("8")) == 3);                              // a mode is missing
  CHECK(refused(replaced(text, "scheme midedge6", "scheme midedge")) == 1);
  CHECK(refused(replaced(text, "1 1 1\n", "1 1 2\n")) == 1);         // a multiplicity
  CHECK(refused(replaced(text, "\n1/4 1/4 1\n", "\n1/5 1/5 1\n")) == 1);
  CHECK(refused(replaced(text, "ring 3", "ring 4")) == 0);           // a finer proof proves the same bounds
  CHECK(refused(replaced(text, "ring 3", "ring 2")) == 1);
  CHECK(refused(replaced(text, "ring 3", "ring 8")) == 1);
  const std::size_t ring = text.find("ring 3");
  const std::string line = text.substr(ring, text.find('\n', ring) - ring);
  CHECK(refused(replaced(text, line, "ring 3 4/5 1/3")) == 1);       // more than is true
  CHECK(refused(replaced(text, line, "ring 3 3/4 1/4")) == 0);
  CHECK(refused(replaced(text, line, "ring 3 3/4 2/5")) == 1);
  CHECK(refused(replaced(text, line, "ring 3 0 1/3")) == 1);
  CHECK(refused(replaced(text, line, "ring 3 -1 1/3")) == 1);
  CHECK(by_checker(folder, text.substr(0, text.size() - 2) + "\n").status == 3);  // the digest itself
  CHECK(by_library(text.substr(0, text.size() - 2) + "\n").status == 3);
  CHECK(by_checker(folder, with_digest("hexact-spectrum 1\nscheme loop\nrows 0\nsha256 \n")).status == 3);
}

TEST_CASE("an interval proves a cosine only where it holds the right zero", "[spectrum][certificate]") {
  const auto near = [](double x, double width) { return RationalInterval{Rational::from_double(x - width), Rational::from_double(x + width)}; };
  for (const int k : {3, 4, 5, 12, 50}) {
    const double c = std::cos(2 * M_PI / k);
    CHECK(encloses_cosine(near(c, 1e-9), k));
    CHECK_FALSE(encloses_cosine(near(c + 1e-6, 1e-9), k));
    CHECK_FALSE(encloses_cosine(near(std::cos(M_PI / k), 1e-9), k));
    if (k > 4) CHECK_FALSE(encloses_cosine(near(std::cos(4 * M_PI / k), 1e-9), k));
    CHECK_FALSE(encloses_cosine({Rational(-2), Rational(2)}, k));
    CHECK_FALSE(encloses_cosine({Rational(1), Rational(0)}, k));
  }
}

TEST_CASE("spectrum: tables, exit codes, JSON, certificates and pictures", "[spectrum][program]") {
  const program::Folder folder;
  const auto run = [&](const std::string& arguments) { return program::run(folder, "$hexact spectrum " + arguments); };
  program::Run r = run("--scheme midedge6 --valence 5 --json");
  CHECK(r.status == 0);
  const auto report = nlohmann::json::parse(r.out);
  REQUIRE(report["rows"].size() == 1);
  const auto& row = report["rows"][0];
  CHECK(row["k"] == 5);
  CHECK(row["ordering"] == "proved");
  CHECK(row["ring"] == "proved");
  CHECK(row["c1"] == "proved");
  CHECK(row["eigenvalues"].size() == 16 * 5);
  CHECK(row["eigenvalues"][0] == nlohmann::json::array({"1", "1"}));
  const std::string lambda = "0.573625418238251240965495062";
  for (const int i : {1, 2}) {
    for (const int end : {0, 1}) CHECK(row["eigenvalues"][static_cast<std::size_t>(i)][static_cast<std::size_t>(end)].get<std::string>().substr(0, lambda.size()) == lambda);
  }
  CHECK(row["eigenvalues"][3][0].get<std::string>().substr(0, 16) == "0.34107841869420");
  r = run("--scheme midedge --valence 3..5 --json --certificate c.cert");
  CHECK(r.status == 1);  // refuted at 3
  CHECK(nlohmann::json::parse(r.out)["certificate"] == "c.cert");
  CHECK(program::run(folder, "$hexact check c.cert && $check c.cert").status == 0);  // which is what it states
  CHECK(run("--scheme loop --valence 3..5 --certificate c.cert --threads 1").status == 0);
  CHECK(program::run(folder, "cp c.cert d.cert").status == 0);
  CHECK(run("--scheme loop --valence 3..5 --certificate c.cert --threads 2").status == 0);
  CHECK(run("--scheme loop --valence 3..5 --certificate c.cert").out.find("states ordering=3..5 ring=3..5 c1=3..5\n") != std::string::npos);
  CHECK(program::run(folder, "cmp c.cert d.cert && $hexact check c.cert && $check c.cert").status == 0);
  CHECK(program::run(folder, "sed -i '0,/1 1 1/s//1 1 2/' c.cert; $hexact check c.cert").status == 3);  // the digest
  CHECK(run("--scheme doo-sabin --valence 5 --picture p.svg").status == 0);
  CHECK(program::read_bytes(folder.path().string() + "/p.svg").find("<polyline") != std::string::npos);
  CHECK(run("--scheme midedge --valence 3 --picture p3.svg").status == 3);
  for (const char* wrong : {"--valence 2", "--valence 5..3", "--valence x", "--valence 3..", "--valence 99999999999", "--scheme phs --valence 3", "",
                            "--valence 3..4 --picture p.svg", "--valence 4 --json --certificate -"}) {
    CHECK(run(wrong).status == 2);
  }
}
