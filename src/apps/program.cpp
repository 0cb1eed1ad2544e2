#include "apps/program.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/verb.hpp"
#include "apps/verb_table.hpp"
#include "base/text/spelling.hpp"
#include "host/exit_code.hpp"

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
std::string unknown_verb(Words const& words) {
  if (words.empty() || words.front().starts_with('-')) return {};
  auto const& word = words.front();
  std::vector<std::string_view> names{"help"};
  for (auto const& verb : all_verbs()) names.push_back(verb.name);
  if (std::ranges::find(names, word) != names.end()) return {};
  auto const hint = base::did_you_mean(word, names);
  return fmt::format("lapwing: there is no command '{}'\n         {}\n", word,
                     hint.empty() ? fmt::format("commands: {}", fmt::join(names, ", ")) : hint);
}

/// This process becomes the other program of the same folder. Comes back only when there is none.
int hand_over(Verb const& verb, char** argv) {
  std::error_code error;
  auto const program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / verb.program;
  ::execv(program.c_str(), argv);
  host::print_error(
      {.kind = base::ErrorKind::io,
       .message = fmt::format("cannot start {}: {}", program.string(), std::strerror(errno)),
       .hint = fmt::format("'{0}' is in a program of its own, which ./lapwing {0} makes when it is first used",
                           verb.name)});
  return host::exit_failed;
}

int carry_out(std::string_view name, std::span<OwnVerb const> own, int argc, char** argv) {
  auto words = words_of(argc, argv);
  if (auto const wrong = unknown_verb(words); !wrong.empty()) {
    std::fputs(wrong.c_str(), stderr);
    return host::exit_usage;
  }
  if (auto const* verb = words.empty() ? nullptr : find_verb(words.front()); verb && verb->program != name)
    return hand_over(*verb, argv);

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
  int exit_code = host::exit_done;
  for (auto const& verb : all_verbs()) {
    auto const found = std::ranges::find(own, verb.name, &OwnVerb::name);
    if (found != own.end()) {
      found->add(program, exit_code);
    } else {
      (void)begin_verb(program, verb.name);  // help shows the verbs of all programs
    }
  }
  try {
    std::ranges::reverse(words);  // CLI11 takes them from the end
    program.parse(std::move(words));
  } catch (CLI::ParseError const& error) {
    // CLI11 numbers its errors from 100; the contract knows one code for bad usage.
    return program.exit(error) == 0 ? host::exit_done : host::exit_usage;
  }
  return exit_code;
}

}  // namespace

int run_program(std::string_view name, std::span<OwnVerb const> own, int argc, char** argv) {
  try {
    return carry_out(name, own, argc, argv);
  } catch (std::exception const& error) {
    std::fprintf(stderr, "lapwing: internal error: %s\n         please report this with the command that led here\n",
                 error.what());
    return host::exit_failed;
  }
}

}  // namespace lapwing::apps
