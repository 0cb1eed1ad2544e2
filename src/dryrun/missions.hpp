#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dryrun/flight_record.hpp"
#include "plan/mission.hpp"

namespace lapwing::dryrun {

/// One item of a mission as people read it.
struct ItemRow {
  int number = 0;                   ///< as `do_jump` counts: from 1
  std::string command;              ///< "NAV_WAYPOINT"
  std::optional<geo::Ned> place_m;  ///< from home; nothing for items without a place
  std::optional<geo::Wgs84> place;  ///< the same on the earth, its altitude above mean sea level
  std::string bar;                  ///< the height as a block beside those of the other items
  std::string note;                 ///< "8 m/s", "stays 10 s"
};

/// A mission that was flown, once however often that was.
struct MissionTable {
  std::string name;
  std::string allocation;  ///< "flown by copter 1 (2 times) and copter 2"
  std::vector<ItemRow> items;
  plan::Mission const* mission = nullptr;  ///< the record's
};

/// The missions of a record in the order in which they were first started.
[[nodiscard]] std::vector<MissionTable> missions_of(FlightRecord const& record);

}  // namespace lapwing::dryrun
