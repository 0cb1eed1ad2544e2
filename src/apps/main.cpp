#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/verb.hpp"
#include "base/spelling.hpp"

namespace lapwing::apps {
namespace {

using Words = std::vector<std::string>;

/// What was said, without the program's name. `help VERB` is another way to say `VERB --help`.
Words words_of(int argc, char** argv) {
  Words words(argv + 1, argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

/// What to say when the first word is no verb; CLI11 would only ask for one.
std::string unknown_verb(CLI::App const& program, Words const& words) {
  if (words.empty() || words.front().starts_with('-')) return {};
  auto const& word = words.front();
  Words names{"help"};
  for (auto const* verb : program.get_subcommands({})) names.push_back(verb->get_name());
  if (std::ranges::find(names, word) != names.end()) return {};
  std::vector<std::string_view> const candidates(names.begin(), names.end());
  auto const hint = base::did_you_mean(word, candidates);
  return fmt::format("lapwing: there is no command '{}'\n         {}\n", word,
                     hint.empty() ? fmt::format("commands: {}", fmt::join(names, ", ")) : hint);
}

int main_of(int argc, char** argv) {
  CLI::App program("Lapwing: one mission language and one live map, for drones that survey and robots that explore.",
                   "lapwing");
  program.set_version_flag("--version", "lapwing " LAPWING_VERSION);
  program.require_subcommand(1);
  program.failure_message(CLI::FailureMessage::simple);
  program.footer(
      "Start here:  lapwing demo                 simulated vehicles, a script and the map in your browser\n"
      "             lapwing check my.dolphin     every mistake in a script, without vehicles\n"
      "             lapwing run my.dolphin       fly it on the vehicles that send to UDP port 14550\n"
      "             lapwing help run             all that a command can do\n"
      "Exit codes:  0 done, 1 script error, 2 bad usage or script, 3 halted, 130 interrupted");

  int exit_code = exit_done;
  add_run(program, exit_code);
  add_demo(program, exit_code);
  add_plan(program, exit_code);
  add_mission(program, exit_code);
  add_check(program, exit_code);
  add_fmt(program, exit_code);
  add_lsp(program, exit_code);
  add_sim(program, exit_code);
  add_replay(program, exit_code);
  add_station(program, exit_code);
  add_param(program, exit_code);
  add_signing(program, exit_code);
  add_route(program, exit_code);
  add_doctor(program, exit_code);

  auto words = words_of(argc, argv);
  if (auto const wrong = unknown_verb(program, words); !wrong.empty()) {
    std::fputs(wrong.c_str(), stderr);
    return exit_usage;
  }
  try {
    std::ranges::reverse(words);  // CLI11 takes them from the end
    program.parse(std::move(words));
  } catch (CLI::ParseError const& error) {
    // CLI11 numbers its errors from 100; the contract knows one code for bad usage.
    return program.exit(error) == 0 ? exit_done : exit_usage;
  }
  return exit_code;
}

}  // namespace
}  // namespace lapwing::apps

int main(int argc, char** argv) {
  try {
    return lapwing::apps::main_of(argc, argv);
  } catch (std::exception const& error) {
    std::fprintf(stderr, "lapwing: internal error: %s\n         please report this with the command that led here\n",
                 error.what());
    return lapwing::apps::exit_failed;
  }
}
