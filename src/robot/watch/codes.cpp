#include "robot/watch/codes.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

namespace lapwing::robot {

namespace {

using enum Severity;

auto constexpr table = std::to_array<CodeEntry>({
    {code::imu_silent, Module::sensors, degraded,
     "The inertial unit says nothing; the pose goes on by the wheels alone.",
     "Look at the unit's plug. Commands with a heading are refused until it speaks again."},
    {code::imu_faulty, Module::sensors, degraded,
     "The inertial unit says the same over and over, or what cannot be; it is not believed.",
     "Switch the board off and on. If it stays, change the unit."},
    {code::sonar_stuck, Module::sensors, degraded, "A sonar says the same though the robot moved; it is not believed.",
     "Look whether something sticks to it. If not, change it."},
    {code::sonar_jumping, Module::sensors, degraded,
     "A sonar says one distance and another in turns; it is not believed.",
     "Look for another sonar that it hears, and for a loose plug."},
    {code::sonar_dropouts, Module::sensors, notice, "A sonar hears a near thing only now and then.",
     "Nothing, before curtains and slanted glass. Otherwise clean it."},
    {code::pulses_jump, Module::sensors, degraded, "A wheel's counter jumped further than the wheel can turn.",
     "Look at the encoder's cable and its shield; the pose may be off by what was missed."},
    {code::wheels_slip, Module::sensors, notice, "The wheels turn otherwise than the robot moves.",
     "Look whether it pushes against something, or the floor is wet."},

    {code::board_away, Module::carrier, critical, "The robot's board is not heard; it stops by itself.",
     "Look at the cable and the supply. It is found again by itself; drive again then."},
    {code::board_version, Module::carrier, critical, "The board speaks another version of the protocol.",
     "Bring the board's program and this one to the same version."},
    {code::left_wheel_dead, Module::carrier, critical, "The left wheel is driven and gives no pulses.",
     "Look whether it is blocked, then at the motor's and the encoder's plugs. The next command tries again."},
    {code::right_wheel_dead, Module::carrier, critical, "The right wheel is driven and gives no pulses.",
     "Look whether it is blocked, then at the motor's and the encoder's plugs. The next command tries again."},
    {code::killed, Module::carrier, notice, "The robot was killed.",
     "When it is safe to move, restart it at the command centre."},
    {code::board_watchdog, Module::carrier, degraded, "The board heard nobody for half a second and stopped.",
     "Look at the line, and whether the computer was held up. The next command drives on."},
    {code::too_near, Module::carrier, notice, "Something is nearer than 5 cm in the way; the board keeps its distance.",
     "Clear the way, or wait: the planner goes around it."},
    {code::battery_low, Module::carrier, degraded, "The battery is low.", "Let it return, and charge it."},
    {code::line_damaged, Module::carrier, degraded, "Much of what comes over the line is damaged.",
     "Look at the cable, its length and the baud rate."},
    {code::not_let_drive, Module::carrier, degraded, "The autopilot does not let it drive.",
     "The log has its reason: a check before arming, a place that it does not know, somebody else who drives it."},
    {code::nobody_drives, Module::carrier, degraded, "Nobody listens to its drive commands.",
     "Start the base's driver, with the robot's namespace. Its topic cmd_vel must take Twist or TwistStamped."},

    {code::no_scans, Module::mapping, degraded, "No scan has come for a second; the pose goes on by odometry.",
     "Look at the laser's supply and whether it turns."},
    {code::pose_lost, Module::mapping, critical, "The place on the map is not known any more.",
     "Carry the robot to where it has been, or begin a new map."},
    {code::mapping_slow, Module::mapping, degraded, "Scans come faster than they can be matched; some are left out.",
     "Drive slower, or give the computer less to do."},
    {code::map_not_saved, Module::mapping, degraded, "The map cannot be written to disk; it is kept in memory.",
     "Make room on the disk. What is in memory is written then."},

    {code::no_way, Module::planner, degraded, "No way leads to where it shall go.",
     "Look on the map whether a door is shut or something stands in the way."},
    {code::override_ended, Module::planner, notice,
     "Points of interest asked for a place and then said nothing for 10 s; the route goes on.",
     "Nothing, now and then. Otherwise see what points of interest says."},
    {code::not_moving, Module::planner, degraded, "It drives, and the place on the map does not change.",
     "Look whether it pushes against something that no sensor sees."},

    {code::camera_silent, Module::points_of_interest, degraded,
     "No picture comes from the camera; doors are not looked for.",
     "Look at the camera's plug. The map is made without doors meanwhile."},
    {code::pictures_blurred, Module::points_of_interest, notice, "Most pictures are not sharp enough to read.",
     "More light, or a slower drive past doors; clean the lens."},
    {code::no_reader, Module::points_of_interest, notice,
     "Nothing is installed that reads signs; doors have no numbers.", "lapwing doctor says what is missing."},
    {code::eyes_away, Module::points_of_interest, degraded,
     "The program that looks at pictures is gone; doors are not looked for.",
     "Nothing: it is started anew by itself. If it stays away, see the log."},

    {code::operator_away, Module::communication, notice,
     "The operator is not connected; what is said is kept for later.",
     "Nothing: the robot goes on, or does what its setting says."},

    {code::store_away, Module::visualizer, notice, "The map's store does not answer; the map is shown as it was.",
     "See the station's log."},
    {code::robot_unheard, Module::command_centre, notice, "The command centre does not hear the robot.",
     "Look at the radio link. The robot goes on by itself."},
});

}  // namespace

std::string_view to_string(Severity severity) {
  switch (severity) {
    case notice: return "notice";
    case degraded: return "degraded";
    case critical: break;
  }
  return "critical";
}

std::span<CodeEntry const> code_table() {
  return table;
}

CodeEntry const* find_code(std::uint16_t code) {
  auto const found = std::ranges::find(table, code, &CodeEntry::code);
  return found == table.end() ? nullptr : &*found;
}

Severity severity_of(std::uint16_t code) {
  auto const* const entry = find_code(code);
  return entry != nullptr ? entry->severity : critical;
}

std::string code_page() {
  std::string page =
      "# What a robot's modules say when something is wrong\n\n"
      "Each module says ten times a second how it is; an error code is one of these. *Critical* stops the robot until "
      "it has been over for 2 s,\n"
      "*degraded* lets it go on less well, a *notice* is for whoever likes to know. A module without which the robot "
      "does not drive (SIM, CAR, MMU,\n"
      "PLN) and that says nothing for 0.3 s stops it, too. What is so now stands in the tab *Health* of the page and "
      "in "
      "`GET /api/v1/health`\n"
      "([guide](../guide/robots.md#whether-it-is-well)). This page is made from `src/robot/watch/codes.cpp`, which "
      "both "
      "speak from as well.\n"
      "701 and 801 are for old parts that join at the text port "
      "([protocol](robot-serial.md#old-parts)): nothing of Lapwing's own says them.\n";
  std::optional<Module> module;
  for (auto const& entry : table) {
    if (module != entry.module) {
      auto const& name = name_of(entry.module);
      page += fmt::format("\n## {} ({})\n\n| code | | means | do |\n|---|---|---|---|\n", name.name, name.short_name);
      module = entry.module;
    }
    page +=
        fmt::format("| {} | {} | {} | {} |\n", entry.code, to_string(entry.severity), entry.meaning, entry.what_to_do);
  }
  return page;
}

}  // namespace lapwing::robot
