#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "apps/onboard/stream_config.hpp"
#include "apps/stream/picture_relay.hpp"
#include "apps/stream/video_config.hpp"
#include "apps/stream/whep_routes.hpp"
#include "apps/verb.hpp"
#include "base/log.hpp"
#include "host/files/config_file.hpp"
#include "host/files/files.hpp"
#include "host/session/signals.hpp"
#include "onboard/life/life_line.hpp"
#include "station/http/http_server.hpp"

namespace lapwing::apps {

namespace {

struct StreamArguments {
  std::string config;
  bool only_checks = false;
};

/// What video goes out by. Whoever offers himself over HTTP goes before what he offers himself to.
struct Servers {
  std::unique_ptr<video::RtspServer> rtsp = {};
  std::unique_ptr<video::WebRtcServer> webrtc = {};
  std::unique_ptr<station::HttpServer> whep = {};
};

base::Result<> open_rtsp(base::Loop& loop, video::RtspSettings const& settings, base::Logger const& log,
                         Servers& servers) {
  auto const paths = relayed_paths();
  auto server = video::RtspServer::open(loop, settings, paths);
  if (!server) return std::unexpected(server.error());
  servers.rtsp = *std::move(server);
  for (auto const& path : paths) log.info(fmt::format("rtsp://{}:{}{}", settings.address, servers.rtsp->port(), path));
  return {};
}

base::Result<> open_webrtc(base::Loop& loop, WebRtcConfig const& config, std::string const& token,
                           base::Logger const& log, Servers& servers) {
  auto server = video::WebRtcServer::open(loop, config.settings, relayed_views.size());
  if (!server) return std::unexpected(server.error());
  servers.webrtc = *std::move(server);
  constexpr std::size_t most_connections = 64;
  auto whep = station::HttpServer::open(loop,
                                        {.address = config.settings.address,
                                         .port = config.port,
                                         .token = token,
                                         .max_connections = most_connections,
                                         .max_sessions = 0,
                                         .max_body_bytes = video::largest_offer},
                                        log);
  if (!whep) return std::unexpected(whep.error());
  servers.whep = *std::move(whep);
  servers.whep->set_router(whep_routes(*servers.webrtc, view_names(), log));
  log.info(fmt::format("WebRTC for browsers: {}api/v1/whep/", servers.whep->url()));
  return {};
}

int stream_until_stopped(VideoConfig config) {
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
    config.pictures.token = *std::move(token);
  }
  auto const& token = config.pictures.token;
  if (config.rtsp) config.rtsp->token = token;
  Servers servers;
  base::Result<> opened;
  if (config.rtsp) opened = open_rtsp(loop, *config.rtsp, log, servers);
  if (opened && config.webrtc) opened = open_webrtc(loop, *config.webrtc, token, log, servers);
  if (!opened) return host::refuse(opened.error());
  PictureRelay const relay(loop, {.rtsp = servers.rtsp.get(), .webrtc = servers.webrtc.get()}, config.pictures, log);
  host::StopSignals const signals(loop, [&loop] { loop.stop(); });
  loop.run();
  return host::exit_done;
}

int start_stream(StreamArguments const& arguments) {
  auto config = host::load_config(arguments.config, read_video_config, "docs/reference/onboard.md");
  if (!config) return host::refuse(config.error());
  return arguments.only_checks ? host::exit_done : stream_until_stopped(*std::move(config));
}

}  // namespace

void add_stream(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<StreamArguments>();
  auto* verb = begin_verb(program, "stream");
  verb->add_option("--config", arguments->config, "TOML file with the vehicle's [stream], [rtsp] and [webrtc]")
      ->required();
  verb->add_flag("--check", arguments->only_checks, "Say what is wrong with the file, and do nothing");
  verb->callback([arguments, &exit_code] { exit_code = start_stream(*arguments); });
}

}  // namespace lapwing::apps
