#include "autonomy/operator/report_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "autonomy/operator/report_text.hpp"
#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

report::Heartbeat heartbeat_of(std::string const& text) {
  auto const read = parse_report(text);
  if (!read) ADD_FAILURE() << read.error().message;
  return std::get<report::Heartbeat>(read.value());
}

TEST(ReportReader, ReadsWhatTheDroneWrites) {
  auto told = ready();
  told.flight->local = geo::Point3<ArmingFrame>(3, 4, 12);
  told.flight->relative_alt_m = 12.0;
  told.flight->is_armed = true;
  Said said{.state = State::autonomous_explore, .user_error = UserError::no_lot_detected};
  said.health = {.is_healthy = false, .reason = "mapper has not reported yet"};
  OccupancyMap const map{
      .columns = 3, .rows = 2, .resolution_m = 0.5, .origin = {-4, 7}, .cells = {-1, 0, 100, 50, 0, -1}};
  auto const read = heartbeat_of(heartbeat_text(said, told, map).value());
  EXPECT_EQ(read.state, "AutonomousExplore");
  EXPECT_EQ(read.mode, "STABILIZE");
  EXPECT_EQ(read.height_m, 12.0);
  EXPECT_TRUE(read.is_armed);
  EXPECT_NEAR(read.position.value().lat_deg(), home_place.lat_deg(), 1e-12);
  EXPECT_EQ(read.local, geo::Point<ArmingFrame>(3, 4));
  EXPECT_EQ(read.battery, 0.9);
  EXPECT_EQ(read.user_error, to_string(UserError::no_lot_detected));
  EXPECT_FALSE(read.is_healthy);
  EXPECT_EQ(read.health_reason, "mapper has not reported yet");
  ASSERT_TRUE(read.map);
  EXPECT_EQ(read.map->columns, 3U);
  EXPECT_EQ(read.map->cells, map.cells);
  EXPECT_EQ(read.map->origin, map.origin);
}

TEST(ReportReader, TakesWhatIsNotKnownForNotKnown) {
  auto const read = heartbeat_of(heartbeat_text({}, {}).value());
  EXPECT_EQ(read.state, "Idle");
  EXPECT_EQ(read.mode, "");
  EXPECT_FALSE(read.height_m || read.position || read.local || read.battery || read.map);
  EXPECT_EQ(read.user_error, "");
  EXPECT_FALSE(heartbeat_of(R"({"Type":"Heartbeat","Latitude":91,"Longitude":3})").position);
}

TEST(ReportReader, ReadsErrorLogs) {
  auto const read = parse_report(error_log_text("it is \"late\"\n"));
  EXPECT_EQ(std::get<report::ErrorLog>(read.value()).message, "it is \"late\"?");
}

TEST(ReportReader, ReadsHowFarASurveyIs) {
  auto const read = [](std::string_view survey) {
    auto const text = fmt::format(R"({{"Type":"Slots","Features":{{"features":[],"survey":{}}}}})", survey);
    return std::get<report::Slots>(parse_report(text).value()).survey;
  };
  report::Survey const wanted{.coverage = 0.75,
                              .begun = "2026-11-24T10:00:00Z",
                              .is_over = true,
                              .ending = "nothing more to learn",
                              .slots = vehicle::SlotCounts{.free = 3, .taken = 4, .unknown = 1}};
  EXPECT_EQ(read(R"({"coverage":0.75,"begun":"2026-11-24T10:00:00Z","is_over":true,"ending":"nothing more to learn",)"
                 R"("slots":8,"free":3,"taken":4})"),
            wanted);
  EXPECT_EQ(read(R"({"coverage":0.5,"begun":null,"is_over":1,"slots":2,"free":3,"taken":4})"),
            report::Survey{.coverage = 0.5});
  for (auto const* const text : {"null", "7", "{}", R"({"coverage":1.5})", R"({"coverage":"all"})"})
    EXPECT_FALSE(read(text)) << text;
}

TEST(ReportReader, ReadsSlots) {
  auto const read = parse_report(slots_message(R"({"type":"FeatureCollection","features":[]})").value());
  EXPECT_EQ(std::get<report::Slots>(read.value()).features, R"({"features":[],"type":"FeatureCollection"})");
}

TEST(ReportReader, RefusesWhatIsNoReport) {
  for (
      auto const* const text :
      {"", "7", "[]", "{", R"({"Type":7})", R"({"Type":"Arm"})", R"({"Type":"Slots"})",
       R"({"Type":"Slots","Features":[]})", R"({"Type":"Heartbeat","Occupancy Map":{"Columns":1}})",
       R"({"Type":"Heartbeat","Occupancy Map":{"Columns":2,"Rows":2,"Resolution":1,"Origin X":0,"Origin Y":0,"Cells":[1,2,3]}})",
       R"({"Type":"Heartbeat","Occupancy Map":{"Columns":1,"Rows":1,"Resolution":1,"Origin X":0,"Origin Y":0,"Cells":[101]}})"})
    EXPECT_FALSE(parse_report(text)) << text;
}

}  // namespace
}  // namespace lapwing::autonomy
