#include "bus/cdr/cdr.hpp"

#include <gtest/gtest.h>

#include "bus/messages/common.hpp"
#include "bus/messages/navigation.hpp"
#include "bus/messages/sensors.hpp"

namespace lapwing::bus {
namespace {

OccupancyGrid a_grid() {
  OccupancyGrid grid;
  grid.header = {.stamp = {.sec = -3, .nanosec = 999'999'999}, .frame_id = "map"};
  grid.info = {
      .map_load_time = {}, .resolution = 0.05F, .width = 3, .height = 2, .origin = {.position = {1.0, -2.0, 0.0}}};
  grid.data = {-1, 0, 100, 50, -1, 7};
  return grid;
}

TEST(Cdr, LaysNumbersEvenlyBehindTheByteOrder) {
  // 00 01: little-endian. The time, the text with its length and its end, and then four bytes apart.
  auto const bytes = encode(Header{.stamp = {.sec = 1, .nanosec = 2}, .frame_id = "a"});
  EXPECT_EQ(bytes, std::string("\0\1\0\0\1\0\0\0\2\0\0\0\2\0\0\0a\0", 18));
}

TEST(Cdr, GivesBackWhatItWasGiven) {
  EXPECT_EQ(*decode<OccupancyGrid>(encode(a_grid())), a_grid());
  LaserScan scan{.header = {.stamp = {}, .frame_id = "laser"}, .angle_min = -1.5F, .ranges = {1.0F, 2.5F, 30.0F}};
  EXPECT_EQ(*decode<LaserScan>(encode(scan)), scan);
  Odometry odometry{.child_frame_id = "base_link"};
  odometry.pose.covariance[35] = 0.25;
  EXPECT_EQ(*decode<Odometry>(encode(odometry)), odometry);
  TFMessage const frames{.transforms = {{.child_frame_id = "laser"}, {.child_frame_id = "camera"}}};
  EXPECT_EQ(*decode<TFMessage>(encode(frames)), frames);
  BatteryState const battery{.percentage = 0.5F, .present = true, .cell_voltage = {3.7F}, .serial_number = "7"};
  EXPECT_EQ(*decode<BatteryState>(encode(battery)), battery);
}

TEST(Cdr, ReadsTheOtherByteOrder) {
  auto const read = decode<Time>(std::string("\0\0\0\0\0\0\0\1\0\0\0\2", 12));
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, (Time{.sec = 1, .nanosec = 2}));
}

TEST(Cdr, TakesNoMessageThatIsCutOff) {
  auto const whole = encode(a_grid());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(decode<OccupancyGrid>(std::string_view(whole).substr(0, size))) << size;
}

TEST(Cdr, KeepsNoRoomForWhatCannotBeThere) {
  // A list of four thousand million frames in twelve bytes.
  auto const read = decode<TFMessage>(std::string("\0\1\0\0\xff\xff\xff\xff\0\0\0\0", 12));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "not a whole tf2_msgs/msg/TFMessage");
}

}  // namespace
}  // namespace lapwing::bus
