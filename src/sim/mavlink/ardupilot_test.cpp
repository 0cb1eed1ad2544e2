// Where ArduPilot 4.6 surprises: what was seen on it in the loop, beyond what the other tests ask of a vehicle. The
// table that asks the same of a real one is tests/peers/the_simulator_answers_like_ardupilot.py.
#include <cmath>
#include <cstring>
#include <map>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using mavlink::MavResult;
using mavlink::MissionState;

TEST(ArduPilotsWays, ADisarmedCopterEntersAutoWithoutAMission) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_EQ(ground.set_mode(copter_auto), MavResult::accepted);
  EXPECT_EQ(ground.pilot().mode().name, "AUTO");
  EXPECT_EQ(ground.pilot().mission().state(), MissionState::no_mission);
  EXPECT_EQ(ground.command(MavCmd::mission_start), MavResult::accepted);
  EXPECT_EQ(ground.arm(), MavResult::failed);
  EXPECT_EQ(ground.said("Arm: Mode requires mission"), 1);
}

TEST(ArduPilotsWays, ADisarmedCopterStartsAMissionByChangingTheModeOnly) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_EQ(ground.command(MavCmd::mission_start), MavResult::accepted);
  EXPECT_EQ(ground.pilot().mode().name, "AUTO");
  EXPECT_FALSE(ground.pilot().armed());
}

TEST(ArduPilotsWays, AnArmedCopterRefusesAutoWithoutAMission) {
  TestGround ground("copter");
  ground.arm_in(copter_guided);
  EXPECT_EQ(ground.set_mode(copter_auto), MavResult::failed);
  EXPECT_EQ(ground.command(MavCmd::mission_start), MavResult::failed);
  EXPECT_EQ(ground.said("Mode change to AUTO failed: init failed"), 2);
  EXPECT_TRUE(ground.pilot().armed());
}

TEST(ArduPilotsWays, ARoverRefusesAutoWithoutAMissionAlwaysAndSaysSo) {
  TestGround ground("rover");
  ground.boot();
  EXPECT_EQ(ground.set_mode(rover_auto), MavResult::failed);
  EXPECT_EQ(ground.said("No Mission. Can't set AUTO."), 1);
  EXPECT_EQ(ground.said("Flight mode change failed"), 1);
}

TEST(ArduPilotsWays, ADisarmedVehicleEntersModesThatNeedAPositionWithoutOne) {
  auto options = WorldOptions{};
  options.boot = BootStyle::realistic;
  TestGround ground("copter", options);
  ground.run_for(5s);
  constexpr int loiter = 5;
  EXPECT_EQ(ground.set_mode(loiter), MavResult::accepted);
}

TEST(ArduPilotsWays, ModesThatNeedAPilotOrEquipmentAreRefused) {
  TestGround ground("copter");
  ground.boot();
  for (int const mode : {14, 15, 22, 25, 28}) EXPECT_EQ(ground.set_mode(mode), MavResult::failed) << mode;
  EXPECT_EQ(ground.pilot().mode().name, "STABILIZE");
  EXPECT_EQ(ground.said("Mode change to FLIP failed: init failed"), 1);
  EXPECT_EQ(ground.said("No axis selected, SID_AXIS = 0"), 1);
  constexpr int throwing = 18;
  EXPECT_EQ(ground.set_mode(throwing), MavResult::accepted) << "one begins a throw disarmed";
}

TEST(ArduPilotsWays, ARoverStaysInAutoAndArmedAfterItsMission) {
  TestGround ground("rover");
  auto const make = ground.maker();
  ground.arm_in(rover_auto, {make.waypoint(0, 0, 0), make.waypoint(20, 0, 0)});
  ASSERT_TRUE(ground.run_until([&] { return ground.said("Mission Complete") > 0; }, 60s));
  ground.run_for(30s);
  EXPECT_EQ(ground.pilot().mode().name, "AUTO");
  EXPECT_TRUE(ground.pilot().armed());
  EXPECT_EQ(ground.pilot().mission().state(), MissionState::complete);
  EXPECT_LT(ground.pilot().body().ground_speed_m_s(), 0.2);
  EXPECT_EQ(ground.command(MavCmd::mission_start), MavResult::accepted);
  ground.run_for(5s);
  EXPECT_EQ(ground.pilot().mission().state(), MissionState::complete) << "it is in AUTO already";
}

TEST(ArduPilotsWays, ACopterThatMeetsTheGroundOnItsWayStandsThereArmed) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(10), make.waypoint(60, 0, -30), make.waypoint(200, 0, -30)});
  ASSERT_TRUE(ground.run_until([&] { return ground.said("SIM Hit ground") > 0; }, 120s));
  auto const where = ground.from_start();
  ground.run_for(20s);
  EXPECT_TRUE(ground.pilot().armed());
  EXPECT_EQ(ground.pilot().mode().name, "AUTO");
  EXPECT_NEAR(ground.from_start(), where, 0.5);
  EXPECT_EQ(ground.pilot().landed_state(), mavlink::MavLandedState::in_air) << "as far as it knows";
  EXPECT_EQ(ground.command(MavCmd::component_arm_disarm, {0, 0}), MavResult::failed);
}

TEST(ArduPilotsWays, APlaneInAutoWithoutAMissionIsAtItsEndAtOnce) {
  TestGround ground("plane");
  ground.boot();
  EXPECT_EQ(ground.set_mode(plane_auto), MavResult::accepted);
  ground.run_for(1s);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  EXPECT_EQ(ground.said("Mission complete, changing mode to RTL"), 1);
  EXPECT_EQ(ground.arm(), MavResult::failed);
}

TEST(ArduPilotsWays, APlaneHasNoModesOfOneThatHovers) {
  TestGround ground("plane");
  ground.boot();
  for (int const mode : {17, 18, 19, 20, 21, 22, 23, 24}) EXPECT_EQ(ground.set_mode(mode), MavResult::failed) << mode;
  EXPECT_EQ(ground.said("Q_ENABLE 0"), 7);
  EXPECT_EQ(ground.said("Flight mode change failed"), 1);
}

TEST(ArduPilotsWays, APlaneStartsItsLandingWhereItsMissionHasOne) {
  TestGround ground("plane");
  auto const make = ground.maker();
  ground.boot();
  EXPECT_EQ(ground.command(MavCmd::do_land_start), MavResult::failed);
  EXPECT_EQ(ground.said("Unable to start landing sequence"), 1);
  auto land_start = make.waypoint(0, 0, 0);
  land_start.command = MavCmd::do_land_start;
  ground.upload(
      {make.waypoint(0, 0, 0), make.take_off(30), make.waypoint(300, 0, 40), land_start, make.waypoint(100, 0, 30)});
  EXPECT_EQ(ground.command(MavCmd::do_land_start), MavResult::accepted);
  EXPECT_EQ(ground.pilot().mode().name, "AUTO");
  EXPECT_EQ(ground.pilot().mission().current(), 3);
}

TEST(ArduPilotsWays, ASpeedControllerSpeaksWhereAMotorIs) {
  TestGround copter("copter");
  TestGround rover("rover");
  for (auto* ground : {&copter, &rover}) {
    ground->boot();
    EXPECT_EQ(ground->command(MavCmd::set_message_interval, {11030, 1e6F}), MavResult::accepted);
    EXPECT_EQ(ground->command(MavCmd::set_message_interval, {11031, 1e6F}), MavResult::denied);
  }
  EXPECT_EQ(copter.command(MavCmd::request_message, {11030}), MavResult::accepted);
  EXPECT_EQ(rover.command(MavCmd::request_message, {11030}), MavResult::failed);
}

TEST(ArduPilotsWays, ARoverTellsWhereItSteersInAutomaticModesOnly) {
  TestGround ground("rover");
  ground.boot();
  constexpr int nav_controller_output = 62;
  EXPECT_EQ(ground.set_mode(4), MavResult::accepted);
  EXPECT_EQ(ground.command(MavCmd::request_message, {nav_controller_output}), MavResult::failed);
  EXPECT_EQ(ground.set_mode(15), MavResult::accepted);
  EXPECT_EQ(ground.command(MavCmd::request_message, {nav_controller_output}), MavResult::accepted);
}

TEST(ArduPilotsWays, ACopterSentBelowTheGroundInGuidedModeHitsItAndStaysArmed) {
  TestGround ground("copter");
  ground.hover(10);
  ground.go_to(50, 0, -20, 60s);
  EXPECT_GT(ground.said("SIM Hit ground"), 0);
  EXPECT_TRUE(ground.pilot().armed());
  EXPECT_EQ(ground.pilot().mode().name, "GUIDED");
}

TEST(ArduPilotsWays, ServosThatAreFreeAndTheFirstRelayAreSet) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_EQ(ground.command(MavCmd::do_set_servo, {9, 1500}), MavResult::accepted);
  EXPECT_EQ(ground.command(MavCmd::do_set_servo, {1, 1500}), MavResult::failed);
  EXPECT_EQ(ground.said("ServoRelayEvent: Channel 1 is already in use"), 1);
  EXPECT_EQ(ground.command(MavCmd::do_set_servo, {40, 1500}), MavResult::failed);
  EXPECT_EQ(ground.command(MavCmd::do_set_relay, {0, 1}), MavResult::accepted);
  EXPECT_EQ(ground.command(MavCmd::do_set_relay, {5, 1}), MavResult::failed);
  TestGround px4("px4");
  px4.boot();
  EXPECT_EQ(px4.command(MavCmd::do_set_servo, {9, 1500}), MavResult::unsupported);
}

TEST(ArduPilotsWays, MissionModeIsToldInAutoOnly) {
  TestGround ground("copter");
  ground.boot();
  ground.request(mavlink::MessageId::mission_current, 5.0);
  ground.run_for(1s);
  EXPECT_EQ(ground.last<mavlink::MissionCurrent>()->mission_mode, 0);
  ground.set_mode(copter_auto);
  ground.run_for(1s);
  EXPECT_EQ(ground.last<mavlink::MissionCurrent>()->mission_mode, 1);
}

TEST(ArduPilotsWays, ABadFenceIsToldTwice) {
  TestGround ground("copter");
  ground.boot();
  auto corner = ground.maker().at(MavCmd::nav_fence_polygon_vertex_inclusion, {20, 20, 0}, {2});
  corner.type = mavlink::MissionType::fence;
  EXPECT_EQ(ground.upload({corner, corner}), mavlink::MavMissionResult::error);
  EXPECT_EQ(ground.said("Invalid vertex count (2)"), 1);
  EXPECT_EQ(ground.said("Fence validation failed"), 1);
}

TEST(ArduPilotsWays, NobodyReadsAMissionThatIsBeingWritten) {
  TestGround ground("copter");
  ground.boot();
  ground.send(mavlink::MissionCount{.count = 3});
  ground.run_for(100ms);
  ground.send(mavlink::MissionRequestInt{.seq = 0});
  ground.run_for(100ms);
  ASSERT_TRUE(ground.last<mavlink::MissionAck>());
  EXPECT_EQ(ground.last<mavlink::MissionAck>()->result, mavlink::MavMissionResult::denied);
}

/// What comes beside the typed messages, by message id.
struct Sensors {
  explicit Sensors(std::string_view vehicles) : ground(vehicles) {
    ground.gcs.set_frame_hook(
        [this](mavlink::Connection::Direction direction, mavlink::Frame const& frame, base::TimePoint) {
          if (direction != mavlink::Connection::Direction::received) return;
          ++counts[frame.message_id];
          frames[frame.message_id] = frame;
        });
    ground.boot();
  }
  template <class Number>
  [[nodiscard]] Number field(std::uint32_t id, std::size_t offset) {
    Number number{};
    std::memcpy(&number, frames.at(id).payload.data() + offset, sizeof number);
    return number;
  }

  TestGround ground;
  std::map<std::uint32_t, int> counts;
  std::map<std::uint32_t, mavlink::Frame> frames;
};
constexpr std::uint32_t raw_imu = 27;
constexpr std::uint32_t scaled_pressure = 29;
constexpr std::uint32_t servo_output_raw = 36;
constexpr std::size_t first_of_imu = 8;     // after a time of 64 bits
constexpr std::size_t first_of_servos = 4;  // after one of 32

TEST(Sensors, StreamWhenTheyAreAskedFor) {
  Sensors vehicle("copter");
  vehicle.ground.run_for(2s);
  EXPECT_EQ(vehicle.counts[raw_imu], 0);
  vehicle.ground.send(mavlink::RequestDataStream{.stream = 0, .rate_hz = 4, .start = true});
  vehicle.ground.run_for(5s);
  for (std::uint32_t const id : {27, 116, 29, 125, 152, 36, 178, 163, 241})
    EXPECT_NEAR(vehicle.counts[id], 20, 2) << "message " << id;
}

TEST(Sensors, FeelWeightAndTheAirAtRest) {
  Sensors vehicle("copter");
  EXPECT_EQ(vehicle.ground.command(MavCmd::request_message, {raw_imu}), MavResult::accepted);
  EXPECT_EQ(vehicle.ground.command(MavCmd::request_message, {scaled_pressure}), MavResult::accepted);
  EXPECT_EQ(vehicle.ground.command(MavCmd::request_message, {servo_output_raw}), MavResult::accepted);
  EXPECT_EQ(vehicle.field<std::int16_t>(raw_imu, first_of_imu), 0);
  EXPECT_EQ(vehicle.field<std::int16_t>(raw_imu, first_of_imu + 4), -1000) << "mg, down is positive";
  EXPECT_NEAR(vehicle.field<float>(scaled_pressure, 4), 1002.5, 0.5) << "hPa at 90 m";
  EXPECT_EQ(vehicle.field<std::uint16_t>(servo_output_raw, first_of_servos), 1000);
}

TEST(Sensors, FeelFlight) {
  Sensors vehicle("copter");
  EXPECT_EQ(vehicle.ground.set_mode(copter_guided), MavResult::accepted);
  EXPECT_EQ(vehicle.ground.arm(), MavResult::accepted);
  EXPECT_EQ(vehicle.ground.command(MavCmd::nav_takeoff, {0, 0, 0, 0, 0, 0, 20}), MavResult::accepted);
  vehicle.ground.run_for(20s);
  EXPECT_EQ(vehicle.ground.command(MavCmd::request_message, {servo_output_raw}), MavResult::accepted);
  EXPECT_NEAR(vehicle.field<std::uint16_t>(servo_output_raw, first_of_servos), 1400, 60) << "hovers";
  vehicle.ground.go_to(200, 0, 20, 2s);
  EXPECT_EQ(vehicle.ground.command(MavCmd::request_message, {raw_imu}), MavResult::accepted);
  EXPECT_LT(std::abs(vehicle.field<std::int16_t>(raw_imu, first_of_imu)), 120)
      << "leaning, it feels its own thrust and little else";
  EXPECT_LT(vehicle.field<std::int16_t>(raw_imu, first_of_imu + 4), -1000) << "which is more than its weight";
}

TEST(Sensors, ShowTheWheelsOfARover) {
  Sensors vehicle("rover");
  EXPECT_EQ(vehicle.ground.command(MavCmd::request_message, {servo_output_raw}), MavResult::accepted);
  EXPECT_EQ(vehicle.field<std::uint16_t>(servo_output_raw, first_of_servos), 1500);
  EXPECT_EQ(vehicle.ground.set_mode(rover_guided), MavResult::accepted);
  EXPECT_EQ(vehicle.ground.arm(), MavResult::accepted);
  vehicle.ground.go_to(100, 0, 0, 6s);
  EXPECT_EQ(vehicle.ground.command(MavCmd::request_message, {servo_output_raw}), MavResult::accepted);
  EXPECT_GT(vehicle.field<std::uint16_t>(servo_output_raw, first_of_servos + 4), 1700);
}

TEST(Home, IsAsFarOffAsTheWorldSays) {
  WorldOptions options;
  options.altitude_error_m = 0.09;
  TestGround ground("copter,px4", options);
  ground.boot();
  ground.command(MavCmd::get_home_position);
  ground.run_for(100ms);
  ASSERT_TRUE(ground.last<mavlink::HomePosition>());
  EXPECT_NEAR(ground.last<mavlink::HomePosition>()->position.value().alt_m, 90.09, 0.005);
  EXPECT_NEAR(ground.last<mavlink::HomePosition>(2)->position.value().alt_m, 90.0, 0.005);
}

}  // namespace
}  // namespace lapwing::sim
