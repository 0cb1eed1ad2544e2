#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "station/http/http_server.hpp"
#include "station/messages/log_history.hpp"
#include "station/messages/messages.hpp"
#include "station/messages/vehicle_feed.hpp"
#include "station/operator/script_control.hpp"
#include "vehicle/alarm.hpp"
#include "vehicle/control.hpp"
#include "vehicle/parameters.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::station {

/// The ground station's face: joins vehicles, script and log to browsers and programs. Owns none of them.
///
/// Several times a second, and at once when a vehicle appears, is lost or returns, it sends every viewer what changed.
/// A viewer too slow to take it misses messages and is sent the whole state once it has caught up, so that a bad
/// network shows old data for a while but never wrong data.
class Station {
 public:
  struct Options {
    HttpServer::Options http = {};
    std::chrono::milliseconds period{200};  ///< between two messages about vehicles: 5 Hz, in wall time
    std::size_t log_history = 500;          ///< lines kept for viewers that connect later
    std::string program_version = "0";
    Site site = {};
    std::filesystem::path scripts = {};                ///< folder of scripts that viewers may choose from; empty: none
    vehicle::VehicleControl* control = nullptr;        ///< outlives the station; null: vehicles are only shown
    vehicle::VehicleAlarms* alarms = nullptr;          ///< outlives the station; null: there are none
    vehicle::VehicleParameters* parameters = nullptr;  ///< outlives the station; null: nobody can ask for them
    std::function<std::string()> metrics = {};         ///< what /metrics shows, as OpenMetrics; empty: it shows nothing
  };

  /// Listens at once. `vehicles`, `script` and `loop` must outlive the station; `hub` may go first or last.
  [[nodiscard]] static base::Result<std::unique_ptr<Station>> open(base::Loop& loop, vehicle::Registry const& vehicles,
                                                                   ScriptControl& script, base::LogHub& hub,
                                                                   Options options);

  [[nodiscard]] std::string url() const { return server_->url(); }
  [[nodiscard]] int port() const { return server_->port(); }
  /// Browsers and programs connected by WebSocket.
  [[nodiscard]] std::size_t viewers() const { return viewers_.size(); }

  /// The HTTP API, for comparison with its description.
  [[nodiscard]] Router make_router();

 private:
  using Message = HttpServer::Message;

  Station(base::Loop& loop, vehicle::Registry const& vehicles, ScriptControl& script, base::LogHub& hub,
          Options options, std::unique_ptr<HttpServer> server);

  void send_news();
  [[nodiscard]] base::Task<> watch_membership();
  [[nodiscard]] std::vector<Message> news();
  [[nodiscard]] std::vector<Message> whole_state(std::string const& commander) const;
  void open_session(SessionId session);
  void close_session(SessionId session);
  void obey_viewer(SessionId session, std::string const& request_id, ControlRequest request);
  void acknowledge(SessionId session, std::string const& request_id, AcknowledgeAlarms const& request);
  void receive(SessionId session, std::string_view text);
  void reply(SessionId session, std::string text);

  [[nodiscard]] Hello hello(std::string commander = {}) const;
  [[nodiscard]] HttpResponse get_status() const;
  [[nodiscard]] HttpResponse post_script(HttpRequest const& request);
  [[nodiscard]] HttpResponse post_stop();
  [[nodiscard]] HttpResponse get_script_text(HttpRequest const& request) const;
  [[nodiscard]] HttpResponse get_log(HttpRequest const& request) const;

  base::Loop& loop_;
  vehicle::Registry const& vehicles_;
  ScriptControl& script_;
  Options options_;
  base::Logger log_;
  std::shared_ptr<LogHistory> history_;  // shared with the hub's sink, which may outlive the station
  VehicleFeed feed_;
  std::string last_script_;
  std::string last_tasks_;
  std::uint64_t last_log_ = 0;
  std::uint64_t last_control_ = 0;
  std::uint64_t last_alarms_ = 0;
  int sessions_ = 0;  ///< ever opened: numbers the operators
  struct Viewer {
    vehicle::Commander name = {};  ///< "operator 3", where it commands vehicles
    bool is_behind = false;        ///< missed something: gets the whole state when its backlog is gone
  };
  std::map<SessionId, Viewer> viewers_;
  base::Task<> watch_;
  std::unique_ptr<HttpServer> server_;  // last: ends first, so that no call-back finds half a station
};

}  // namespace lapwing::station
