#pragma once

#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "host/exit_code.hpp"

namespace lapwing::apps {

/// For options that count from 0: "-1" would become the largest number there is.
inline CLI::Validator not_negative() {
  return {[](std::string const& text) { return text.starts_with('-') ? "must be 0 or more, not " + text : ""; }, ""};
}

/// The subcommand of that verb of the table in verb.cpp, with what the table says of it and no options yet.
[[nodiscard]] CLI::App* begin_verb(CLI::App& program, std::string_view name);

// Each adds its subcommand to `program`; the chosen one writes `exit_code`. Those of lapwing itself:
void add_check(CLI::App& program, int& exit_code);
void add_fmt(CLI::App& program, int& exit_code);
void add_lsp(CLI::App& program, int& exit_code);

// Those of lapwing-map:
void add_basemap(CLI::App& program, int& exit_code);
void add_explore(CLI::App& program, int& exit_code);
void add_store(CLI::App& program, int& exit_code);

// That of lapwing-slam:
void add_map(CLI::App& program, int& exit_code);

// That of lapwing-onboard:
void add_onboard(CLI::App& program, int& exit_code);

// Those of lapwing-perceive:
void add_overlook(CLI::App& program, int& exit_code);
void add_shoot(CLI::App& program, int& exit_code);
void add_perceive(CLI::App& program, int& exit_code);

// That of lapwing-stream:
void add_stream(CLI::App& program, int& exit_code);

// Those of lapwing-vision:
void add_detect(CLI::App& program, int& exit_code);
void add_look(CLI::App& program, int& exit_code);

// Those of lapwing-vehicles:
void add_run(CLI::App& program, int& exit_code);
void add_demo(CLI::App& program, int& exit_code);
void add_plan(CLI::App& program, int& exit_code);
void add_mission(CLI::App& program, int& exit_code);
void add_sim(CLI::App& program, int& exit_code);
void add_replay(CLI::App& program, int& exit_code);
void add_route(CLI::App& program, int& exit_code);
void add_station(CLI::App& program, int& exit_code);
void add_param(CLI::App& program, int& exit_code);
void add_signing(CLI::App& program, int& exit_code);
void add_doctor(CLI::App& program, int& exit_code);

}  // namespace lapwing::apps
