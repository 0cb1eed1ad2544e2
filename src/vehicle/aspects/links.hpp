#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "vehicle/aged.hpp"

namespace lapwing::vehicle {

/// ok: heard within the time-out · lost: silent for longer · conflict: two vehicles use its system id, commands are
/// refused.
enum class Connection { ok, lost, conflict };
[[nodiscard]] std::string_view to_string(Connection connection);

/// One of the links on which a vehicle is heard, over the last 10 s.
struct LinkQuality {
  std::string name;   ///< URL and far end
  double loss = 0.0;  ///< 0..1
  double messages_per_s = 0.0;
  double bytes_per_s = 0.0;
  std::optional<base::Duration> round_trip;  ///< nothing until it has been measured
  bool is_alive = false;
  bool is_used = false;  ///< commands go over it

  friend bool operator==(LinkQuality const&, LinkQuality const&) = default;
};

struct RemoteControl {
  bool is_lost = false;  ///< the receiver hears no transmitter
  int channels = 0;
  std::array<std::optional<std::uint16_t>, 18> pulses_us{};
  std::optional<double> rssi;  ///< 0..1
};

/// The telemetry radio's own view of its link, for both ends.
struct Radio {
  std::optional<int> rssi;  ///< in the radio's own units, 0..254
  std::optional<int> remote_rssi;
  std::optional<int> noise;
  std::optional<int> remote_noise;
  std::optional<double> transmit_buffer_free;  ///< 0..1
  int receive_errors = 0;
};

/// Whether and over what a vehicle is heard.
struct Links {
  Connection connection = Connection::ok;
  std::string used;  ///< URL of the link over which it is commanded, with its peer
  std::vector<LinkQuality> all;
  base::TimePoint heartbeat_heard{};
  base::TimePoint heard{};  ///< the last message of its autopilot, whatever it was
  /// Nothing at all has come for some seconds: what is known of it is the last that is known. Long before it is lost.
  bool is_silent = false;
  std::string conflict;  ///< which two vehicles use its system id, for people; empty: none
  Aged<RemoteControl> remote_control;
  Aged<Radio> radio;
};

}  // namespace lapwing::vehicle
