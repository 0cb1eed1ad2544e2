#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.hpp"
#include "fleet/actions/vehicle_actions.hpp"
#include "geo/position.hpp"
#include "host/links/equipment.hpp"
#include "host/links/forward.hpp"
#include "host/map/station_map.hpp"
#include "host/station/base_maps.hpp"
#include "host/station/web_access.hpp"
#include "host/survey/survey_link.hpp"
#include "plan/plausibility/settings.hpp"
#include "vehicle/alarm.hpp"
#include "vehicle/control.hpp"

namespace lapwing::host {

/// What the map shows and offers.
struct MapContent {
  std::string site_name = {};
  std::optional<geo::Wgs84> home = {};           ///< what it looks at before a vehicle is heard
  std::string tiles = {};                        ///< XYZ address of a base map; empty: a plain grid
  std::vector<station::BaseMap> base_maps = {};  ///< that viewers may choose from
  StoreSettings store = {};                      ///< where the map and its past are kept
  std::filesystem::path scripts = {};            ///< folder whose scripts it offers; empty: none
  /// In place of `store`: one that is only read, to look back at a session of it. It outlives the map.
  struct Past {
    ::lapwing::map::Store* store = nullptr;
    std::string session = {};
  };
  std::optional<Past> past = {};
};

/// A ground station as its file describes it: docs/reference/station-config.md.
struct StationConfig {
  std::vector<std::string> links;           ///< empty: the default link
  std::vector<std::string> robots = {};     ///< as `--robot` names them
  std::string robot_cameras = {};           ///< file with the cameras of robots; empty: none
  std::vector<std::string> old_parts = {};  ///< as `--old-parts` names them
  std::vector<SurveyLink> survey = {};      ///< survey drones
  Equipment payload;
  fleet::OnStop on_stop = fleet::OnStop::loiter;
  vehicle::StopAction emergency_action = vehicle::StopAction::hold;
  plan::plausibility::Settings plausibility = {};
  std::vector<Forward> forward = {};           ///< other programs that ride along
  std::string signing_key = {};                ///< file; empty: nothing is signed
  std::string record = {};                     ///< folder for recordings; empty: none are made
  vehicle::BatteryLimits battery_limits = {};  ///< of alarms
  WebAccess web;
  MapContent map;
};

/// Reads the file's text; paths in it count from the file's folder. Everything wrong is reported; the result is to be
/// used only when nothing was.
[[nodiscard]] StationConfig read_station_config(base::SourceFile const& source, base::Diagnostics& diagnostics);

}  // namespace lapwing::host
