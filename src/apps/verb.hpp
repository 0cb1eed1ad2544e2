#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "base/error.hpp"

namespace lapwing::apps {

/// Exit codes of every verb (docs/reference/command-line.md).
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,        ///< script error at run time; doctor found something wrong; fmt --check did
  exit_usage = 2,         ///< does not check, bad usage
  exit_halted = 3,        ///< halt, no vehicle found, link or vehicle failure
  exit_interrupted = 130  ///< interrupted, vehicles made safe
};

/// For options that count from 0: "-1" would become the largest number there is.
inline CLI::Validator not_negative() {
  return {[](std::string const& text) { return text.starts_with('-') ? "must be 0 or more, not " + text : ""; }, ""};
}

/// Prints an error the way every verb does: what went wrong, then what to do.
void print_error(base::Error const& error);
/// The same; returns the exit code that goes with it: bad usage when the request itself is wrong, halted otherwise.
[[nodiscard]] int refuse(base::Error const& error);

// Each adds its subcommand to `program`; the chosen one writes `exit_code`.
void add_run(CLI::App& program, int& exit_code);
void add_demo(CLI::App& program, int& exit_code);
void add_plan(CLI::App& program, int& exit_code);
void add_mission(CLI::App& program, int& exit_code);
void add_check(CLI::App& program, int& exit_code);
void add_fmt(CLI::App& program, int& exit_code);
void add_lsp(CLI::App& program, int& exit_code);
void add_sim(CLI::App& program, int& exit_code);
void add_replay(CLI::App& program, int& exit_code);
void add_route(CLI::App& program, int& exit_code);
void add_station(CLI::App& program, int& exit_code);
void add_param(CLI::App& program, int& exit_code);
void add_signing(CLI::App& program, int& exit_code);
void add_doctor(CLI::App& program, int& exit_code);

}  // namespace lapwing::apps
