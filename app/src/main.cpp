// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.hpp"
#include "hexact/kernel/errors.hpp"
#include "progress_bar.hpp"

#include <fmt/format.h>
#include <gmp.h>
#include <tbb/global_control.h>
#include <tbb/version.h>

#include <csignal>
#include <cstdio>
#include <iostream>
#include <limits>
#include <memory>
#include <new>
#include <thread>
#include <unistd.h>

namespace hexact::app {
namespace {

std::string version_text() {
  return fmt::format("hexact {}\nGMP {}\noneTBB {}.{}\nCLI11 {}\n", HEXACT_VERSION, gmp_version, TBB_VERSION_MAJOR,
                     TBB_VERSION_MINOR, CLI11_VERSION);
}

/// What shells report of a program that a signal ended, less the signal.
constexpr int kInterrupted = 128;

struct Failure {
  int exit_code = kDefect;
  std::string code;
  std::string message;
  std::string file;
  std::uint64_t line = 0;
  std::string element;
};

int report_failure(const Failure& failure, const Common& common) {
  if (common.json) {
    nlohmann::ordered_json error;
    error["code"] = failure.code;
    error["message"] = failure.message;
    error["file"] = failure.file.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(failure.file);
    error["line"] = failure.line == 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(failure.line);
    error["element"] = failure.element.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(failure.element);
    nlohmann::ordered_json document;
    document["error"] = error;
    std::cout << document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
  }
  std::string place = failure.file;
  if (failure.line != 0) place += ":" + std::to_string(failure.line);
  if (!place.empty()) place += ": ";
  std::cerr << "hexact: " << place << failure.message << "\n";
  return failure.exit_code;
}

/// The file that an error without a place of its own is about: the first positional argument, if there is one.
Failure failure_of_current_exception() {
  try {
    throw;
  } catch (const UsageError& e) {
    return {kUsage, "Usage", e.what(), "", 0, ""};
  } catch (const ParseError& e) {
    return {kBadInput, e.code(), e.what(), e.file(), e.line().value_or(0), e.element()};
  } catch (const FileError& e) {
    return {kBadInput, e.code(), e.what(), e.file(), 0, ""};
  } catch (const InvalidInput& e) {
    Failure failure{kBadInput, e.code(), e.what(), "", 0, ""};
    if (!e.findings().empty()) {
      failure.element = e.findings().front().element;
      failure.line = e.findings().front().line.value_or(0);
    }
    return failure;
  } catch (const ResourceLimit& e) {
    return {kResourceLimit, e.code(), e.what(), "", 0, ""};
  } catch (const NumericalFailure& e) {
    return {kResourceLimit, e.code(), e.what(), "", 0, ""};
  } catch (const ExternalToolError& e) {
    return {kUndecided, e.code(), e.what(), "", 0, ""};
  } catch (const Cancelled&) {
    return {kInterrupted + Interruption::signal(), "Cancelled", "interrupted; nothing was written", "", 0, ""};
  } catch (const std::bad_alloc&) {
    return {kResourceLimit, "OutOfMemory", "there is not enough memory", "", 0, ""};
  } catch (const std::exception& e) {
    return {kDefect, "InternalError", std::string("this is a defect of hexact: ") + e.what(), "", 0, ""};
  }
}

ProgressBar::Mode bar_mode(const Common& common) {
  if (common.quiet) return ProgressBar::Mode::off;
  if (common.progress) return ProgressBar::Mode::lasting;
  return isatty(STDERR_FILENO) != 0 ? ProgressBar::Mode::passing : ProgressBar::Mode::off;
}

/// Runs the subcommand with a progress bar; Ctrl-C cancels it.
Outcome run_selected(const std::function<Outcome()>& selected, Common& common) {
  Progress progress;
  const Interruption interruption(progress);
  ProgressBar bar(progress, bar_mode(common));
  common.work = ProgressPart(progress);
  common.remark = [&](const std::string& line) {
    if (!common.quiet) bar.print("hexact: " + line);
  };
  Outcome outcome = selected();
  progress.raise(1);
  return outcome;
}

int print_outcome(const Outcome& outcome, const Common& common) {
  if (common.json) {
    std::cout << outcome.report.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  } else {
    std::cout << outcome.text << std::flush;
  }
  if (!std::cout) {
    std::cerr << "hexact: standard output cannot be written\n";
    return kBadInput;
  }
  return outcome.exit_code;
}

/// Ends as the signal would have ended the program, for shells and scripts that look at it.
int end_interrupted(const Failure& failure, const Common& common) {
  const int status = report_failure(failure, common);
  if (status <= kInterrupted) return kDefect;
  std::cout << std::flush;
  std::signal(status - kInterrupted, SIG_DFL);
  std::raise(status - kInterrupted);
  return status;
}

int run(int argc, char** argv) {
  CLI::App root("Exact planar honeycomb subdivision: flat panels with a proof.", "hexact");
  root.require_subcommand(1);
  root.set_version_flag("--version", version_text());
  Common common;
  std::function<Outcome()> selected;
  const Registry registry{root, common, selected};
  add_make(registry);
  add_convert(registry);
  add_info(registry);
  add_prepare(registry);
  add_subdivide(registry);
  add_certify(registry);
  add_check(registry);
  add_crosscheck(registry);
  add_bench(registry);
  add_spectrum(registry);
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return root.exit(e);
    for (int i = 1; i < argc; ++i) common.json = common.json || std::string(argv[i]) == "--json";
    return report_failure({kUsage, "Usage", e.what(), "", 0, ""}, common);
  }
  const std::size_t threads =
      common.threads > 0 ? static_cast<std::size_t>(common.threads) : std::max(1u, std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  try {
    return print_outcome(run_selected(selected, common), common);
  } catch (...) {
    const Failure failure = failure_of_current_exception();
    return failure.code == "Cancelled" ? end_interrupted(failure, common) : report_failure(failure, common);
  }
}

}  // namespace

CLI::App* Registry::add(const std::string& name, const std::string& description) const {
  CLI::App* command = root.add_subcommand(name, description);
  command->add_flag("--json", common.json, "Print one JSON object and nothing else on standard output");
  command->add_flag("--quiet,-q", common.quiet, "No progress and no remarks");
  command->add_flag("--progress", common.progress, "Show progress even when standard error is no terminal");
  command->add_option("--threads", common.threads, "Number of threads; the result does not depend on it (default: all cores)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--max-facets", common.max_facets, "Refuse work that would make more facets")
      ->check(CLI::PositiveNumber);
  command->add_option("--max-memory", common.max_memory, "Refuse work that would need more memory, e.g. 4GiB")
      ->transform(CLI::AsSizeValue(false));
  command->add_option("--unit", common.unit, "Unit of length, for reports and formats that carry one")
      ->check(CLI::IsMember({"mm", "m", "in"}));
  return command;
}

}  // namespace hexact::app

int main(int argc, char** argv) { return hexact::app::run(argc, argv); }
