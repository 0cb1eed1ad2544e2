// From a vehicle's bytes to the station's JSON: whatever the fields of its messages hold, what viewers are told can be.
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "fleet/network/fleet.hpp"
#include "link/pipe_link.hpp"
#include "mavlink/wire/dialect_names.hpp"
#include "station/feeds/pictures_feed.hpp"
#include "station/feeds/plans_feed.hpp"
#include "station/feeds/vehicles_feed.hpp"

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;
using mavlink::FieldName;
using mavlink::Frame;
using mavlink::WireType;
using nlohmann::json;

struct Bounds {
  double lowest;
  double highest;
};

/// Of every number that a viewer can get about a vehicle, by its key. One that is missing here fails the test: whoever
/// adds a number says what it can be.
std::map<std::string, Bounds> const bounds{
    {"lat_deg", {-90, 90}},
    {"lon_deg", {-180, 180}},
    {"alt_m", {-12'000, 60'000}},
    {"relative_alt_m", {-12'000, 60'000}},
    {"north", {-300, 300}},
    {"east", {-300, 300}},
    {"down", {-300, 300}},
    {"roll", {-12.6, 12.6}},
    {"pitch", {-12.6, 12.6}},
    {"yaw", {-12.6, 12.6}},
    {"roll_rad", {-12.6, 12.6}},
    {"pitch_rad", {-12.6, 12.6}},
    {"yaw_rad", {-12.6, 12.6}},
    {"heading_rad", {0, 6.2832}},
    {"from_rad", {0, 6.2832}},
    {"speed_m_s", {0, 215}},
    {"airspeed_m_s", {0, 300}},
    {"climb_m_s", {-300, 300}},
    {"throttle", {0, 1}},
    {"remaining", {0, 1}},
    {"voltage_v", {0, 1000}},
    {"current_a", {-100, 1000}},
    {"consumed_ah", {0, 2000}},
    {"time_left_s", {0, 7 * 86'400}},
    {"satellites", {0, 254}},
    {"hdop", {0, 100}},
    {"velocity", {0, 1e9}},
    {"position_horizontal", {0, 1e9}},
    {"position_vertical", {0, 1e9}},
    {"compass", {0, 1e9}},
    {"channels", {0, 255}},
    {"pulses_us", {0, 65'534}},
    {"rssi", {0, 254}},
    {"remote_rssi", {0, 254}},
    {"noise", {0, 254}},
    {"remote_noise", {0, 254}},
    {"buffer_free", {0, 1}},
    {"receive_errors", {0, 65'535}},
    {"breaches", {0, 65'535}},
    {"current", {0, 65'535}},
    {"total", {0, 65'535}},
    {"waypoint_distance_m", {0, 65'535}},
    {"taken", {0, 1e7}},
    {"lost", {0, 1e7}},
    {"number", {0, 1e7}},
    {"track_m", {0, 2e7}},
    {"loss", {0, 1}},
    {"messages_per_s", {0, 1e6}},
    {"bytes_per_s", {0, 1e9}},
    {"round_trip_s", {0, 3600}},
    {"severity", {0, 255}},
    {"component", {0, 255}},
    {"id", {0, 255}},
    {"system_id", {0, 255}},
    {"time_s", {0, 1e9}},
};

/// Every number in there can be. `key` is that of the value itself, or of the list that it stands in.
void expect_possible(json const& value, std::string const& key) {
  if (value.is_object())
    for (auto const& [name, inner] : value.items()) expect_possible(inner, key == "age_s" ? key : name);
  if (value.is_array())
    for (auto const& inner : value) expect_possible(inner, key);
  if (value.is_null()) {
    EXPECT_EQ(key, "pulses_us") << "a number that JSON cannot hold";
  }
  if (!value.is_number()) return;
  auto const number = value.get<double>();
  if (key == "age_s") {
    EXPECT_GE(number, 0.0);
    return;
  }
  auto const known = bounds.find(key);
  ASSERT_NE(known, bounds.end()) << key << " is a number of which this test does not know what it can be";
  EXPECT_GE(number, known->second.lowest) << key;
  EXPECT_LE(number, known->second.highest) << key;
}

std::size_t size_of(WireType type) {
  switch (type) {
    case WireType::char_:
    case WireType::uint8_:
    case WireType::int8_: return 1;
    case WireType::uint16_:
    case WireType::int16_: return 2;
    case WireType::uint32_:
    case WireType::int32_:
    case WireType::float_: return 4;
    case WireType::uint64_:
    case WireType::int64_:
    case WireType::double_: return 8;
  }
  return 1;
}

enum class Extreme { lowest, highest, minus_one, zero, sevens, eights, not_a_number, infinite, minus_infinite, any };
constexpr auto extremes =
    std::to_array({Extreme::lowest, Extreme::highest, Extreme::minus_one, Extreme::zero, Extreme::sevens,
                   Extreme::eights, Extreme::not_a_number, Extreme::infinite, Extreme::minus_infinite, Extreme::any});

template <class T>
void put(T value, std::uint8_t* at) {
  std::memcpy(at, &value, sizeof(value));
}

void put_real(WireType type, double value, std::uint8_t* at) {
  if (type == WireType::float_) put(static_cast<float>(value), at);
  if (type == WireType::double_) put(value, at);
}

/// As bytes, little-endian; those of floats by their meaning.
void put(Extreme extreme, WireType type, std::mt19937& random, std::uint8_t* at) {
  auto const size = size_of(type);
  bool const is_real = type == WireType::float_ || type == WireType::double_;
  bool const is_signed =
      type == WireType::int8_ || type == WireType::int16_ || type == WireType::int32_ || type == WireType::int64_;
  using Limits = std::numeric_limits<double>;
  using FloatLimits = std::numeric_limits<float>;
  switch (extreme) {
    case Extreme::zero: std::fill_n(at, size, std::uint8_t{0}); break;
    case Extreme::minus_one: std::fill_n(at, size, std::uint8_t{0xFF}); break;
    case Extreme::sevens: std::fill_n(at, size, std::uint8_t{0x7F}); break;
    case Extreme::eights: std::fill_n(at, size, std::uint8_t{0x80}); break;
    case Extreme::lowest:
      std::fill_n(at, size, std::uint8_t{0});
      if (is_signed) at[size - 1] = 0x80;
      break;
    case Extreme::highest:
      std::fill_n(at, size, std::uint8_t{0xFF});
      if (is_signed) at[size - 1] = 0x7F;
      break;
    default:
      for (std::size_t i = 0; i < size; ++i) at[i] = static_cast<std::uint8_t>(random());
  }
  if (!is_real) return;
  if (extreme == Extreme::lowest) put_real(type, double{FloatLimits::lowest()}, at);
  if (extreme == Extreme::highest) put_real(type, double{FloatLimits::max()}, at);
  if (extreme == Extreme::minus_one) put_real(type, -1.0, at);
  if (extreme == Extreme::not_a_number) put_real(type, Limits::quiet_NaN(), at);
  if (extreme == Extreme::infinite) put_real(type, Limits::infinity(), at);
  if (extreme == Extreme::minus_infinite) put_real(type, -Limits::infinity(), at);
}

struct Sky {
  Sky() {
    connection.add_link(hub.take_server());
    vehicle->start([](link::Peer, link::Bytes) {});
    say(mavlink::encode(
        mavlink::Heartbeat{.type = mavlink::MavType::quadrotor, .autopilot = mavlink::MavAutopilot::ardupilotmega},
        {7, 1}, 0));
    pass(100ms);
  }
  void pass(base::Duration time) { loop.run_until_done(nap(time)); }
  base::Task<> nap(base::Duration time) { co_await loop.sleep(time); }
  void say(Frame frame) {
    frame.seq = seq++;
    vehicle->send(vehicle->standing_peers().front(), mavlink::serialize(frame).bytes());
  }
  void expect_possible_news() {
    for (auto& [feed, had] : feeds) {
      auto const revision = feed->refresh(loop.now());
      for (auto const& frame : feed->since(had, loop.now(), 0).frames) {
        auto const message = json::parse(frame.content);
        for (auto const& key : {"vehicles", "pictures", "path"})
          if (message.contains(key)) expect_possible(message[key], key);
      }
      had = revision;
    }
  }
  void expect_possible_picture() {
    for (auto const& [feed, had] : feeds)
      for (auto const& frame : feed->since(0, loop.now(), 0).frames) expect_possible(json::parse(frame.content), "");
  }

  base::Loop loop{{.unpaced = true}};
  base::LogHub log;
  link::PipeHub hub{loop};
  mavlink::Connection connection{loop, {}, base::Logger(log, "mavlink")};
  vehicle::Registry registry{loop};
  vehicle::Authority authority{loop, registry, base::Logger(log, "command")};
  fleet::Fleet fleet{connection, registry, authority, {}, base::Logger(log, "fleet")};
  station::VehiclesFeed vehicles{registry};
  station::PlansFeed plans{registry};
  station::PicturesFeed pictures{registry};
  std::vector<std::pair<station::Feed*, std::uint64_t>> feeds{{&vehicles, 0}, {&plans, 0}, {&pictures, 0}};
  std::unique_ptr<link::ByteLink> vehicle = hub.connect();
  std::uint8_t seq = 0;
};

/// One frame of each kind of message that Lapwing reads, whose values can be.
std::vector<Frame> golden_frames() {
  std::ifstream file(LAPWING_SOURCE_DIR "/tests/golden/mavlink/frames.txt");
  std::vector<Frame> all;
  std::string name;
  std::string hex;
  while (file >> name >> hex) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
      bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    mavlink::FrameParser().feed(bytes, [&](Frame const& frame) {
      all.push_back(frame);
      all.back().source = {7, 1};
    });
  }
  return all;
}

/// The fields by which a frame is passed on or taken for one of another kind stay as they are.
bool is_address(FieldName const& field) {
  return field.name.starts_with("target_") || field.name == "param_id";
}

/// Sets one field, or, with `only` nothing, all.
Frame spoilt(Frame frame, mavlink::MessageName const& message, FieldName const* only, Extreme extreme,
             std::mt19937& random) {
  for (auto const& field : message.fields) {
    if (is_address(field) || (only && only != &field)) continue;
    auto const size = size_of(field.type);
    for (std::size_t i = 0; i < std::max<std::size_t>(field.length, 1); ++i)
      put(extreme, field.type, random, frame.payload.data() + field.offset + i * size);
  }
  frame.payload_size = static_cast<std::uint8_t>(mavlink::find_traits(frame.message_id)->max_size);
  return frame;
}

TEST(ImpossibleValues, NeverReachViewersWhateverAnyFieldOfAnyMessageHolds) {
  Sky sky;
  std::mt19937 random(11);
  auto const frames = golden_frames();
  ASSERT_GT(frames.size(), 50U);
  std::size_t said = 0;
  for (auto const& golden : frames) {
    auto const name = mavlink::message_name(golden.message_id);
    if (name.empty()) continue;  // of the development dialect: mode lists, without a quantity
    SCOPED_TRACE(name);
    auto const message = *mavlink::find_message(name);
    for (auto const extreme : extremes) {
      SCOPED_TRACE(static_cast<int>(extreme));
      sky.say(spoilt(golden, message, nullptr, extreme, random));
      for (auto const& field : message.fields) {
        SCOPED_TRACE(field.name);
        sky.say(spoilt(golden, message, &field, extreme, random));
        sky.pass(1ms);
        sky.expect_possible_news();
        ++said;
        if (HasFailure()) return;
      }
    }
  }
  sky.expect_possible_picture();
  EXPECT_GT(said, 3000U);
  EXPECT_TRUE(sky.registry.find({"7"})->motion.position.known()) << "the honest ones among them were heard";
}

TEST(ImpossibleValues, LeaveWhatIsHonestInTheSameMessage) {
  Sky sky;
  auto const message = *mavlink::find_message("GLOBAL_POSITION_INT");
  mavlink::GlobalPosition honest{.position = geo::Wgs84::from_degrees(41.0, -8.0, 100.0),
                                 .relative_alt_m = 12.5,
                                 .velocity_m_s = geo::Ned{1.0, 2.0, 0.0},
                                 .heading_rad = 1.0};
  sky.say(mavlink::encode(honest, {7, 1}, 0));
  sky.pass(1ms);
  honest.relative_alt_m = 13.5;
  auto frame = mavlink::encode(honest, {7, 1}, 0);
  put(std::int32_t{2'140'000'000}, frame.payload.data() + message.fields[1].offset);
  ASSERT_EQ(message.fields[1].name, "lat");
  sky.say(frame);
  sky.pass(1ms);
  auto const& state = *sky.registry.find({"7"});
  EXPECT_NEAR(state.motion.position.value->lat_deg(), 41.0, 1e-6);
  EXPECT_NEAR(*state.motion.relative_alt_m.value, 13.5, 1e-9);
  EXPECT_LT(state.motion.position.heard, state.motion.relative_alt_m.heard) << "and the place grows old";
}

}  // namespace
}  // namespace lapwing::host
