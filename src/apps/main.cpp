#include <cstdio>
#include <exception>

#include "apps/verb.hpp"

namespace lapwing::apps {
namespace {

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
      "Exit codes:  0 done, 1 script error, 2 bad usage or script, 3 halted, 130 interrupted");

  int exit_code = exit_done;
  add_run(program, exit_code);
  add_demo(program, exit_code);
  add_check(program, exit_code);
  add_sim(program, exit_code);
  add_station(program, exit_code);
  add_doctor(program, exit_code);

  try {
    program.parse(argc, argv);
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
