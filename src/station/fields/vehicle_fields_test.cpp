#include "station/fields/vehicle_fields.hpp"

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/fields/field_changes.hpp"
#include "station/fields/field_description.hpp"
#include "station/fields/field_json.hpp"

namespace lapwing::station::internal {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

/// Notes the keys and the words of a table.
struct Notes : FieldVisitor {
  [[nodiscard]] bool wants_all() const override { return true; }
  bool wants(Member const& member) override {
    if (depth == 0) keys.emplace_back(member.key);
    return true;
  }
  void number(Member const&, std::optional<double>, Unit const& unit) override {
    EXPECT_LT(unit.low, unit.high) << keys.back();
  }
  void flag(Member const&, bool) override {}
  void text(Member const&, std::string_view) override {}
  void word(Member const& member, std::string_view value, Words const& words) override {
    EXPECT_NE(std::ranges::find(words.words, value), words.words.end()) << member.key << " " << value;
  }
  void begin_object(Member const&, Type const&) override { ++depth; }
  void begin_list(Member const&, Unique) override { ++depth; }
  void end() override { --depth; }

  std::vector<std::string> keys;
  int depth = 0;
};

base::TimePoint at(base::Duration since_start) {
  return base::TimePoint(since_start);
}

json told(vehicle::VehicleState const& state, base::Duration now) {
  Json object = Json::object();
  FieldJson writer(object, at(now));
  vehicle_fields(writer, state);
  writer.finish();
  return json::parse(object.dump());
}

TEST(VehicleFields, HaveEachAKeyOfTheirOwn) {
  Notes notes;
  vehicle_fields(notes, {});
  EXPECT_GT(notes.keys.size(), 40U);
  EXPECT_EQ(std::set(notes.keys.begin(), notes.keys.end()).size(), notes.keys.size());
}

TEST(VehicleFields, KnowEveryFamilyAndConnection) {
  vehicle::VehicleState state;
  for (int family = 0; family <= static_cast<int>(vehicle::Family::unknown); ++family) {
    state.family = static_cast<vehicle::Family>(family);
    for (auto const connection : {vehicle::Connection::ok, vehicle::Connection::lost, vehicle::Connection::conflict}) {
      state.links.connection = connection;
      Notes notes;
      vehicle_fields(notes, state);
    }
  }
}

TEST(VehicleFields, TellARobotInItsSite) {
  vehicle::VehicleState robot;
  robot.family = vehicle::Family::robot;
  robot.motion.site_pose.set({.site = "office", .floor = "1", .position = {3.14159, -2.0, 0.0}, .yaw_rad = 0.5},
                             at(1s));
  robot.carrier.report.set({.asked_speed_m_s = 0.16, .asked_yaw_rad = 1.0, .avoids_obstacle = true}, at(2s));
  auto const object = told(robot, 3s);
  EXPECT_EQ(object["family"], "robot");
  EXPECT_EQ(object["site_pose"],
            json({{"site", "office"}, {"floor", "1"}, {"x_m", 3.142}, {"y_m", -2.0}, {"z_m", 0.0}, {"yaw_rad", 0.5}}));
  EXPECT_EQ(object["carrier"], json({{"asked_speed_m_s", 0.16},
                                     {"asked_yaw_rad", 1.0},
                                     {"completed", false},
                                     {"avoids_obstacle", true},
                                     {"killed", false}}));
  EXPECT_EQ(object["age_s"]["site_pose"], 2.0);
  for (auto const* key : {"position", "gps", "battery", "armed", "radio"})
    EXPECT_FALSE(object.contains(key)) << key << " is what no robot fills";
}

TEST(VehicleFields, AreNoNewsWhenTheyRoundToTheSame) {
  FieldChanges changes;
  vehicle::VehicleState state;
  std::uint64_t revision = 0;
  auto const look = [&] {
    return changes.look([&](FieldVisitor& visitor) { vehicle_fields(visitor, state); }, ++revision);
  };
  state.motion.track_m = 10.01;
  EXPECT_TRUE(look());
  EXPECT_FALSE(look());
  state.motion.track_m = 10.04;
  EXPECT_FALSE(look()) << "told as 10.0";
  state.motion.track_m = 10.06;
  EXPECT_TRUE(look());
  EXPECT_TRUE(changes.news_of("track_m", revision - 1).value);
  EXPECT_FALSE(changes.news_of("track_m", revision).value);
  EXPECT_FALSE(changes.news_of("name", revision - 1).value);
  EXPECT_TRUE(changes.news_of("name", 0).value) << "to somebody who knows nothing";
}

TEST(VehicleFields, AreNewsByAMemberThatIsGone) {
  FieldChanges changes;
  vehicle::VehicleState state;
  std::uint64_t revision = 0;
  auto const look = [&] {
    return changes.look([&](FieldVisitor& visitor) { vehicle_fields(visitor, state); }, ++revision);
  };
  state.motion.hud.set({.airspeed_m_s = 1.0, .climb_m_s = {}, .throttle = {}}, at(1s));
  EXPECT_TRUE(look());
  state.motion.hud.set({.airspeed_m_s = {}, .climb_m_s = 1.0, .throttle = {}}, at(1s));
  EXPECT_TRUE(look()) << "the same number under another key";
  EXPECT_TRUE(changes.news_of("hud", revision - 1).value);
}

TEST(VehicleFields, AreDescribedAsTheyAreTold) {
  auto const types = vehicle_types();
  EXPECT_NE(types.find("export type Family = 'copter' | "), std::string::npos);
  EXPECT_NE(types.find("  relative_alt_m?: number;\n"), std::string::npos);
  EXPECT_NE(types.find("  further_batteries?: Battery[];\n"), std::string::npos);
  EXPECT_NE(types.find("  pulses_us: (number | null)[];\n"), std::string::npos);
  EXPECT_EQ(types.find("export interface Battery"), types.rfind("export interface Battery")) << "once";
  EXPECT_NE(vehicle_parsers().find("    lat_deg: number(-90, 90),\n"), std::string::npos);
  auto const schemas = vehicle_schemas();
  EXPECT_NE(schemas.find("    Battery:\n      type: object\n      required: [remaining]\n      properties:\n"),
            std::string::npos);
  EXPECT_NE(schemas.find("        remaining: {type: number, minimum: 0, maximum: 1}\n"), std::string::npos);
  EXPECT_NE(schemas.find("        further_batteries: {type: array, items: {$ref: \"#/components/schemas/Battery\"}, "),
            std::string::npos);
  EXPECT_NE(schemas.find("        family: {enum: [copter, "), std::string::npos);
  EXPECT_NE(schemas.find("        pulses_us: {type: array, items: {type: [integer, \"null\"], "), std::string::npos);
  EXPECT_NE(vehicle_table().find("| `relative_alt_m` | m, 2 decimals | yes | Above home. | GLOBAL_POSITION_INT |\n"),
            std::string::npos);
}

}  // namespace
}  // namespace lapwing::station::internal
