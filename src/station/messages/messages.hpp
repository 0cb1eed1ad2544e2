#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/log.hpp"
#include "geo/position.hpp"
#include "station/operator/script_control.hpp"
#include "tasks/task_view.hpp"

/// The JSON that the station speaks over WebSocket and HTTP, protocol 1; client_request.hpp reads what it is asked.
/// docs/reference/station-messages.md describes it for programs; it changes only by addition as long as the number
/// stays.
///
/// SI units and radians, as everywhere; only latitude and longitude are in degrees. A unit is in every key that has
/// one. Every function returns one complete message.
namespace lapwing::station {

inline constexpr int protocol_version = 1;

/// Where the station stands, for a map that has no vehicle to look at yet.
struct Site {
  std::string name;
  std::optional<geo::Wgs84> origin;
  std::string tiles = {};  ///< XYZ address of its base map, for browsers that have chosen none; may be empty
};

/// A log line with its place in the station's history, by which a client that connects again leaves out what it has.
struct LogLine {
  std::uint64_t sequence = 0;
  base::LogRecord record;
};

/// What a viewer may subscribe to.
struct FeedList {
  struct Entry {
    std::string name;
    std::uint16_t id = 0;  ///< in binary messages
    bool is_usual = true;  ///< sent to who has not subscribed
  };
  std::string run;  ///< revisions mean something within one run of the station only
  std::vector<Entry> feeds;
};

struct Hello {
  std::string program_version;
  Site site;
  base::UtcTime server_time{};
  std::string commander = {};  ///< what this viewer is called where it commands vehicles; empty over HTTP
  FeedList feeds = {};         ///< none over HTTP
  /// Of a station that has no present: which session viewers look back at, playing. Empty: it has.
  std::string looks_back = {};
};

// ---- over WebSocket
[[nodiscard]] std::string hello_message(Hello const& hello);
[[nodiscard]] std::string script_message(ScriptStatus const& status);
[[nodiscard]] std::string tasks_message(std::span<tasks::TaskView const> trees);
[[nodiscard]] std::string log_message(std::span<LogLine const> lines);
[[nodiscard]] std::string pong_message(std::string_view request_id, base::UtcTime server_time);
/// Answers the request of that id: it was carried out.
[[nodiscard]] std::string accepted_message(std::string_view request_id);
/// Answers the request of that id: it was not, and why.
[[nodiscard]] std::string refused_message(std::string_view request_id, StartFailure const& failure);

// ---- bodies of HTTP answers
struct StationStatus {
  Hello hello;
  ScriptState script = ScriptState::idle;
  std::string script_name;
  int vehicles = 0;
  int viewers = 0;
  double uptime_s = 0.0;
};
[[nodiscard]] std::string status_body(StationStatus const& status);
[[nodiscard]] std::string scripts_body(std::span<std::string const> names);
/// What `POST /api/v1/script` takes.
[[nodiscard]] std::string script_text_body(std::string_view name, std::string_view source);
/// `application/problem+json` with the diagnostics beside the usual members.
[[nodiscard]] std::string start_failure_body(int http_status, std::string_view title, StartFailure const& failure);

}  // namespace lapwing::station
