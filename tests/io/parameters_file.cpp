// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/io/parameters_file.hpp"

#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

namespace hexact::io {
namespace {

TEST_CASE("a parameters document is read exactly", "[parameters]") {
  const ParameterDocument d = parse_parameters(
      R"({"hexact": "parameters", "version": 1, "default": "constant=1/4",
          "levels": [{"level": 2, "sizes": {"4": "1/4", "6": 0.1}, "edges": [[0, 7, 0, "1/8+1/16*sqrt5"]]}]})", "x.json");
  CHECK(d.default_policy == "constant=1/4");
  REQUIRE(d.levels.size() == 1);
  CHECK(d.levels[0].level == 2);
  CHECK(d.levels[0].sizes.at(6).str() == "1/10");
  CHECK(d.levels[0].edges.at(0).b == 7);
  CHECK(d.levels[0].edges[0].ab.is_zero());
  CHECK(d.levels[0].edges[0].ba.str() == "1/8+1/16*sqrt5");
}

TEST_CASE("what is no parameters document is refused with the path", "[parameters]") {
  const auto path = [](const std::string& text) {
    try {
      (void)parse_parameters(text, "x.json");
    } catch (const ParseError& e) {
      CHECK(e.file() == "x.json");
      return e.element();
    }
    return std::string("accepted");
  };
  const auto with = [](const std::string& rest) { return R"({"hexact": "parameters", "version": 1)" + rest + "}"; };
  CHECK(path(with("")) == "accepted");
  CHECK(path("") == "");
  CHECK(path("[1]") == "");
  CHECK(path("{\"hexact\": \"parameters\"") == "");
  CHECK(path(R"({"hexact": "curves", "version": 1})") == "");
  CHECK(path(with(R"(, "colour": 1)")) == "/colour");
  CHECK(path(with(R"(, "default": 1)")) == "/default");
  CHECK(path(with(R"(, "levels": {})")) == "/levels");
  CHECK(path(with(R"(, "levels": [{"sizes": {}}])")) == "/levels/0");
  CHECK(path(with(R"(, "levels": [{"level": -1}])")) == "/levels/0/level");
  CHECK(path(with(R"(, "levels": [{"level": 0, "sizes": {"2": 0}}])")) == "/levels/0/sizes/2");
  CHECK(path(with(R"(, "levels": [{"level": 0, "sizes": {"4": "nan"}}])")) == "/levels/0/sizes/4");
  CHECK(path(with(R"(, "levels": [{"level": 0, "edges": [[0, 1, 0]]}])")) == "/levels/0/edges/0");
  CHECK(path(with(R"(, "levels": [{"level": 0, "edges": [[0, 1, 0, true]]}])")) == "/levels/0/edges/0/3");
  CHECK_THROWS_AS(read_parameters("/nonexistent/x.json"), FileError);
}

}  // namespace
}  // namespace hexact::io
