#include "station/station.hpp"

#include <charconv>
#include <span>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/open_metrics.hpp"
#include "station/basemaps/base_map_routes.hpp"
#include "station/exports/export_routes.hpp"
#include "station/feeds/alarms_feed.hpp"
#include "station/feeds/control_feed.hpp"
#include "station/feeds/health_feed.hpp"
#include "station/feeds/log_feed.hpp"
#include "station/feeds/pictures_feed.hpp"
#include "station/feeds/plans_feed.hpp"
#include "station/feeds/script_feed.hpp"
#include "station/feeds/survey_feed.hpp"
#include "station/feeds/tasks_feed.hpp"
#include "station/feeds/vehicles_feed.hpp"
#include "station/http/openapi.hpp"
#include "station/messages/alarm_messages.hpp"
#include "station/messages/control_messages.hpp"
#include "station/messages/health_messages.hpp"
#include "station/operator/control_routes.hpp"
#include "station/operator/parameter_routes.hpp"
#include "station/operator/script_folder.hpp"
#include "station/past/history_routes.hpp"

namespace lapwing::station {
namespace {

/// What a station shows without being told more, in the order in which a newcomer gets it.
std::vector<std::unique_ptr<Feed>> usual_feeds(vehicle::Registry const& vehicles, ScriptControl const& script,
                                               std::shared_ptr<LogHistory const> log, Station::Options const& options) {
  std::vector<std::unique_ptr<Feed>> feeds;
  feeds.push_back(std::make_unique<VehiclesFeed>(vehicles));
  feeds.push_back(std::make_unique<PlansFeed>(vehicles));
  feeds.push_back(std::make_unique<PicturesFeed>(vehicles));
  feeds.push_back(std::make_unique<ScriptFeed>(script));
  feeds.push_back(std::make_unique<TasksFeed>(script));
  feeds.push_back(std::make_unique<LogFeed>(std::move(log)));
  if (options.control) feeds.push_back(std::make_unique<ControlFeed>(*options.control));
  feeds.push_back(std::make_unique<AlarmsFeed>(options.alarms));
  return feeds;
}

HttpResponse start_failure(StartFailure const& failure) {
  int const status = failure.error.kind == base::ErrorKind::refused ? 409 : 422;
  return {status, "application/problem+json", start_failure_body(status, reason_phrase(status), failure), {}};
}

/// What a station shows to those who ask for it.
std::vector<std::unique_ptr<Feed>> further_feeds(MapFace const& map, vehicle::VehicleModules const* modules,
                                                 vehicle::SurveyDrones const* survey,
                                                 std::vector<std::unique_ptr<Feed>> of_others) {
  auto feeds = map.feeds();
  if (modules) feeds.push_back(std::make_unique<HealthFeed>(*modules));
  if (survey) feeds.push_back(std::make_unique<SurveyFeed>(*survey));
  for (auto& feed : of_others) feeds.push_back(std::move(feed));
  return feeds;
}

}  // namespace

base::Result<std::unique_ptr<Station>> Station::open(base::Loop& loop, vehicle::Registry const& vehicles,
                                                     ScriptControl& script, base::LogHub& hub, Options options) {
  auto server = HttpServer::open(loop, options.http, base::Logger(hub, "station"));
  if (!server) return std::unexpected(server.error());
  return std::unique_ptr<Station>(new Station(loop, vehicles, script, hub, std::move(options), std::move(*server)));
}

Station::Station(base::Loop& loop, vehicle::Registry const& vehicles, ScriptControl& script, base::LogHub& hub,
                 Options options, std::unique_ptr<HttpServer> server)
    : loop_(loop),
      vehicles_(vehicles),
      script_(script),
      options_(std::move(options)),
      log_(hub, "station"),
      history_(keep_log(hub, options_.log_history)),
      own_map_(options_.map ? nullptr : std::make_unique<map::LiveMap>([&loop] { return loop.utc_now(); })),
      map_face_(loop, options_.map ? *options_.map : *own_map_, options_.store),
      exports_(options_.exporter ? std::make_unique<ExportJobs>(loop, *options_.exporter) : nullptr),
      viewers_(loop, *server, usual_feeds(vehicles, script, history_, options_),
               further_feeds(map_face_, options_.modules, options_.survey, std::move(options_.feeds))),
      work_(loop),
      server_(std::move(server)) {
  server_->set_router(make_router());
  server_->set_websocket({
      .opened = [this](SessionId session, HttpRequest const& request) { open_session(session, request); },
      .received = [this](SessionId session, std::string_view text) { receive(session, text); },
      .drained = [this](SessionId session) { viewers_.go_on(session); },
      .closed = [this](SessionId session) { close_session(session); },
  });
  server_->every(options_.period, [this] { viewers_.send_news(); });
  server_->every(options_.map_period, [this] { show_map_news(); });
  if (options_.store && options_.looks_back.empty()) {
    if (!options_.site.name.empty()) options_.store->name_session(viewers_.run(), options_.site.name);
    recorder_ = std::make_unique<Recorder>(loop, viewers_.all_feeds(), *options_.store,
                                           Recorder::Options{.session = viewers_.run()});
    work_.spawn(record_always());
    work_.spawn(record_grids_always());
  }
  work_.spawn(watch_membership());
}

base::Task<> Station::record_always() {
  for (;;) {
    co_await loop_.sleep(options_.record_period);
    recorder_->keep();
  }
}

base::Task<> Station::record_grids_always() {
  for (;;) {
    co_await loop_.sleep(options_.record_grids_period);
    co_await recorder_->keep_grids();
  }
}

/// Who waits for a vehicle sees it at once. What comes within a moment goes together: a fleet that is switched on.
base::Task<> Station::watch_membership() {
  constexpr auto moment = std::chrono::milliseconds(20);
  for (;;) {
    co_await vehicles_.membership_changed().wait();
    co_await loop_.sleep(moment);
    viewers_.send_news();
  }
}

/// What takes long to write for everybody comes less often, and with the usual rounds at the latest: most of the loop's
/// time belongs to vehicles.
void Station::show_map_news() {
  constexpr int rests_per_work = 9;
  auto const revision = map_face_.revision();
  auto const begun = std::chrono::steady_clock::now();
  if (revision == shown_map_ || begun < map_rests_until_) return;
  shown_map_ = revision;
  viewers_.send_news(MapFace::feed_group);
  auto const ended = std::chrono::steady_clock::now();
  map_rests_until_ = ended + rests_per_work * (ended - begun);
}

// ---- from the viewers

void Station::open_session(SessionId session, HttpRequest const& request) {
  auto& name = operators_[session];
  if (options_.control) name = fmt::format("operator {}", ++sessions_);
  auto greeting = hello(name);
  greeting.feeds = viewers_.feeds();
  reply(session, hello_message(greeting));
  viewers_.open(session, request.parameter("subscribe").has_value());
}

/// Whoever closes the page cannot be asked any more.
void Station::close_session(SessionId session) {
  viewers_.close(session);
  auto const name = operators_.extract(session);
  if (options_.control && !name.empty()) options_.control->forget(name.mapped());
}

void Station::receive(SessionId session, std::string_view text) {
  auto request = parse_client_request(text);
  if (!request) return reply(session, refused_message("", {request.error(), {}}));
  auto const& id = request->id;
  auto& what = request->what;
  if (std::holds_alternative<Ping>(what)) return reply(session, pong_message(id, loop_.utc_now()));
  if (std::holds_alternative<StopScript>(what)) return stop_script(session, id);
  if (auto* const asked = std::get_if<StartScript>(&what)) return start_script(session, id, std::move(*asked));
  if (auto* const asked = std::get_if<ControlRequest>(&what)) return obey_viewer(session, id, std::move(*asked));
  if (auto const* const asked = std::get_if<Subscribe>(&what)) return subscribe(session, id, *asked);
  acknowledge(session, id, std::get<AcknowledgeAlarms>(what));
}

/// The reply goes before what is subscribed to.
void Station::subscribe(SessionId session, std::string const& request_id, Subscribe const& request) {
  auto const done = viewers_.subscribe(session, request);
  if (!done) return reply(session, refused_message(request_id, {done.error(), {}}));
  reply(session, accepted_message(request_id));
  viewers_.begin(session);
}

void Station::obey_viewer(SessionId session, std::string const& request_id, ControlRequest request) {
  request.by.clear();  // a viewer has its name
  auto const done = obey(options_.control, std::move(request), operators_[session]);
  if (!done) return reply(session, refused_message(request_id, {done.error(), {}}));
  reply(session, accepted_message(request_id));
}

void Station::acknowledge(SessionId session, std::string const& request_id, AcknowledgeAlarms const& request) {
  if (options_.alarms) (void)options_.alarms->acknowledge(request.numbers, name_of(session));
  reply(session, accepted_message(request_id));
}

void Station::start_script(SessionId session, std::string const& request_id, StartScript request) {
  log_.info(fmt::format("start asked for by a viewer script={}", request.name));
  auto const started = script_.start(std::move(request.name), std::move(request.source));
  reply(session, started ? accepted_message(request_id) : refused_message(request_id, started.error()));
}

void Station::stop_script(SessionId session, std::string const& request_id) {
  auto by = name_of(session);
  log_.warn(fmt::format("stop asked for by {}", by));
  script_.stop(std::move(by));
  reply(session, accepted_message(request_id));
}

/// A viewer that cannot take the answer sees the outcome in the feeds.
void Station::reply(SessionId session, std::string text) {
  HttpServer::Message const message{std::make_shared<std::string const>(std::move(text))};
  (void)server_->send(session, std::span(&message, 1));
}

vehicle::Commander Station::name_of(SessionId session) const {
  auto const found = operators_.find(session);
  return found == operators_.end() || found->second.empty() ? "a viewer" : found->second;
}

// ---- HTTP

Router Station::make_router() {
  Router router;
  router.add("GET", "/api/v1/status", [this](auto const&) { return get_status(); });
  router.add("GET", "/api/v1/vehicles",
             [this](auto const&) { return HttpResponse{.body = vehicles_message(vehicles_, loop_.now())}; });
  router.add("GET", "/api/v1/script",
             [this](auto const&) { return HttpResponse{.body = script_message(script_.status())}; });
  router.add("POST", "/api/v1/script", [this](auto const& request) { return post_script(request); });
  router.add("GET", "/api/v1/scripts",
             [this](auto const&) { return HttpResponse{.body = scripts_body(list_scripts(options_.scripts))}; });
  router.add("GET", "/api/v1/scripts/text", [this](auto const& request) { return get_script_text(request); });
  router.add("GET", "/api/v1/tasks",
             [this](auto const&) { return HttpResponse{.body = tasks_message(script_.task_trees())}; });
  router.add("POST", "/api/v1/stop", [this](auto const&) { return post_stop(); });
  add_control_routes(router, options_.control, log_);
  add_alarm_routes(router, options_.alarms, loop_);
  add_health_route(router, options_.modules, loop_);
  add_parameter_routes(router, options_.parameters);
  add_survey_routes(router, options_.survey, log_, [this] { return loop_.utc_now(); });
  map_face_.add_routes(router);
  add_export_routes(router, loop_, options_.map ? *options_.map : *own_map_, exports_.get());
  add_base_map_routes(router, loop_, options_.base_maps);
  add_history_routes(router, options_.store);
  router.add("GET", "/api/v1/log", [this](auto const& request) { return get_log(request); });
  router.add("GET", "/api/openapi.yaml", [](auto const&) {
    return HttpResponse{.content_type = "application/yaml", .body = std::string(openapi_description())};
  });
  router.add("GET", "/metrics", [this](auto const&) {
    return HttpResponse{.content_type = std::string(base::OpenMetrics::content_type),
                        .body = options_.metrics ? options_.metrics() : base::OpenMetrics().text()};
  });
  return router;
}

Hello Station::hello(std::string commander) const {
  return {options_.program_version, options_.site, loop_.utc_now(), std::move(commander), {}, options_.looks_back};
}

HttpResponse Station::get_status() const {
  auto const script = script_.status();
  return {.body = status_body({.hello = hello(),
                               .script = script.state,
                               .script_name = script.name,
                               .vehicles = static_cast<int>(vehicles_.all().size()),
                               .viewers = static_cast<int>(viewers_.size()),
                               .uptime_s = base::to_seconds(loop_.now().time_since_epoch())})};
}

HttpResponse Station::post_script(HttpRequest const& request) {
  auto body = parse_request_body("start_script", request.body);
  if (!body) return problem(body.error());
  auto& asked = std::get<StartScript>(*body);
  log_.info(fmt::format("start asked for over HTTP script={}", asked.name));
  auto const started = script_.start(std::move(asked.name), std::move(asked.source));
  if (!started) return start_failure(started.error());
  return {.status = 202, .body = script_message(script_.status())};
}

HttpResponse Station::get_script_text(HttpRequest const& request) const {
  auto const name = request.parameter("name");
  if (!name) return problem(400, "The parameter \"name\" is missing.", "Give a name from /api/v1/scripts.");
  auto const text = read_script(options_.scripts, *name);
  if (text) return {.body = script_text_body(*name, *text)};
  bool const is_missing = text.error().kind == base::ErrorKind::not_found;
  return problem(is_missing ? 404 : 400, text.error().message, text.error().hint);
}

HttpResponse Station::post_stop() {
  log_.warn("stop asked for over HTTP");
  script_.stop("a program over HTTP");
  return {.status = 202, .body = script_message(script_.status())};
}

HttpResponse Station::get_log(HttpRequest const& request) const {
  std::uint64_t after = 0;
  if (auto const text = request.parameter("after")) {
    auto const [end, error] = std::from_chars(text->data(), text->data() + text->size(), after);
    if (error != std::errc{} || end != text->data() + text->size()) {
      return problem(400, "\"after\" must be the sequence number of a log line.");
    }
  }
  return {.body = log_message(history_->after(after))};
}

}  // namespace lapwing::station
