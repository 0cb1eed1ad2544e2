#include "onboard/decide/flight_listener.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text/printable.hpp"
#include "bus/messages/mavros_names.hpp"

namespace lapwing::onboard {

namespace names = bus::mavros::names;
using namespace std::chrono_literals;
using autonomy::ArmingFrame;
using bus::Profile;

namespace {

/// What moves comes ten times a second, health twice.
constexpr base::Duration motion_lasts = 1s;
constexpr base::Duration health_lasts = 3s;

constexpr std::uint32_t prearm_check = 1U << 28U;  // MAV_SYS_STATUS_PREARM_CHECK

/// MAV_STATE: critical, emergency, and that it has given up flying.
bool is_critical(std::uint8_t system_status) {
  constexpr std::uint8_t critical = 5;
  constexpr std::uint8_t emergency = 6;
  constexpr std::uint8_t terminated = 8;
  return system_status == critical || system_status == emergency || system_status == terminated;
}

bool passes_prearm_checks(bus::mavros::SysStatus const* status) {
  bool const tells = status != nullptr && (status->sensors_present & status->sensors_enabled & prearm_check) != 0;
  return !tells || (status->sensors_health & prearm_check) != 0;
}

}  // namespace

std::optional<geo::Point3<ArmingFrame>> FlightHeard::from_home(bus::Point const& local) const {
  if (!home.message) return std::nullopt;
  auto const& origin = home.message->position;
  return geo::Point3<ArmingFrame>(local.x - origin.x, local.y - origin.y, local.z - origin.z);
}

std::optional<bus::Point> FlightHeard::in_local_frame(geo::Point3<ArmingFrame> const& place) const {
  if (!home.message) return std::nullopt;
  auto const& origin = home.message->position;
  return bus::Point{place.x() + origin.x, place.y() + origin.y, place.z() + origin.z};
}

std::optional<autonomy::FlightController> FlightHeard::told(base::TimePoint now) const {
  if (!state.message) return std::nullopt;
  auto const last = std::max({state.at, system_status.at, battery.at, position.at, relative_altitude.at, pose.at});
  autonomy::FlightController flight{.silence = now - last,
                                    .mode = state.message->mode,
                                    .is_armed = state.message->armed,
                                    .prearm_ok = passes_prearm_checks(system_status.within(health_lasts, now)),
                                    .is_critical = is_critical(state.message->system_status)};
  // Before it has a fix it tells zeros.
  auto const* const fix = position.within(motion_lasts, now);
  if (fix != nullptr && fix->status.status >= bus::NavSatStatus::fix) {
    flight.gps_fix = autonomy::gps_fix_3d;
    flight.position = geo::Wgs84::from_degrees(fix->latitude, fix->longitude, fix->altitude);
  }
  if (auto const* const height = relative_altitude.within(motion_lasts, now)) flight.relative_alt_m = height->data;
  if (auto const* const there = pose.within(motion_lasts, now)) flight.local = from_home(there->pose.position);
  if (auto const* const charge = battery.within(health_lasts, now)) flight.battery = charge->percentage;
  if (home.message) {
    auto const& geo = home.message->geo;
    flight.home = geo::Wgs84::from_degrees(geo.latitude, geo.longitude, geo.altitude);
  }
  return flight;
}

base::Result<std::unique_ptr<FlightListener>> FlightListener::open(base::Loop& loop, bus::Bus& bus) {
  std::unique_ptr<FlightListener> listener(new FlightListener(loop));
  if (auto const opened = listener->open_topics(bus); !opened) return std::unexpected(opened.error());
  return listener;
}

base::Result<> FlightListener::open_topics(bus::Bus& bus) {
  bus::Ends ends(bus);
  // Best effort hears writers of both kinds: MAVROS writes its sensors' topics so.
  auto const keep = [&]<class M>(std::string_view topic, Heard<M>& last) {
    ends.hear<M>(topics_, topic, Profile::sensor_data,
                 [this, &last](M const& message) { last = {message, loop_.now()}; });
  };
  ends.hear<bus::mavros::State>(topics_, names::state, Profile::latched, [this](bus::mavros::State const& state) {
    if (state.connected) heard_.state = {state, loop_.now()};
  });
  keep(names::system_status, heard_.system_status);
  keep(names::battery, heard_.battery);
  keep(names::position, heard_.position);
  keep(names::relative_altitude, heard_.relative_altitude);
  keep(names::local_pose, heard_.pose);
  // Known at once by a process that was started anew in flight.
  ends.hear<bus::mavros::HomePosition>(topics_, names::home, Profile::latched,
                                       [this](auto const& home) { heard_.home = {home, loop_.now()}; });
  ends.hear<bus::mavros::StatusText>(topics_, names::status_text, Profile::sensor_data,
                                     [this](bus::mavros::StatusText const& text) { take(text); });
  return ends.result();
}

void FlightListener::take(bus::mavros::StatusText const& text) {
  constexpr std::uint8_t warning = 4;  // MAV_SEVERITY
  constexpr base::Duration once_in = 30s;
  constexpr std::size_t most = 32;
  if (text.severity > warning) return;
  auto const now = loop_.now();
  std::erase_if(told_, [&](auto const& one) { return now - one.second > once_in; });
  bool const is_old = std::ranges::any_of(told_, [&](auto const& one) { return one.first == text.text; });
  if (is_old || told_.size() >= most) return;
  told_.emplace_back(text.text, now);
  warnings_.push_back(fmt::format("flight controller: {}", base::printable(text.text)));
}

std::vector<std::string> FlightListener::take_warnings() {
  return std::exchange(warnings_, {});
}

}  // namespace lapwing::onboard
