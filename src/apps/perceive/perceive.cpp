#include "perceive/perceive.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core/utility.hpp>

#include "apps/onboard/stream_config.hpp"
#include "apps/perceive/car_network.hpp"
#include "apps/perceive/perceive_config.hpp"
#include "apps/verb.hpp"
#include "base/log.hpp"
#include "host/files/config_file.hpp"
#include "host/files/files.hpp"
#include "host/session/signals.hpp"
#include "onboard/life/life_line.hpp"

namespace lapwing::apps {

namespace {

struct PerceiveArguments {
  std::string config;
  bool only_checks = false;
};

int perceive_until_stopped(PerceiveConfig config) {
  base::LogHub hub;
  hub.add_sink(base::standard_error_sink(base::LogLevel::info));
  base::Logger const log(hub, "perceive");
  // One picture after the other: threads within one would only take time from the programs that fly.
  cv::setNumThreads(1);
  base::Loop loop;
  std::unique_ptr<bus::Bus> bus;
  std::unique_ptr<perceive::Perceive> process;
  auto const stop = [&] { process ? process->leave([&loop] { loop.stop(); }) : loop.stop(); };
  std::optional<onboard::LifeLine> life;
  if (auto end = onboard::LifeLine::from_environment())
    life.emplace(loop, *std::move(end), [&] {
      log.warn("the supervisor has gone");
      stop();
    });
  if (!config.stream_token_file.empty()) {
    auto token = stream_token(config.stream_token_file);
    if (!token) return host::refuse(token.error());
    config.perceive.stream->token = *std::move(token);
  }
  config.bus.name = "lapwing-perceive";
  auto opened = bus::Bus::open(loop, config.bus);
  if (!opened) return host::refuse(opened.error());
  bus = *std::move(opened);
  config.perceive.network = car_network(log);
  auto perceive = perceive::Perceive::open(loop, *bus, std::move(config.perceive), log);
  if (!perceive) return host::refuse(perceive.error());
  process = *std::move(perceive);
  host::StopSignals const signals(loop, stop);
  loop.run();
  return host::exit_done;
}

int start_perceive(PerceiveArguments const& arguments) {
  auto config = host::load_config(arguments.config, read_perceive_config, "docs/reference/onboard.md");
  if (!config) return host::refuse(config.error());
  return arguments.only_checks ? host::exit_done : perceive_until_stopped(*std::move(config));
}

}  // namespace

void add_perceive(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<PerceiveArguments>();
  auto* verb = begin_verb(program, "perceive");
  verb->add_option("--config", arguments->config, "TOML file with the vehicle's camera and survey")->required();
  verb->add_flag("--check", arguments->only_checks, "Say what is wrong with the file, and do nothing");
  verb->callback([arguments, &exit_code] { exit_code = start_perceive(*arguments); });
}

}  // namespace lapwing::apps
