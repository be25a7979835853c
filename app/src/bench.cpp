// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.hpp"
#include "hexact/kernel/errors.hpp"
#include "hexact/validation/child_process.hpp"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

namespace hexact::app {
namespace {

namespace fs = std::filesystem;

struct BenchOptions {
  std::vector<unsigned> levels = {10, 11};
  double time_limit = 3600;
  std::string programs;
};

/// Where this program stands.
fs::path own_path() {
  std::error_code failed;
  const fs::path path = fs::read_symlink("/proc/self/exe", failed);
  if (failed) throw ExternalToolError("cannot tell where this program is: " + failed.message());
  return path;
}

/// The folder of the benchmark programs: as asked, else beside this program in its build tree, else in its prefix.
fs::path programs_folder(const std::string& asked, const fs::path& own) {
  std::vector<fs::path> places;
  if (asked.empty()) {
    fs::path up;
    for (const auto& part : fs::path(HEXACT_BINDIR)) up /= part.empty() ? "" : "..";
    places = {own.parent_path() / "../validation/bench", own.parent_path() / up / HEXACT_LIBEXEC};
  } else {
    places = {fs::absolute(asked)};
  }
  for (const fs::path& place : places) {
    if (fs::exists(place / "run") && fs::exists(place / "honeycomb_bench")) return fs::canonical(place);
  }
  throw ExternalToolError("there are no benchmark programs in " + places.front().lexically_normal().string() +
                          "; build the target honeycomb_bench, or say where they are with --programs");
}

std::string table_text(const nlohmann::ordered_json& report) {
  std::string text = fmt::format("{} cores\n", report.at("cores").get<int>());
  for (const auto& row : report.at("comparisons")) {
    const auto cell = [&](const char* key) { return row.at(key).get<std::string>(); };
    const std::string met = row.at("met").is_null() ? "" : row.at("met").get<bool>() ? ", met" : ", NOT met";
    text += fmt::format("{}\n    ours  {}\n    peer  {}\n    ratio {} (target {}{})\n", cell("what"), cell("ours"), cell("peer"),
                        cell("ratio"), cell("target"), met);
  }
  return text;
}

/// The script prints one JSON object as its last line; what it says before is about peers that fail.
nlohmann::ordered_json last_object(const std::string& output) {
  const std::size_t end = output.find_last_not_of('\n');
  const std::size_t start = end == std::string::npos ? 0 : output.rfind('\n', end) + 1;
  auto object = nlohmann::ordered_json::parse(output.substr(start), nullptr, false);
  if (object.is_discarded() || !object.contains("comparisons")) {
    throw ExternalToolError("the benchmarks gave no result: " + output.substr(output.size() > 400 ? output.size() - 400 : 0));
  }
  return object;
}

Outcome bench(const BenchOptions& options, const Common& common) {
  const fs::path own = own_path(), programs = programs_folder(options.programs, own);
  std::vector<std::string> command = {"python3", (programs / "run").string(), "--json", "--programs", programs.string(),
                                      "--hexact", own.string(), "--check", (own.parent_path() / "hexact-check").string(), "--level"};
  for (const unsigned level : options.levels) command.push_back(std::to_string(level));
  common.work.report(0.01);
  const validation::TemporaryFolder folder;
  const validation::ChildResult child = validation::run_child(command, folder.path(), options.time_limit, common.work);
  using End = validation::ChildResult::End;
  if (child.end == End::not_started) throw ExternalToolError(std::string("cannot run python3: ") + std::strerror(child.status));
  if (child.end == End::timed_out) throw ResourceLimit("the benchmarks took longer than --time-limit");
  Outcome outcome;
  outcome.report = last_object(child.output);
  outcome.text = table_text(outcome.report);
  outcome.exit_code = child.status == 0 ? kDone : kClaimFails;
  return outcome;
}

}  // namespace

void add_bench(const Registry& registry) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* command = registry.add("bench", "Measures hexact, and its peers where they were built. Exit 1: a target is not met, 5: "
                                            "there are no benchmark programs");
  command->add_option("--level", options->levels, "Levels of the cube for the long comparisons; below 10 without targets")
      ->check(CLI::Range(1, 13))->capture_default_str();
  command->add_option("--programs", options->programs, "Folder of the benchmark programs (default: beside this program)");
  command->add_option("--time-limit", options->time_limit, "Seconds for everything")->check(CLI::PositiveNumber)->capture_default_str();
  command->callback([options, registry] {
    registry.selected = [options, &common = registry.common] { return bench(*options, common); };
  });
}

}  // namespace hexact::app
