#include "station/station.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "base/flood_gate.hpp"
#include "base/open_metrics.hpp"
#include "station/http/openapi.hpp"
#include "station/operator/control_routes.hpp"
#include "station/operator/parameter_routes.hpp"
#include "station/operator/script_folder.hpp"

namespace lapwing::station {
namespace {

HttpServer::Message shared(std::string text) {
  return std::make_shared<std::string const>(std::move(text));
}

HttpResponse start_failure(StartFailure const& failure) {
  int const status = failure.error.kind == base::ErrorKind::refused ? 409 : 422;
  return {status, "application/problem+json", start_failure_body(status, reason_phrase(status), failure), {}};
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
      history_(std::make_shared<LogHistory>(options_.log_history)),
      feed_(vehicles),
      server_(std::move(server)) {
  hub.add_sink(base::without_floods([weak = std::weak_ptr(history_)](base::LogRecord const& record) {
    if (auto const history = weak.lock()) history->add(record);
  }));
  server_->set_router(make_router());
  server_->set_websocket({
      .opened = [this](SessionId session) { open_session(session); },
      .received = [this](SessionId session, std::string_view text) { receive(session, text); },
      .closed = [this](SessionId session) { close_session(session); },
  });
  server_->every(options_.period, [this] { send_news(); });
  watch_ = watch_membership();
  watch_.start();
}

/// Who waits for a vehicle sees it at once. What comes within a moment goes together: a fleet that is switched on.
base::Task<> Station::watch_membership() {
  constexpr auto moment = std::chrono::milliseconds(20);
  for (;;) {
    co_await vehicles_.membership_changed().wait();
    co_await loop_.sleep(moment);
    send_news();
  }
}

// ---- to the viewers

void Station::send_news() {
  auto const messages = news();
  for (auto& [session, viewer] : viewers_) {
    if (viewer.is_behind && server_->backlog_bytes(session) > 0) continue;
    viewer.is_behind = !server_->send(session, viewer.is_behind ? whole_state(viewer.name) : messages);
  }
}

std::vector<Station::Message> Station::news() {
  std::vector<Message> messages;
  for (auto& text : feed_.news(loop_.now())) messages.push_back(shared(std::move(text)));
  auto const add_if_changed = [&](std::string& last, std::string text) {
    if (text == last) return;
    last = text;
    messages.push_back(shared(std::move(text)));
  };
  add_if_changed(last_script_, script_message(script_.status()));
  add_if_changed(last_tasks_, tasks_message(script_.task_trees()));
  auto const lines = history_->after(std::exchange(last_log_, history_->last_sequence()));
  if (!lines.empty()) messages.push_back(shared(log_message(lines)));
  if (auto const* control = options_.control; control && control->revision() != last_control_) {
    last_control_ = control->revision();
    messages.push_back(shared(emergency_message(control->emergency())));
    messages.push_back(shared(commands_message(control->commands())));
  }
  if (auto const* alarms = options_.alarms; alarms && alarms->revision() != last_alarms_) {
    last_alarms_ = alarms->revision();
    messages.push_back(shared(alarms_message(alarms, loop_.now())));
  }
  return messages;
}

std::vector<Station::Message> Station::whole_state(std::string const& commander) const {
  std::vector<Message> messages{shared(hello_message(hello(commander)))};
  for (auto& text : feed_.snapshot(loop_.now())) messages.push_back(shared(std::move(text)));
  messages.push_back(shared(script_message(script_.status())));
  messages.push_back(shared(tasks_message(script_.task_trees())));
  messages.push_back(shared(log_message(history_->after(0))));
  if (auto const* control = options_.control) {
    messages.push_back(shared(emergency_message(control->emergency())));
    messages.push_back(shared(commands_message(control->commands())));
  }
  messages.push_back(shared(alarms_message(options_.alarms, loop_.now())));
  return messages;
}

// ---- from the viewers

void Station::open_session(SessionId session) {
  auto& viewer = viewers_[session];
  if (options_.control) viewer.name = fmt::format("operator {}", ++sessions_);
  viewer.is_behind = !server_->send(session, whole_state(viewer.name));
}

/// Whoever closes the page cannot be asked any more.
void Station::close_session(SessionId session) {
  auto const viewer = viewers_.extract(session);
  if (options_.control && !viewer.empty()) options_.control->forget(viewer.mapped().name);
}

void Station::obey_viewer(SessionId session, std::string const& request_id, ControlRequest request) {
  auto const done = obey(options_.control, std::move(request), viewers_[session].name);
  if (!done) return reply(session, refused_message(request_id, {done.error(), {}}));
  reply(session, accepted_message(request_id));
}

void Station::acknowledge(SessionId session, std::string const& request_id, AcknowledgeAlarms const& request) {
  auto const& name = viewers_[session].name;
  if (options_.alarms) (void)options_.alarms->acknowledge(request.numbers, name.empty() ? "a viewer" : name);
  reply(session, accepted_message(request_id));
}

void Station::receive(SessionId session, std::string_view text) {
  auto request = parse_client_request(text);
  if (!request) return reply(session, refused_message("", {request.error(), {}}));
  if (std::holds_alternative<Ping>(request->what)) return reply(session, pong_message(request->id, loop_.utc_now()));
  if (auto* const control = std::get_if<ControlRequest>(&request->what)) {
    control->by.clear();  // a viewer has its name
    return obey_viewer(session, request->id, std::move(*control));
  }
  if (auto const* const acknowledged = std::get_if<AcknowledgeAlarms>(&request->what))
    return acknowledge(session, request->id, *acknowledged);
  if (auto* const start = std::get_if<StartScript>(&request->what)) {
    log_.info(fmt::format("start asked for by a viewer script={}", start->name));
    auto const started = script_.start(std::move(start->name), std::move(start->source));
    if (!started) return reply(session, refused_message(request->id, started.error()));
  } else {
    auto const& name = viewers_[session].name;
    auto by = name.empty() ? std::string("a viewer") : name;
    log_.warn(fmt::format("stop asked for by {}", by));
    script_.stop(std::move(by));
  }
  reply(session, accepted_message(request->id));
}

/// A viewer that cannot take the answer sees the outcome in the whole state that it gets next.
void Station::reply(SessionId session, std::string text) {
  auto const viewer = viewers_.find(session);
  if (viewer == viewers_.end()) return;
  if (!server_->send(session, std::array{shared(std::move(text))})) viewer->second.is_behind = true;
}

// ---- HTTP

Router Station::make_router() {
  Router router;
  router.add("GET", "/api/v1/status", [this](auto const&) { return get_status(); });
  router.add("GET", "/api/v1/vehicles",
             [this](auto const&) { return HttpResponse{.body = feed_.vehicles_message(loop_.now())}; });
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
  add_parameter_routes(router, options_.parameters);
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
  return {options_.program_version, options_.site, loop_.utc_now(), std::move(commander)};
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
  auto asked = parse_start_script(request.body);
  if (!asked) return problem(400, asked.error().message, asked.error().hint);
  log_.info(fmt::format("start asked for over HTTP script={}", asked->name));
  auto const started = script_.start(std::move(asked->name), std::move(asked->source));
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
