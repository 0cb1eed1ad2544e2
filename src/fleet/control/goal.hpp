#pragma once

#include <optional>
#include <string>

#include "fleet/state/mavlink_vehicle.hpp"
#include "vehicle/control.hpp"

namespace lapwing::fleet {

/// What a vehicle shows of a command.
struct Standing {
  enum class Kind {
    unseen,     ///< nothing that was heard since shows it
    under_way,  ///< it obeys, and is not there yet
    reached,
    cut_short,  ///< it obeyed and does so no more
  };
  Kind kind = Kind::unseen;
  std::string text = {};  ///< for people: "at 7 of 20 m", "312 m to go"; of unseen, what it shows instead
  std::optional<double> left_m = {};
};

/// What one command is to bring about on one vehicle, and what the vehicle shows of it.
///
/// Only that counts which was heard after the vehicle had acknowledged the command (before, after it was given), and
/// which belongs to this command alone: a mode that it had before proves nothing until a newer heartbeat shows it, and
/// that it is guided does not say where to. Remembers what it was shown: to be asked after every message.
class Goal {
 public:
  Goal(MavlinkVehicle const& craft, vehicle::VehicleCommand command, base::TimePoint given);

  /// From now on only what is newer counts.
  void acknowledge(base::TimePoint now);
  [[nodiscard]] Standing look(MavlinkVehicle const& craft, base::TimePoint now);
  /// For how long an acknowledged command may show nothing.
  [[nodiscard]] base::Duration patience() const;

 private:
  struct Nearing {
    double first_m = 0.0;
    double nearest_m = 0.0;
    base::TimePoint nearest_at{};
    [[nodiscard]] base::Duration no_nearer_for(base::TimePoint now) const { return now - nearest_at; }
  };

  [[nodiscard]] bool is_news(base::TimePoint heard) const { return heard >= since_; }
  void note(MavlinkVehicle const& craft, base::TimePoint now);
  [[nodiscard]] bool is_in_mode(MavlinkVehicle const& craft) const;
  /// Why it does not obey any more; empty while it does, or while it has not begun to.
  [[nodiscard]] std::string ended_by(MavlinkVehicle const& craft, base::TimePoint now) const;
  [[nodiscard]] std::optional<double> height_m(MavlinkVehicle const& craft) const;
  [[nodiscard]] std::optional<double> distance_m(MavlinkVehicle const& craft, geo::Wgs84 const& place) const;
  [[nodiscard]] bool has_come_to_rest(MavlinkVehicle const& craft, base::TimePoint now, base::Duration time) const;
  [[nodiscard]] bool is_down(MavlinkVehicle const& craft) const;

  [[nodiscard]] Standing arming(MavlinkVehicle const& craft) const;
  [[nodiscard]] Standing mode(MavlinkVehicle const& craft) const;
  [[nodiscard]] Standing holding(MavlinkVehicle const& craft) const;
  [[nodiscard]] Standing take_off(MavlinkVehicle const& craft, base::TimePoint now) const;
  [[nodiscard]] Standing landing(MavlinkVehicle const& craft, base::TimePoint now) const;
  [[nodiscard]] Standing return_home(MavlinkVehicle const& craft, base::TimePoint now) const;
  [[nodiscard]] Standing go_to(MavlinkVehicle const& craft, base::TimePoint now);
  /// Of what heads for the place: whether it is there, or how far it has to go.
  [[nodiscard]] Standing arrival(MavlinkVehicle const& craft, base::TimePoint now, double left_m) const;

  vehicle::VehicleCommand command_;
  base::TimePoint since_{};
  std::optional<std::uint32_t> mode_;        ///< in which it obeys
  std::optional<std::uint32_t> mode_after_;  ///< which it takes by itself when it has obeyed
  std::optional<double> start_height_m_;     ///< when the command was given
  std::optional<double> height_wanted_m_;
  bool has_been_in_mode_ = false;
  bool has_been_armed_ = false;
  bool heads_there_ = false;
  std::optional<Nearing> nearing_;
  std::optional<base::TimePoint> at_rest_since_;
  std::optional<base::TimePoint> level_since_;
};

}  // namespace lapwing::fleet
