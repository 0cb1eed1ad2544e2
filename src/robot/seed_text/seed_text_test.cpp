#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "robot/seed_text/line.hpp"
#include "robot/seed_text/payload.hpp"

namespace lapwing::robot::seed_text {
namespace {

using namespace std::chrono_literals;
double constexpr degree = std::numbers::pi / 180;

std::string text(Payload const& payload) {
  auto const written = write(payload);
  return written ? *written : "! " + written.error().message;
}

/// By way of a whole line.
base::Result<Payload> back(Module from, Module to, std::string const& message) {
  auto const line = write(Line{.from = from, .to = to, .stamp = 5ms, .message = message});
  EXPECT_TRUE(line);
  auto const again = read(std::string_view(*line).substr(0, line->size() - 1));
  EXPECT_TRUE(again);
  return read_payload(*again);
}

TEST(SeedLine, IsWrittenAndReadAsTheSeedHasIt) {
  Line const line{.from = Module::planner, .to = Module::carrier, .stamp = 1500ms, .message = "Medium"};
  EXPECT_EQ(write(line).value(), "PLN_CAR_1500_Medium\n");
  EXPECT_EQ(read("PLN_CAR_1500_Medium").value(), line);
}

TEST(SeedLine, EncodesWhatWouldEndItOrAPartOfIt) {
  std::string message = "a_b%c\nd\re";
  message += '\0';
  Line const line{.from = Module::points_of_interest, .to = Module::communication, .stamp = 0ms, .message = message};
  auto const written = write(line).value();
  EXPECT_EQ(written, "POI_CM_0_a%5Fb%25c%0Ad%0De%00\n");
  EXPECT_EQ(read(std::string_view(written).substr(0, written.size() - 1)).value(), line);
}

TEST(SeedLine, TakesAnUnderscoreOfOldPartsForItself) {
  auto const line = read("MMU_CM_7_10_20_90").value();
  EXPECT_EQ(line.message, "10_20_90");
  EXPECT_TRUE(std::holds_alternative<Pose>(read_payload(line).value()));
}

TEST(SeedLine, SaysWhatIsWrong) {
  auto const why = [](std::string_view from) { return read(from).error().message; };
  EXPECT_EQ(why(""), "not Sender_Receiver_TimeStamp_Message: three _ are needed");
  EXPECT_EQ(why("PLN_CAR_5"), "not Sender_Receiver_TimeStamp_Message: three _ are needed");
  EXPECT_EQ(why("XYZ_CAR_5_Stop"), "the sender is none of the modules");
  EXPECT_EQ(why("PLN_car_5_Stop"), "the receiver is none of the modules");
  EXPECT_EQ(why("PLN_CAR_-5_Stop"), "the time stamp is no number of milliseconds since the start");
  EXPECT_EQ(why("PLN_CAR_99999999999999999999_Stop"), "the time stamp is no number of milliseconds since the start");
  EXPECT_EQ(why("PLN_CAR_5_a%5"), "column 2 of the message: % without two digits");
  EXPECT_EQ(why(std::string(2'000, 'x')), "longer than 1024 characters");
  EXPECT_FALSE(write(Line{.stamp = -1ms, .message = {}}));
  EXPECT_FALSE(write(Line{.stamp = 0ms, .message = std::string(400, '_')}));
}

TEST(SeedLineReader, CutsAStreamHoweverItComes) {
  std::string const stream =
      "PLN_CAR_1_Stop\r\n\nSIM_PLN_2_-:-:80\n" + std::string(3'000, 'x') + "\nCAR_PLN_3_Completed\nhalf";
  for (std::size_t const piece : {1, 2, 7, 4'000}) {
    LineReader reader;
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      auto const part = std::string_view(stream).substr(at, piece);
      reader.feed({reinterpret_cast<std::uint8_t const*>(part.data()), part.size()},
                  [&](std::string_view line) { lines.emplace_back(line); });
    }
    EXPECT_EQ(lines, (std::vector<std::string>{"PLN_CAR_1_Stop", "SIM_PLN_2_-:-:80", "CAR_PLN_3_Completed"}));
    EXPECT_EQ(reader.too_long(), 1U);
  }
}

TEST(SeedPayload, APoseHasSignsAndIsReadInTheSeedsOwnWayToo) {
  EXPECT_EQ(text(Pose{.x_m = -1.5, .y_m = 20.004, .yaw_rad = -90 * degree}), "-150:2000:270");
  for (auto const* const written : {"-150:2000:270", "-150-2000-270", "-150_2000_270"}) {
    auto const pose = std::get<Pose>(back(Module::mapping, Module::planner, written).value());
    EXPECT_DOUBLE_EQ(pose.x_m, -1.5);
    EXPECT_DOUBLE_EQ(pose.y_m, 20);
    EXPECT_NEAR(std::remainder(pose.yaw_rad + 90 * degree, 2 * std::numbers::pi), 0, 1e-12);
  }
  auto const negative = std::get<Pose>(back(Module::mapping, Module::planner, "10--20--90").value());
  EXPECT_DOUBLE_EQ(negative.y_m, -0.2);
  EXPECT_NEAR(negative.yaw_rad, -90 * degree, 1e-12);
}

TEST(SeedPayload, DistancesMayBeMissing) {
  EXPECT_EQ(text(Distances{.left_m = 1.2, .right_m = std::nullopt, .front_m = 3}), "120:-:300");
  auto const read = std::get<Distances>(back(Module::sensors, Module::planner, "120:-:300").value());
  EXPECT_DOUBLE_EQ(read.left_m.value(), 1.2);
  EXPECT_FALSE(read.right_m);
  EXPECT_DOUBLE_EQ(read.front_m.value(), 3);
  EXPECT_TRUE(back(Module::sensors, Module::planner, "-:-:-"));
  EXPECT_FALSE(back(Module::sensors, Module::planner, "120:-5:300"));
  EXPECT_FALSE(back(Module::sensors, Module::planner, "120:300"));
}

TEST(SeedPayload, ThePlannerSaysASpeedOrAnAngle) {
  for (auto const speed : {Speed::stop, Speed::low, Speed::medium, Speed::high, Speed::reverse})
    EXPECT_EQ(std::get<Speed>(back(Module::planner, Module::carrier, text(speed)).value()), speed);
  EXPECT_EQ(text(Angle{.rad = -0.1 * degree}), "0");
  EXPECT_EQ(text(Angle{.rad = 3 * std::numbers::pi}), "180");
  EXPECT_NEAR(std::get<Angle>(back(Module::planner, Module::carrier, "360").value()).rad, 2 * std::numbers::pi, 1e-12);
  EXPECT_FALSE(back(Module::planner, Module::carrier, "361"));
  EXPECT_FALSE(back(Module::planner, Module::carrier, "-1"));
  EXPECT_FALSE(back(Module::planner, Module::carrier, "medium"));
}

TEST(SeedPayload, PointsOfInterestAskAndTell) {
  EXPECT_EQ(std::get<Override>(back(Module::points_of_interest, Module::planner, "CONTINUE").value()), Override::go_on);
  EXPECT_TRUE(std::holds_alternative<Pose>(back(Module::points_of_interest, Module::planner, "10:20:90").value()));
  PointOfInterest const tag{.kind = PointOfInterest::Kind::name_tag, .text = "221, ab_c", .x_m = 0.15, .y_m = -0.2};
  EXPECT_EQ(text(tag), "\"Name Tag\", \"221, ab_c\", 15, -20");
  auto const read =
      std::get<PointOfInterest>(back(Module::points_of_interest, Module::communication, text(tag)).value());
  EXPECT_EQ(read.text, "221, ab_c");
  EXPECT_EQ(read.kind, PointOfInterest::Kind::name_tag);
  EXPECT_DOUBLE_EQ(read.y_m, -0.2);
  EXPECT_TRUE(back(Module::points_of_interest, Module::communication, "\"Door\", \"\", 15, 20"));
  EXPECT_FALSE(back(Module::points_of_interest, Module::communication, "\"Window\", \"\", 15, 20"));
  EXPECT_FALSE(back(Module::points_of_interest, Module::communication, "\"Door\", \"\", 15"));
}

TEST(SeedPayload, TheCarrierIsKilledAndSaysCompleted) {
  EXPECT_TRUE(std::holds_alternative<Kill>(back(Module::command_centre, Module::carrier, "Kill").value()));
  EXPECT_TRUE(std::holds_alternative<Kill>(back(Module::communication, Module::carrier, "e-Stop").value()));
  EXPECT_TRUE(std::holds_alternative<Completed>(back(Module::carrier, Module::planner, text(Completed{})).value()));
}

TEST(SeedPayload, EveryModuleLogs) {
  auto const entry = LogEntry{.state = ModuleState::ready, .error_code = 302, .memory_bytes = 1'048'576};
  EXPECT_EQ(text(entry), "ready:302:1048576");
  auto const read = std::get<LogEntry>(back(Module::mapping, Module::command_centre, text(entry)).value());
  EXPECT_EQ(read.error_code, 302);
  EXPECT_FALSE(back(Module::carrier, Module::communication, "ready:70000:0"));
}

TEST(SeedPayload, RefusesWhatTheSeedsVariablesDoNotHold) {
  EXPECT_EQ(text(Pose{.x_m = 6'000}), "! a place or an angle is no number, or beyond 5 km");
  EXPECT_EQ(text(Pose{.x_m = 0, .y_m = 0, .yaw_rad = std::nan("")}),
            "! a place or an angle is no number, or beyond 5 km");
  EXPECT_EQ(text(Distances{.left_m = -1, .right_m = std::nullopt, .front_m = std::nullopt}),
            "! a place or an angle is no number, or beyond 5 km");
  EXPECT_FALSE(write(PointOfInterest{.text = std::string(201, 'a')}));
  EXPECT_FALSE(write(PointOfInterest{.text = "\""}));
  EXPECT_FALSE(back(Module::mapping, Module::planner, "600000:0:0"));
  EXPECT_FALSE(back(Module::mapping, Module::planner, "1:2"));
  auto const nowhere = back(Module::visualizer, Module::planner, "hello");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().message, "VSL says nothing of that kind to PLN");
}

}  // namespace
}  // namespace lapwing::robot::seed_text
