#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/onboard/stream_config.hpp"
#include "apps/stream/picture_relay.hpp"
#include "apps/stream/rtsp_config.hpp"
#include "apps/verb.hpp"
#include "base/log.hpp"
#include "host/files/config_file.hpp"
#include "host/files/files.hpp"
#include "host/session/signals.hpp"
#include "onboard/life/life_line.hpp"

namespace lapwing::apps {

namespace {

struct StreamArguments {
  std::string config;
  bool only_checks = false;
};

int stream_until_stopped(RtspConfig config) {
  base::LogHub hub;
  hub.add_sink(base::standard_error_sink(base::LogLevel::info));
  base::Logger const log(hub, "stream");
  base::Loop loop;
  std::optional<onboard::LifeLine> life;
  if (auto end = onboard::LifeLine::from_environment())
    life.emplace(loop, *std::move(end), [&] {
      log.warn("the supervisor has gone");
      loop.stop();
    });
  if (!config.token_file.empty()) {
    auto token = stream_token(config.token_file);
    if (!token) return host::refuse(token.error());
    config.rtsp.token = config.pictures.token = *std::move(token);
  }
  auto const paths = relayed_paths();
  auto const server = video::RtspServer::open(loop, config.rtsp, paths);
  if (!server) return host::refuse(server.error());
  for (auto const& path : paths) log.info(fmt::format("rtsp://{}:{}{}", config.rtsp.address, (*server)->port(), path));
  PictureRelay const relay(loop, **server, config.pictures, log);
  host::StopSignals const signals(loop, [&loop] { loop.stop(); });
  loop.run();
  return host::exit_done;
}

int start_stream(StreamArguments const& arguments) {
  auto config = host::load_config(arguments.config, read_rtsp_config, "docs/reference/onboard.md");
  if (!config) return host::refuse(config.error());
  return arguments.only_checks ? host::exit_done : stream_until_stopped(*std::move(config));
}

}  // namespace

void add_stream(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<StreamArguments>();
  auto* verb = begin_verb(program, "stream");
  verb->add_option("--config", arguments->config, "TOML file with the vehicle's [stream] and [rtsp]")->required();
  verb->add_flag("--check", arguments->only_checks, "Say what is wrong with the file, and do nothing");
  verb->callback([arguments, &exit_code] { exit_code = start_stream(*arguments); });
}

}  // namespace lapwing::apps
