// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace hexact;
using program::run;

TEST_CASE("bench measures our engines and says which peers were not built", "[program][bench]") {
  const program::Folder folder;
  const program::Run result = run(folder, "\"$hexact\" bench --level 5 --json");
  CAPTURE(result.out, result.err);
  REQUIRE(result.status == 0);
  const auto report = nlohmann::json::parse(result.out);
  CHECK(report.at("cores").get<int>() > 0);
  std::size_t measured = 0;
  for (const auto& row : report.at("comparisons")) {
    for (const char* key : {"what", "ours", "peer", "ratio", "target"}) CHECK(row.at(key).is_string());
    CHECK(row.at("met").is_null());  // targets are for deep levels
    if (row.at("ours").get<std::string>().find("974 facets") != std::string::npos) ++measured;
  }
  CHECK(measured >= 5);
}

TEST_CASE("bench without benchmark programs: exit 5 with what to do", "[program][bench]") {
  const program::Folder folder;
  const program::Run result = run(folder, "mkdir empty && \"$hexact\" bench --programs empty --json");
  CHECK(result.status == 5);
  CHECK(nlohmann::json::parse(result.out).at("error").at("message").get<std::string>().find("honeycomb_bench") != std::string::npos);
  CHECK(run(folder, "\"$hexact\" bench --level 40").status == 2);
}
