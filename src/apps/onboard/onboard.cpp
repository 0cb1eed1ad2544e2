#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/onboard/onboard_config.hpp"
#include "apps/verb.hpp"
#include "base/async/child_program.hpp"
#include "base/files/replace_file.hpp"
#include "base/log.hpp"
#include "base/wall_clock.hpp"
#include "host/files/config_file.hpp"
#include "host/files/secret_file.hpp"
#include "host/session/signals.hpp"
#include "onboard/life/life_line.hpp"
#include "onboard/supervisor/process_ledger.hpp"
#include "onboard/supervisor/supervisor.hpp"

namespace lapwing::apps {

namespace {

struct OnboardArguments {
  std::string config;
  std::string only;
};

/// Without its supervisor a bridge stays for as long as decide takes to bring the drone down.
constexpr base::Duration bridge_outlives = std::chrono::seconds(12);

/// One process: its loop and log, and how it ends.
class OwnProcess {
 public:
  OwnProcess(std::string name, OnboardConfig config) : name_(std::move(name)), config_(std::move(config)) {
    hub_.add_sink(base::standard_error_sink(base::LogLevel::info));
  }

  int run() {
    if (auto end = onboard::LifeLine::from_environment()) life_.emplace(loop_, *std::move(end), [this] { orphaned(); });
    if (auto const opened = open(); !opened) return host::refuse(opened.error());
    host::StopSignals const signals(loop_, [this] { stop(); });
    loop_.run();
    return host::exit_done;
  }

 private:
  base::Result<> open() {
    auto options = config_.bus;
    options.name = fmt::format("lapwing-{}", name_);
    auto bus = bus::Bus::open(loop_, options);
    if (!bus) return std::unexpected(bus.error());
    bus_ = *std::move(bus);
    return name_ == bridge_process ? open_bridge() : open_decide();
  }
  base::Result<> open_bridge() {
    auto bridge = bridge::Bridge::open(loop_, *bus_, config_.bridge, log_);
    if (!bridge) return std::unexpected(bridge.error());
    bridge_ = *std::move(bridge);
    log_.info(fmt::format("waits for flight controller {}", config_.bridge.system_id));
    return {};
  }
  base::Result<> open_decide() {
    if (!config_.token_file.empty()) {
      auto token = host::read_secret({.path = config_.token_file.string(),
                                      .what = "token file",
                                      .hint = "make one: openssl rand -hex 32 > FILE; chmod 600 FILE"});
      if (!token) return std::unexpected(token.error());
      config_.decide.desk.server.end.token = *std::move(token);
    }
    auto decide = onboard::Decide::open(loop_, *bus_, config_.decide, log_);
    if (!decide) return std::unexpected(decide.error());
    decide_ = *std::move(decide);
    return {};
  }

  void stop() {
    if (decide_)
      decide_->leave([this] { loop_.stop(); });
    else
      loop_.stop();
  }
  void orphaned() {
    log_.warn("the supervisor has gone");
    if (decide_) return stop();
    scope_.spawn(stop_later());
  }
  base::Task<> stop_later() {
    co_await loop_.sleep(bridge_outlives);
    stop();
  }

  std::string name_;
  OnboardConfig config_;
  base::LogHub hub_;
  base::Logger log_{hub_, name_};
  base::Loop loop_;
  std::unique_ptr<bus::Bus> bus_;
  std::unique_ptr<bridge::Bridge> bridge_;
  std::unique_ptr<onboard::Decide> decide_;
  std::optional<onboard::LifeLine> life_;
  base::Scope scope_{loop_};
};

/// A process that has a program of its own, in the folder of this one, which reads the same file.
struct Beside {
  std::string_view process;  ///< also the program's verb
  std::string_view program;
  std::string_view what_needs_it;
  std::string_view what_it_needs;
};
constexpr Beside perceive{.process = perceive_process,
                          .program = "lapwing-perceive",
                          .what_needs_it = "a camera",
                          .what_it_needs = "OpenCV (setup/packages-vision.txt)"};
constexpr Beside stream{.process = stream_process,
                        .program = "lapwing-stream",
                        .what_needs_it = "[rtsp] or [webrtc]",
                        .what_it_needs = "GStreamer (setup/packages-stream.txt)"};

std::filesystem::path this_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}
std::filesystem::path path_of(Beside const& beside) {
  return this_program().parent_path() / beside.program;
}

/// What starts the processes: this program with another word, or one beside it.
void complete_commands(OnboardConfig& config, std::string const& file) {
  // What sees may take all processors: who flies the drone and who decides come first.
  constexpr int steps_back = 10;
  for (auto& spec : config.processes) {
    if (!spec.command.empty()) continue;
    spec.command = {this_program().string(), "onboard", "--config", file, "--only", spec.name};
    for (auto const& beside : {perceive, stream}) {
      if (spec.name != beside.process) continue;
      spec.command = {path_of(beside).string(), spec.name, "--config", file};
      spec.niceness = steps_back;
    }
  }
}

/// Its part of the file is checked by the program that has it, before anything is started.
bool is_sound(Beside const& beside, std::string const& file) {
  constexpr std::uint64_t most_memory = std::uint64_t{16} << 30U;  // of address space, for libraries alone
  base::Loop loop;
  auto const outcome =
      loop.run_until_done(base::run_child(loop, {.program = path_of(beside),
                                                 .words = {std::string(beside.process), "--config", file, "--check"},
                                                 .most_memory_bytes = most_memory}));
  if (!outcome) {
    host::print_error(
        {.kind = outcome.error().kind,
         .message = fmt::format("{} has {}, and {} is not to be started: {}", file, beside.what_needs_it,
                                path_of(beside).string(), outcome.error().message),
         .hint = fmt::format("./lapwing {} --help builds it; it needs {}", beside.process, beside.what_it_needs)});
    return false;
  }
  fmt::print(stderr, "{}", outcome->errors);
  return outcome->exit_code == host::exit_done;
}

/// What is written whenever a process has another state: for people and their programs, and for the next start.
class Notes {
 public:
  /// `ledger`: null where there is none.
  Notes(std::filesystem::path health_file, onboard::ProcessLedger const* ledger, base::Logger log)
      : health_file_(std::move(health_file)), ledger_(ledger), log_(std::move(log)) {}

  void write(std::vector<onboard::ProcessStatus> const& all) {
    if (!health_file_.empty())
      warn_once(told_of_health_, "health is not written",
                base::replace_file(health_file_, onboard::status_text(all, base::wall_now())));
    if (ledger_ != nullptr) warn_once(told_of_ledger_, "the processes are not written down", ledger_->note(all));
  }

 private:
  void warn_once(bool& told, std::string_view what, base::Result<> const& written) const {
    if (!written && !told) log_.warn(fmt::format("{}: {}", what, written.error().message));
    told = !written;
  }

  std::filesystem::path health_file_;
  onboard::ProcessLedger const* ledger_;
  base::Logger log_;
  bool told_of_health_ = false;
  bool told_of_ledger_ = false;
};

int supervise(OnboardConfig config, std::string const& file) {
  complete_commands(config, file);
  base::LogHub hub;
  hub.add_sink(base::standard_error_sink(base::LogLevel::info));
  base::Logger const log(hub, "onboard");
  auto ledger = onboard::ProcessLedger::open(config.decide.state_folder);
  if (!ledger && ledger.error().kind == base::ErrorKind::refused) return host::refuse(ledger.error());
  // A disk that takes nothing keeps no drone from flying.
  if (!ledger) log.warn(fmt::format("the processes are not written down: {}", ledger.error().message));
  base::Loop loop;
  Notes notes(std::move(config.health_file), ledger ? &*ledger : nullptr, log);
  onboard::Supervisor supervisor(
      loop,
      {.processes = config.processes, .left_over = ledger ? ledger->left_over() : std::vector<onboard::ProcessMark>{}},
      log, [&notes](std::vector<onboard::ProcessStatus> const& all) { notes.write(all); });
  host::StopSignals const signals(loop, [&] {
    log.info("stops: the drone comes down or is disarmed first");
    supervisor.stop([&loop] { loop.stop(); });
  });
  loop.run();
  return host::exit_done;
}

int start_onboard(OnboardArguments const& arguments) {
  OnboardConfig found;
  auto const read = [&found](base::SourceFile const& source, base::Diagnostics& diagnostics) {
    found = read_onboard_config(source, diagnostics);
    return found;
  };
  auto config = host::load_config(arguments.config, read, "docs/reference/onboard.md");
  bool are_sound = true;
  if (arguments.only.empty()) {
    if (found.sees) are_sound &= is_sound(perceive, arguments.config);
    if (found.shows) are_sound &= is_sound(stream, arguments.config);
  }
  if (!config) return host::refuse(config.error());
  if (!are_sound) return host::exit_usage;
  if (arguments.only.empty()) return supervise(*std::move(config), arguments.config);
  OwnProcess process(arguments.only, *std::move(config));
  return process.run();
}

}  // namespace

void add_onboard(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<OnboardArguments>();
  auto* verb = begin_verb(program, "onboard");
  verb->add_option("--config", arguments->config, "TOML file with the vehicle's processes")->required();
  verb->add_option("--only", arguments->only, "Be this one process, without the others and without being watched")
      ->check(CLI::IsMember({std::string(bridge_process), std::string(decide_process)}));
  verb->callback([arguments, &exit_code] { exit_code = start_onboard(*arguments); });
}

}  // namespace lapwing::apps
