#include <array>
#include <memory>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "base/log.hpp"
#include "host/files/config_file.hpp"
#include "host/session/signals.hpp"
#include "route/config.hpp"
#include "route/metrics.hpp"
#include "station/http/http_server.hpp"

namespace lapwing::apps {

namespace {

struct RouteArguments {
  std::string config;
  std::vector<std::string> endpoints;
  std::optional<int> metrics_port;
};

base::Result<route::RouterConfig> settings_of(RouteArguments const& arguments) {
  base::Result<route::RouterConfig> config;
  if (!arguments.config.empty())
    config = host::load_config(arguments.config, route::read_router_config, "docs/reference/router-config.md");
  if (!config) return config;
  for (auto const& text : arguments.endpoints) {
    auto url = link::parse_url(text);
    if (!url) return std::unexpected(url.error());
    config->endpoints.push_back({.url = *std::move(url)});
  }
  if (arguments.metrics_port) config->metrics_port = arguments.metrics_port;
  if (config->endpoints.empty())
    return base::fail(
        base::ErrorKind::invalid_input, "a router needs endpoints",
        "lapwing route --endpoint udpin://0.0.0.0:14550 --endpoint udpout://127.0.0.1:14551, or --config FILE");
  return config;
}

/// A router and its page of metrics for as long as the program runs, whatever settings it has in between.
class RouterProgram {
 public:
  explicit RouterProgram(RouteArguments arguments) : arguments_(std::move(arguments)) {
    hub_.add_sink(base::standard_error_sink(base::LogLevel::info));
  }

  base::Result<> open() {
    auto config = settings_of(arguments_);
    if (!config) return std::unexpected(config.error());
    config_ = *std::move(config);
    if (auto opened = start_router(); !opened) return opened;
    return config_.metrics_port ? serve_metrics(*config_.metrics_port) : base::Result<>();
  }

  void run() {
    host::StopSignals const stop(loop_, [this] { loop_.stop(); });
    host::ReloadSignal const reload(loop_, [this] { this->reload(); });
    loop_.run();
  }

 private:
  base::Result<> start_router() {
    router_.reset();  // its ports are free again
    router_ = std::make_unique<route::Router>(loop_, config_.options, log_);
    return router_->open(config_.endpoints);
  }

  base::Result<> serve_metrics(int port) {
    auto server = station::HttpServer::open(loop_, {.port = port}, log_);
    if (!server) return std::unexpected(server.error());
    server_ = *std::move(server);
    station::Router pages;
    pages.add("GET", "/metrics", [this](auto const&) {
      base::OpenMetrics metrics;
      route::write_metrics(std::array<route::Router const*, 1>{router_.get()}, metrics);
      return station::HttpResponse{.content_type = std::string(base::OpenMetrics::content_type),
                                   .body = metrics.text()};
    });
    server_->set_router(std::move(pages));
    fmt::print(stderr, "metrics at {}metrics\n", server_->url());
    return {};
  }

  /// Routes go on as they were when the new settings are no good.
  void reload() {
    auto fresh = settings_of(arguments_);
    if (!fresh) {
      host::print_error(fresh.error());
      return log_.warn("the settings stay as they were");
    }
    auto const before = std::exchange(config_, *std::move(fresh));
    if (auto started = start_router(); !started) {
      host::print_error(started.error());
      config_ = before;
      log_.warn("the settings stay as they were");
      if (auto again = start_router(); !again) host::print_error(again.error());
      return;
    }
    log_.info(fmt::format("settings read anew, {} endpoints", config_.endpoints.size()));
  }

  RouteArguments arguments_;
  base::LogHub hub_;
  base::Logger log_{hub_, "router"};
  base::Loop loop_;
  route::RouterConfig config_;
  std::unique_ptr<route::Router> router_;
  std::unique_ptr<station::HttpServer> server_;
};

int route_packets(RouteArguments const& arguments) {
  RouterProgram program(arguments);
  if (auto opened = program.open(); !opened) return host::refuse(opened.error());
  fmt::print(stderr, "routing; Ctrl-C ends\n");
  program.run();
  return host::exit_done;
}

}  // namespace

void add_route(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<RouteArguments>();
  auto* verb = begin_verb(program, "route");
  verb->add_option("--config", arguments->config, "TOML file with the endpoints; read again on SIGHUP");
  verb->add_option("--endpoint", arguments->endpoints,
                   "One more endpoint, e.g. udpin://0.0.0.0:14550 (may be repeated)")
      ->allow_extra_args(false);
  verb->add_option("--metrics-port", arguments->metrics_port,
                   "Serve http://127.0.0.1:PORT/metrics (OpenMetrics); 0 picks a free port")
      ->check(CLI::Range(0, 65535));
  verb->callback([arguments, &exit_code] { exit_code = route_packets(*arguments); });
}

}  // namespace lapwing::apps
