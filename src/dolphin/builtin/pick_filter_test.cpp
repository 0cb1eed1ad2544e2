#include "dolphin/builtin/internal/pick_filter.hpp"

#include <gtest/gtest.h>

namespace lapwing::dolphin::internal {
namespace {

using Lines = std::vector<std::string>;

tasks::VehicleInfo vehicle(std::string id, std::string type, std::vector<std::string> payload = {}) {
  tasks::VehicleInfo info;
  info.id = {std::move(id)};
  info.type = std::move(type);
  info.payload = std::move(payload);
  return info;
}

TEST(PickFilter, NamesEveryFieldThatRulesAVehicleOut) {
  PickFilter filter;
  filter.id = "7";
  filter.type = "UAV";
  filter.payload = {"Camera", "Sonar"};
  filter.region = geo::Disc{geo::Wgs84::from_degrees(41.0, -8.0), 100.0};
  EXPECT_EQ(objections(filter, vehicle("1", "UGV", {"Camera"})),
            (Lines{"is not 7", "is a UGV", "has no Sonar", "has not told its position"}));
  auto far = vehicle("7", "UAV", {"Sonar", "Camera"});
  far.position = geo::Wgs84::from_degrees(42.0, -8.0);
  EXPECT_EQ(objections(filter, far), Lines{"is outside the region"});
  far.position = filter.region->center;
  EXPECT_TRUE(objections(filter, far).empty());
}

TEST(PickFilter, SaysOfEveryVehicleWhyItWasNotPicked) {
  PickFilter filter;
  filter.count = 2;
  filter.type = "UAV";
  auto lost = vehicle("4", "UAV");
  lost.connected = false;
  EXPECT_EQ(why_not_picked(filter, {vehicle("1", "UAV"), vehicle("2", "UGV"), vehicle("3", "UAV"), lost},
                           {tasks::VehicleId{"1"}}),
            (Lines{"vehicle 1 is picked already", "vehicle 2 is a UGV", "vehicle 3 would do",
                   "vehicle 4 is not heard, or shares its id"}));
  EXPECT_EQ(why_not_picked(filter, {}, {}), Lines{"no vehicle was heard"});
}

TEST(PickFilter, NamesNoMoreThanPeopleRead) {
  std::vector<tasks::VehicleInfo> many;
  for (int i = 1; i <= 100; ++i) many.push_back(vehicle(std::to_string(i), "UGV"));
  auto const lines = why_not_picked({}, many, {});
  ASSERT_EQ(lines.size(), 21u);
  EXPECT_EQ(lines.back(), "and 80 more");
}

TEST(PickFilter, IsToldInWords) {
  PickFilter filter;
  EXPECT_EQ(pick_text(filter), "1 vehicle");
  filter.count = 2;
  filter.type = "UAV";
  filter.payload = {"Camera", "Sonar"};
  EXPECT_EQ(pick_text(filter), "2 UAV with Camera and Sonar");
}

}  // namespace
}  // namespace lapwing::dolphin::internal
