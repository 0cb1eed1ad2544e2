#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "base/async/loop.hpp"
#include "dolphin/machine/engine.hpp"
#include "missions/mission_harness.hpp"

/// Runs a script that leaves a task in `t`, executes it on the test platform in virtual time, and prints the seconds
/// from load to end. usage: bench_language SCRIPT
namespace {

using namespace lapwing;

class Silence final : public dolphin::Output {
 public:
  void write(std::string_view) override {}
  base::Task<base::Result<std::string>> ask(std::string) override {
    co_return base::fail(base::ErrorKind::io, "nobody answers");
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: bench_language SCRIPT\n", stderr);
    return 2;
  }
  std::ifstream file(argv[1]);
  std::ostringstream text;
  text << file.rdbuf() << "\nexecute t\n";

  base::Loop loop({.unpaced = true});
  missions::MissionHarness platform(loop);
  auto const source = std::make_shared<base::SourceFile const>(argv[1], text.str());
  base::Diagnostics diagnostics(*source);
  auto const began = std::chrono::steady_clock::now();
  auto const program = dolphin::load(source, platform.vocabulary(), diagnostics);
  if (!program) {
    std::fputs(base::render(diagnostics).c_str(), stderr);
    return 2;
  }
  Silence output;
  dolphin::Engine engine(loop, platform, output, {});
  auto const outcome = loop.run_until_done(engine.run(program));
  std::chrono::duration<double> const took = std::chrono::steady_clock::now() - began;
  if (outcome.kind != dolphin::Outcome::Kind::done) {
    std::fprintf(stderr, "%s\n", dolphin::to_text(outcome).c_str());
    return 1;
  }
  std::printf("%.6f\n", took.count());
}
