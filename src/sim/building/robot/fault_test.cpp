#include "sim/building/robot/fault.hpp"

#include <gtest/gtest.h>

namespace lapwing::sim::building {
namespace {

TEST(Fault, IsReadFromItsName) {
  EXPECT_EQ(parse_fault("sonar-stuck:2").value(), (Fault{.kind = Fault::Kind::sonar_stuck, .which = 2}));
  EXPECT_EQ(parse_fault("imu-silent").value(), (Fault{.kind = Fault::Kind::imu_silent}));
  EXPECT_EQ(parse_fault("wheel-slips:right").value(),
            (Fault{.kind = Fault::Kind::wheel_slips, .which = 1, .amount = 0.5}));
  EXPECT_EQ(parse_fault("wheel-slips:left=0.2").value().amount, 0.2);
  EXPECT_EQ(parse_fault("camera-dark=0").value().amount, 0.0);
  EXPECT_EQ(to_string(Fault::Kind::encoder_dead), "encoder-dead");
}

TEST(Fault, IsRefusedWithWhatToWrite) {
  auto const error = [](std::string_view text) {
    auto const fault = parse_fault(text);
    return fault ? "" : fault.error().message + "; " + fault.error().hint;
  };
  EXPECT_EQ(error("sonar-stuck"), "the fault sonar-stuck does not say which; as in sonar-stuck:2");
  EXPECT_EQ(error("wheel-slips:up"),
            "the fault wheel-slips:up names no part; sonars have numbers from 0, wheels are left and right");
  EXPECT_EQ(error("imu-silent=3"), "the fault imu-silent=3 has an amount that cannot be; it takes none");
  EXPECT_EQ(error("battery-low=2"), "the fault battery-low=2 has an amount that cannot be; from 0 to 1");
  EXPECT_EQ(error("battery-low=nan"), "the fault battery-low=nan has an amount that cannot be; from 0 to 1");
  EXPECT_NE(error("sonar-stuck:9"), "");
  EXPECT_NE(error("imu-silent:1"), "");
  EXPECT_NE(error("sonar-stuck:2x"), "");
  EXPECT_TRUE(error("tired").starts_with("the fault tired is not known; known: sonar-stuck, "));
}

}  // namespace
}  // namespace lapwing::sim::building
