#pragma once

#include <span>
#include <string_view>

#include <CLI/CLI.hpp>

namespace lapwing::apps {

/// A verb of this executable, and what adds it to the command line (verb.hpp).
struct OwnVerb {
  std::string_view name;
  void (*add)(CLI::App& program, int& exit_code);
};

/// What `main` of an executable does: reads the words, carries out the verb that is meant, or hands over to the
/// executable that has it. `name`: this executable's, of those in verb_table.hpp; `own`: its verbs. Returns the exit
/// code.
[[nodiscard]] int run_program(std::string_view name, std::span<OwnVerb const> own, int argc, char** argv);

}  // namespace lapwing::apps
