#include "autonomy/operator/report_text.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

TEST(Heartbeat, HasTheKeysThatOperatorsKnow) {
  auto bench = hovering_bench();
  bench.flight().local = geo::Point3<ArmingFrame>(1.5, -2.5, 10);
  EXPECT_EQ(*heartbeat_text(bench.said, bench.told),
            R"({"Type":"Heartbeat","State":"Hover","Ardupilot State":"GUIDED","Occupancy Map":null,)"
            R"("Relative Altitude":10,"Armed":true,"Latitude":43.2585,"Longitude":-79.9201,"Local Position X":1.5,)"
            R"("Local Position Y":-2.5,"Battery Percentage":0.9,"User Error":0,"Health Status":0,"Health Reason":""})");
}

TEST(Heartbeat, SaysNullOfWhatIsNotKnown) {
  Said const said{.user_error = UserError::no_lot_detected, .health = {false, "CommunicationLost"}};
  EXPECT_EQ(
      *heartbeat_text(said, {}),
      R"({"Type":"Heartbeat","State":"Idle","Ardupilot State":null,"Occupancy Map":null,"Relative Altitude":null,)"
      R"("Armed":false,"Latitude":null,"Longitude":null,"Local Position X":null,"Local Position Y":null,)"
      R"("Battery Percentage":null,"User Error":2,"Health Status":1,"Health Reason":"CommunicationLost"})");
  Told told;
  told.flight = FlightController{.mode = "\xFF", .relative_alt_m = std::numeric_limits<double>::infinity()};
  EXPECT_TRUE(heartbeat_text(said, told)->contains(R"("Relative Altitude":null)"));
}

TEST(Heartbeat, CarriesTheWholeMap) {
  OccupancyMap const map{.columns = 2, .rows = 2, .resolution_m = 0.5, .origin = {-3, 4}, .cells = {-1, 0, 100, 50}};
  EXPECT_TRUE(
      heartbeat_text({}, {}, map)
          ->contains(
              R"("Occupancy Map":{"Columns":2,"Rows":2,"Resolution":0.5,"Origin X":-3,"Origin Y":4,"Cells":[-1,0,100,50]})"));
}

TEST(Heartbeat, RefusesAMapThatIsNotWhole) {
  OccupancyMap map{.columns = 2, .rows = 2, .resolution_m = 0.5, .origin = {}, .cells = {-1, 0, 100}};
  EXPECT_FALSE(heartbeat_text({}, {}, map));
  map = {.columns = 500, .rows = 500, .resolution_m = 0.5, .origin = {}, .cells = std::vector<std::int8_t>(250'000)};
  EXPECT_FALSE(heartbeat_text({}, {}, map));
}

TEST(Heartbeat, WithTheLargestMapFitsIntoOneMessage) {
  OccupancyMap const map{.columns = 500,
                         .rows = 400,
                         .resolution_m = 0.05,
                         .origin = {},
                         .cells = std::vector<std::int8_t>(most_map_cells, 100)};
  EXPECT_LT(heartbeat_text({}, {}, map)->size(), 1024u * 1024u);
}

TEST(ErrorLog, IsOneObject) {
  EXPECT_EQ(error_log_text("a \"b\"\n"), R"({"Type":"ErrorLog","Message":"a \"b\"?"})");
  EXPECT_EQ(error_log_text(base::Error{base::ErrorKind::refused, "no", "wait"}),
            R"({"Type":"ErrorLog","Message":"no: wait"})");
}

TEST(ErrorLog, IsCutBetweenCharacters) {
  std::string const text(longest_error_log - 1, 'a');
  EXPECT_EQ(error_log_text(text + "\xC3\xA9"), R"({"Type":"ErrorLog","Message":")" + text + R"("})");
}

TEST(SlotsMessage, TakesNothingButAnObjectThatFits) {
  EXPECT_EQ(slots_message("{}").value(), R"({"Type":"Slots","Features":{}})");
  EXPECT_FALSE(slots_message(R"({},"Type":"Arm")"));
  EXPECT_FALSE(slots_message("[]"));
  EXPECT_FALSE(slots_message(std::string(longest_slots + 1, ' ')));
}

}  // namespace
}  // namespace lapwing::autonomy
