#include "station/messages/messages.hpp"

#include "base/text/utc_text.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {
namespace {

using base::to_iso8601;

Json to_json(std::vector<base::DiagnosticRecord> const& records);

Json to_json(base::DiagnosticRecord const& record) {
  Json json{{"severity", record.severity},   {"file", record.file},         {"line", record.begin.line},
            {"column", record.begin.column}, {"end_line", record.end.line}, {"end_column", record.end.column},
            {"message", record.message}};
  if (!record.code.empty()) json["code"] = record.code;
  if (!record.hint.empty()) json["hint"] = record.hint;
  if (!record.notes.empty()) json["notes"] = to_json(record.notes);
  return json;
}

Json to_json(std::vector<base::DiagnosticRecord> const& records) {
  Json list = Json::array();
  for (auto const& record : records) list.push_back(to_json(record));
  return list;
}

Json to_json(tasks::TaskView const& task) {
  Json children = Json::array();
  for (auto const& child : task.children) children.push_back(to_json(child));
  Json json{{"id", task.id},
            {"kind", task.kind},
            {"label", task.label},
            {"line", task.line},
            {"state", tasks::to_string(task.state)}};
  if (task.vehicle) json["vehicle"] = task.vehicle->text;
  if (!task.detail.empty()) json["detail"] = task.detail;
  if (!children.empty()) json["children"] = std::move(children);
  return json;
}

void add_hello(Json& json, Hello const& hello) {
  json["protocol"] = protocol_version;
  json["version"] = hello.program_version;
  json["server_time"] = to_iso8601(hello.server_time);
  json["site"] = {{"name", hello.site.name}};
  if (hello.site.origin) json["site"]["origin"] = position_json(*hello.site.origin);
  if (!hello.site.tiles.empty()) json["site"]["tiles"] = hello.site.tiles;
  if (!hello.looks_back.empty()) json["looks_back"] = {{"session", hello.looks_back}};
}

Json reply(std::string_view request_id, bool ok) {
  return {{"type", "reply"}, {"id", request_id}, {"ok", ok}};
}

}  // namespace

std::string hello_message(Hello const& hello) {
  Json json{{"type", "hello"}};
  add_hello(json, hello);
  if (!hello.commander.empty()) json["operator"] = hello.commander;
  if (hello.feeds.feeds.empty()) return dump(json);
  json["run"] = hello.feeds.run;
  for (auto const& feed : hello.feeds.feeds)
    json["feeds"].push_back({{"name", feed.name}, {"id", feed.id}, {"usual", feed.is_usual}});
  return dump(json);
}

std::string script_message(ScriptStatus const& status) {
  return dump({{"type", "script"},
               {"name", status.name},
               {"state", to_string(status.state)},
               {"message", status.message},
               {"source", status.source},
               {"diagnostics", to_json(status.diagnostics)}});
}

std::string tasks_message(std::span<tasks::TaskView const> trees) {
  Json list = Json::array();
  for (auto const& tree : trees) list.push_back(to_json(tree));
  return dump({{"type", "tasks"}, {"trees", std::move(list)}});
}

std::string log_message(std::span<LogLine const> lines) {
  Json list = Json::array();
  for (auto const& line : lines) {
    list.push_back({{"seq", line.sequence},
                    {"time", to_iso8601(line.record.utc)},
                    {"level", base::to_string(line.record.level)},
                    {"source", line.record.source},
                    {"text", line.record.text}});
  }
  return dump({{"type", "log"}, {"lines", std::move(list)}});
}

std::string pong_message(std::string_view request_id, base::UtcTime server_time) {
  return dump({{"type", "pong"}, {"id", request_id}, {"server_time", to_iso8601(server_time)}});
}

std::string accepted_message(std::string_view request_id) {
  return dump(reply(request_id, true));
}

std::string refused_message(std::string_view request_id, StartFailure const& failure) {
  auto json = reply(request_id, false);
  json["error"] = {{"message", failure.error.message}, {"hint", failure.error.hint}};
  json["diagnostics"] = to_json(failure.diagnostics);
  return dump(json);
}

std::string status_body(StationStatus const& status) {
  Json json = Json::object();
  add_hello(json, status.hello);
  json["uptime_s"] = rounded(status.uptime_s, 1);
  json["vehicles"] = status.vehicles;
  json["viewers"] = status.viewers;
  json["script"] = {{"name", status.script_name}, {"state", to_string(status.script)}};
  return dump(json);
}

std::string scripts_body(std::span<std::string const> names) {
  Json json{{"scripts", Json::array()}};
  for (auto const& name : names) json["scripts"].push_back({{"name", name}});
  return dump(json);
}

std::string script_text_body(std::string_view name, std::string_view source) {
  return dump({{"name", name}, {"source", source}});
}

std::string start_failure_body(int http_status, std::string_view title, StartFailure const& failure) {
  Json json{{"title", title}, {"status", http_status}, {"detail", failure.error.message}};
  if (!failure.error.hint.empty()) json["hint"] = failure.error.hint;
  json["diagnostics"] = to_json(failure.diagnostics);
  return dump(json);
}

}  // namespace lapwing::station
