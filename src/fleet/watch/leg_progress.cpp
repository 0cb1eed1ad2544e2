#include "fleet/watch/leg_progress.hpp"

#include <cmath>

namespace lapwing::fleet {

using namespace std::chrono_literals;
using mavlink::MavCmd;

namespace {

constexpr double worth_noticing_m = 2.0;  // more than a position wanders by itself
constexpr base::Duration unheard = 5s;    // what happened in a gap is not known

bool is_about_height(MavCmd command) {
  return command == MavCmd::nav_takeoff || command == MavCmd::nav_vtol_takeoff || command == MavCmd::nav_land ||
         command == MavCmd::nav_vtol_land || command == MavCmd::nav_return_to_launch;
}

bool goes_round(MavCmd command) {
  return command == MavCmd::nav_loiter_turns || command == MavCmd::nav_loiter_time ||
         command == MavCmd::nav_loiter_to_alt;
}

}  // namespace

void LegProgress::note_item(int seq) {
  if (seq == seq_) return;
  seq_ = seq;
  is_new_ = true;
}

void LegProgress::note_progress() {
  is_new_ = true;
}

void LegProgress::begin_anew(geo::Wgs84 place) {
  anchor_ = place;
  stalled_for_ = {};
}

bool LegProgress::gets_on(geo::Wgs84 place) const {
  auto const* item = legs_.at(seq_);
  if (!item) return false;
  if (is_about_height(item->command) && std::abs(place.alt_m - anchor_->alt_m) >= worth_noticing_m) return true;
  if (goes_round(item->command) && geo::distance_m(*anchor_, place) >= worth_noticing_m) return true;
  auto const target = legs_.target(seq_, place);
  return target && geo::distance_m(place, *target) <= geo::distance_m(*anchor_, *target) - worth_noticing_m;
}

void LegProgress::note(geo::Wgs84 place, base::Duration since_last) {
  if (is_new_ || !anchor_) {
    is_new_ = false;
    patience_ = legs_.patience(seq_, place);
    return begin_anew(place);
  }
  if (gets_on(place)) return begin_anew(place);
  if (since_last <= unheard) stalled_for_ += since_last;
}

}  // namespace lapwing::fleet
