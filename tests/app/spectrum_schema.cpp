// SPDX-License-Identifier: GPL-3.0-or-later
// Masks and reports of spectrum against their schemas; what check says a certificate is about.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace hexact;
using program::run;

namespace {

bool is_valid(const program::Folder& folder, const std::string& document, const std::string& kind) {
  const program::Run result = run(folder, "python3 -W ignore -m jsonschema -i '" + document + "' '" HEXACT_SOURCE_DIR "/io/schema/" + kind + ".schema.json'");
  CAPTURE(document, result.err);
  REQUIRE((result.status == 0 || (!result.err.empty() && result.err.find("Traceback") == std::string::npos && result.err.find("No module") == std::string::npos)));
  return result.status == 0;
}

void write(const program::Folder& folder, const char* name, const std::string& text) { program::write_bytes((folder.path() / name).string(), text); }

}  // namespace

TEST_CASE("masks: what the schema accepts the program reads, what it rejects the program rejects", "[program][schema][masks]") {
  const program::Folder folder;
  const std::string head = R"({"hexact": "masks", "version": 1)", loop = R"(, "scheme": "loop", "masks": [)", blocks = R"(, "masks": [)";
  const std::vector<std::pair<std::string, bool>> documents = {
      {head + loop + R"({"valence": 5, "weights": [0.5, "1/10"]}]})", true},
      {head + R"(, "name": "own")" + loop + R"({"valence": 5, "weights": [5e-1, "0.1"]}]})", true},
      {head + R"(, "scheme": "doo-sabin", "masks": [{"valence": 3, "weights": ["5/8", "3/16", 0.1875]}]})", true},
      {head + R"(, "scheme": "catmull-clark", "masks": [{"valence": 4, "weights": ["9/16", "3/32", "1/64"]}]})", true},
      {head + blocks + R"({"valence": 3, "blocks": [[["1/2"]], [[0.25]], [[0.25]]]}]})", true},
      {head + "}", false},
      {R"({"hexact": "masks", "version": 2)" + loop + R"({"valence": 5, "weights": [0.5, 0.1]}]})", false},
      {R"({"hexact": "curves", "version": 1)" + loop + R"({"valence": 5, "weights": [0.5, 0.1]}]})", false},
      {head + R"(, "name": 3)" + loop + R"({"valence": 5, "weights": [0.5, 0.1]}]})", false},
      {head + R"(, "scheme": "midedge6", "masks": [{"valence": 5, "weights": [0.5, 0.1]}]})", false},
      {head + R"(, "masks": []})", false},
      {head + R"(, "scheme": "loop", "masks": {}})", false},
      {head + R"(, "colour": 1)" + loop + R"({"valence": 5, "weights": [0.5, 0.1]}]})", false},
      {head + loop + R"({"valence": 2, "weights": [0.5, 0.25]}]})", false},
      {head + loop + R"({"valence": 1001, "weights": [0.5, 0.25]}]})", false},
      {head + loop + R"({"weights": [0.5, 0.25]}]})", false},
      {head + loop + R"({"valence": 5}]})", false},
      {head + loop + R"({"valence": 5, "weights": [0.5, "a tenth"]}]})", false},
      {head + loop + R"({"valence": 5, "weights": [0.5, "1/10+1/2*sqrt5"]}]})", false},
      {head + loop + R"({"valence": 5, "weights": [0.5, null]}]})", false},
      {head + loop + R"({"valence": 3, "blocks": [[["1/2"]], [[0.25]], [[0.25]]]}]})", false},
      {head + blocks + R"({"valence": 5, "weights": [0.5, 0.1]}]})", false},
      {head + blocks + R"({"valence": 3, "blocks": [[], [], []]}]})", false},
  };
  for (const auto& [text, good] : documents) {
    CAPTURE(text);
    write(folder, "m.json", text);
    CHECK(is_valid(folder, "m.json", "masks") == good);
    const int status = run(folder, "$hexact spectrum --masks m.json").status;
    CHECK((good ? status == 0 || status == 1 || status == 5 : status == 3));
  }
}

TEST_CASE("reports of spectrum keep their schema, whatever is proved", "[program][schema][spectrum]") {
  const program::Folder folder;
  write(folder, "twice.json", R"({"hexact": "masks", "version": 1, "scheme": "doo-sabin", "masks": [{"valence": 5, "weights": ["2/5", "1/20", "1/4", "1/4", "1/20"]}]})");
  write(folder, "complex.json", R"({"hexact": "masks", "version": 1, "scheme": "catmull-clark", "masks": [{"valence": 5, "weights": [0.5, "-1/5", "3/10"]}]})");
  write(folder, "open.json", R"({"hexact": "masks", "version": 1, "scheme": "doo-sabin", "masks": [{"valence": 7, "weights": ["1/2", "1/12", "1/12", "1/12", "1/12", "1/12", "1/12"]}]})");
  for (const char* arguments : {"--valence 3..8", "--regular --valence 5", "--regular --certificate c.cert", "--scheme loop --regular", "--scheme midedge --regular", "--scheme midedge --valence 3..4 --certificate c.cert", "--scheme loop --valence 7 --certificate c.cert",
                                "--masks twice.json --certificate c.cert", "--masks complex.json --certificate c.cert", "--masks open.json --certificate c.cert",
                                "--masks open.json"}) {
    CAPTURE(arguments);
    CHECK(run(folder, std::string("$hexact spectrum --json ") + arguments + " > r.json; test $? -le 5").status == 0);
    CHECK(is_valid(folder, "r.json", "spectrum-report"));
  }
  // The schema itself refuses what is wrong.
  auto report = nlohmann::json::parse(program::read_bytes((folder.path() / "r.json").string()));
  for (const auto& [key, value] : std::vector<std::pair<std::string, nlohmann::json>>{{"/verdict", "maybe"}, {"/rows/0/k", 2}, {"/rows/0/witness", 7}, {"/rows/0/c1", "proved"},
                                                                                    {"/rows/0/eigenvalues/0", {"1"}}, {"/claims", {"ordering=7"}}, {"/rows", nlohmann::json::array()},
                                                                                    {"/regular", {{"verdict", "proved"}}}, {"/colour", 1}}) {
    CAPTURE(key);
    auto wrong = report;
    wrong[nlohmann::json::json_pointer(key)] = value;
    write(folder, "wrong.json", wrong.dump());
    CHECK_FALSE(is_valid(folder, "wrong.json", "spectrum-report"));
  }
}

TEST_CASE("both checkers say what a spectral certificate is about", "[program][spectrum][masks]") {
  const program::Folder folder;
  write(folder, "w.json", R"({"hexact": "masks", "version": 1, "scheme": "loop", "masks": [{"valence": 5, "weights": [0.5, 0.1]}, {"valence": 3, "weights": ["7/16", "3/16"]}]})");
  write(folder, "b.json", R"({"hexact": "masks", "version": 1, "masks": [{"valence": 3, "blocks": [[["1/2"]], [[0.25]], [[0.25]]]}]})");
  REQUIRE(run(folder, "$hexact spectrum --masks w.json --certificate w.cert && $hexact spectrum --scheme loop --valence 5 --certificate l.cert").status == 0);
  CHECK(run(folder, "$hexact spectrum --masks b.json --certificate b.cert").status == 5);
  const auto report = [&](const char* program, const char* file) { return nlohmann::json::parse(run(folder, std::string("$") + program + file).out); };
  for (const char* program : {"hexact check --json ", "check --json "}) {
    CAPTURE(program);
    CHECK(report(program, "w.cert")["scheme"] == "loop");
    CHECK(report(program, "w.cert")["masks"] == nlohmann::json::parse(R"({"5": ["1/2", "1/10"], "3": ["7/16", "3/16"]})"));
    CHECK(report(program, "b.cert")["scheme"] == "blocks");
    CHECK(report(program, "b.cert")["masks"] == nlohmann::json::parse(R"({"3": [["1/2"], ["1/4"], ["1/4"]]})"));
    CHECK(report(program, "l.cert")["scheme"] == "loop");
    CHECK_FALSE(report(program, "l.cert").contains("masks"));
  }
  CHECK(run(folder, "$hexact check w.cert >a && $check w.cert >b && diff a b && grep -qx 'mask 5: 1/2 1/10' a").status == 0);
  CHECK(run(folder, "$hexact check b.cert >a && $check b.cert >b && diff a b").status == 0);
}
