#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/scope.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "map/live/live_map.hpp"
#include "map/store/store.hpp"
#include "station/basemaps/base_map.hpp"
#include "station/exports/export_jobs.hpp"
#include "station/feeds/feed.hpp"
#include "station/http/http_server.hpp"
#include "station/map/map_face.hpp"
#include "station/messages/client_request.hpp"
#include "station/messages/log_history.hpp"
#include "station/messages/messages.hpp"
#include "station/operator/script_control.hpp"
#include "station/past/recorder.hpp"
#include "station/viewers.hpp"
#include "vehicle/alarm.hpp"
#include "vehicle/control.hpp"
#include "vehicle/modules.hpp"
#include "vehicle/parameters.hpp"
#include "vehicle/registry.hpp"
#include "vehicle/survey_drones.hpp"

namespace lapwing::station {

/// The ground station's face: joins feeds, and what takes requests, to browsers and programs.
///
/// Several times a second, and at once when a vehicle appears, is lost or returns, it has `Viewers` send everybody what
/// is new in the feeds. It answers what they ask, over WebSocket and HTTP.
class Station {
 public:
  struct Options {
    HttpServer::Options http = {};
    std::chrono::milliseconds period{200};  ///< between two messages about vehicles: 5 Hz, in wall time
    /// Between two looks at whether the map has changed, in wall time: what is written on it is there for viewers
    /// sooner than the next round.
    std::chrono::milliseconds map_period{50};
    std::size_t log_history = 500;  ///< lines kept for viewers that connect later
    std::string program_version = "0";
    Site site = {};
    std::filesystem::path scripts = {};                ///< folder of scripts that viewers may choose from; empty: none
    vehicle::VehicleControl* control = nullptr;        ///< outlives the station; null: vehicles are only shown
    vehicle::VehicleAlarms* alarms = nullptr;          ///< outlives the station; null: there are none
    vehicle::VehicleParameters* parameters = nullptr;  ///< outlives the station; null: nobody can ask for them
    vehicle::VehicleModules const* modules = nullptr;  ///< outlives the station; null: nobody tells of any
    vehicle::SurveyDrones* survey = nullptr;           ///< outlives the station; null: there are none
    map::LiveMap* map = nullptr;                       ///< outlives the station; null: an empty one of its own
    std::function<std::string()> metrics = {};         ///< what /metrics shows, as OpenMetrics; empty: it shows nothing
    std::vector<BaseMap> base_maps = {};               ///< that viewers may choose from
    MapExporter* exporter = nullptr;                   ///< outlives the station; null: nobody writes files of the map
    map::Store* store = nullptr;  ///< outlives the station; keeps pictures and what is shown; null: nothing is kept
    std::string looks_back = {};  ///< a session of the store that is all there is to see; empty: there is a present
    /// Between two looks at what is new, for the store, by the loop's clock: where time runs fast, its past is as fine
    /// as elsewhere. Half a second is what a person who looks back can tell apart; grids are much to look at.
    std::chrono::milliseconds record_period{500};
    std::chrono::milliseconds record_grids_period{1000};
    /// Further things to show, beside vehicles, plans, pictures, script, tasks, log, control, alarms and the map. What
    /// they look at outlives the station.
    std::vector<std::unique_ptr<Feed>> feeds = {};
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
  Station(base::Loop& loop, vehicle::Registry const& vehicles, ScriptControl& script, base::LogHub& hub,
          Options options, std::unique_ptr<HttpServer> server);

  [[nodiscard]] base::Task<> watch_membership();
  [[nodiscard]] base::Task<> record_always();
  [[nodiscard]] base::Task<> record_grids_always();
  void show_map_news();
  void open_session(SessionId session, HttpRequest const& request);
  void close_session(SessionId session);
  void receive(SessionId session, std::string_view text);
  void subscribe(SessionId session, std::string const& request_id, Subscribe const& request);
  void obey_viewer(SessionId session, std::string const& request_id, ControlRequest request);
  void acknowledge(SessionId session, std::string const& request_id, AcknowledgeAlarms const& request);
  void start_script(SessionId session, std::string const& request_id, StartScript request);
  void stop_script(SessionId session, std::string const& request_id);
  void reply(SessionId session, std::string text);
  [[nodiscard]] vehicle::Commander name_of(SessionId session) const;

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
  std::shared_ptr<LogHistory const> history_;
  std::unique_ptr<map::LiveMap> own_map_;
  MapFace map_face_;
  std::unique_ptr<ExportJobs> exports_;  ///< null without an exporter
  map::Revision shown_map_ = 0;          ///< as viewers have it, but for the slow ones
  std::chrono::steady_clock::time_point map_rests_until_{};
  int sessions_ = 0;                                   ///< ever opened: numbers the operators
  std::map<SessionId, vehicle::Commander> operators_;  ///< "operator 3", where vehicles are commanded
  Viewers viewers_;
  std::unique_ptr<Recorder> recorder_;  ///< null without a store
  base::Scope work_;
  std::unique_ptr<HttpServer> server_;  // last: ends first, so that no call-back finds half a station
};

}  // namespace lapwing::station
