#include "parameters/service.hpp"

#include <bit>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"
#include "link/pipe_link.hpp"

namespace lapwing::parameters {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

base::Task<> pass(base::Loop& loop, base::Duration time) {
  co_await loop.sleep(time);
}

/// A vehicle with parameters and an identity.
class Owner {
 public:
  Owner(base::Loop& loop, std::unique_ptr<link::ByteLink> link, std::uint8_t id)
      : connection(loop, {.self = {id, autopilot_component}, .heartbeat = [] { return heartbeat(); }}, {}),
        subscription_(connection.subscribe([this](Received const& received) { take(received.message); })),
        scope_(loop) {
    version.uid2.fill(id);
    connection.add_link(std::move(link));
  }
  void tell(std::size_t i, bool in_list) {
    connection.send_to_all(ParamValue{.name = "P" + std::to_string(i),
                                      .value = std::bit_cast<float>(values[i]),
                                      .type = MavParamType::int32,
                                      .count = static_cast<std::uint16_t>(values.size()),
                                      .index = in_list ? static_cast<std::uint16_t>(i) : std::uint16_t{65535}});
  }

  Connection connection;
  std::vector<std::int32_t> values = std::vector<std::int32_t>(100, 7);
  AutopilotVersion version{.capabilities = capability_flag::param_encode_bytewise};
  std::optional<std::uint32_t> hash;
  int lists = 0;
  std::vector<std::string> asked;  ///< "list" and what was read

 private:
  static Heartbeat heartbeat() { return {.type = MavType::quadrotor, .autopilot = MavAutopilot::px4}; }
  void take(Message const& message) {
    auto const target = target_of(message);
    if (target && target->system != connection.self().system) return;
    if (auto const* command = std::get_if<CommandLong>(&message);
        command && command->command == MavCmd::request_message)
      connection.send_to_all(version);
    if (std::get_if<ParamRequestList>(&message)) {
      asked.emplace_back("list");
      if (++lists == 1 || !busy_) scope_.spawn(stream());
    }
    if (auto const* read = std::get_if<ParamRequestRead>(&message)) answer(*read);
    if (auto const* set = std::get_if<ParamSet>(&message)) {
      auto const i = static_cast<std::size_t>(std::stoi(set->name.substr(1)));
      values[i] = std::bit_cast<std::int32_t>(set->value);
      tell(i, false);
    }
  }
  void answer(ParamRequestRead const& read) {
    if (read.index >= 0) return tell(static_cast<std::size_t>(read.index), true);
    asked.push_back(read.name);
    if (read.name == hash_param) {
      if (hash)
        connection.send_to_all(ParamValue{
            .name = hash_param, .value = std::bit_cast<float>(*hash), .type = MavParamType::uint32, .count = 100});
      return;
    }
    tell(static_cast<std::size_t>(std::stoi(read.name.substr(1))), false);
  }
  base::Task<> stream() {
    busy_ = true;
    if (hash)
      connection.send_to_all(ParamValue{
          .name = hash_param, .value = std::bit_cast<float>(*hash), .type = MavParamType::uint32, .count = 100});
    for (std::size_t i = 0; i < values.size(); ++i) {
      tell(i, true);
      co_await connection.loop().sleep(5ms);
    }
    busy_ = false;
  }

  Subscription subscription_;
  bool busy_ = false;
  base::Scope scope_;
};

struct Service : ::testing::Test {
  void SetUp() override {
    ground.add_link(hub.take_server());
    service.emplace(ground, Cache(folder), base::Logger());
    first.emplace(loop, hub.connect(), 1);
    second.emplace(loop, hub.connect(), 2);
    loop.run_until_done(pass(loop, 2s));
    ASSERT_EQ(service->vehicles().size(), 2u);
  }
  void TearDown() override { service.reset(); }
  /// As a program that is started anew.
  void restart() {
    service.reset();
    service.emplace(ground, Cache(folder), base::Logger());
    loop.run_until_done(pass(loop, 2s));
  }
  Snapshot all(Wanted wanted = Wanted::confirmed) {
    auto got = loop.run_until_done(service->all(1, wanted));
    EXPECT_TRUE(got) << got.error().message;
    return got.value_or(Snapshot{});
  }

  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  link::PipeHub hub{loop};
  Connection ground{loop, {}, {}};
  base::testing::TemporaryFolder temporary;
  std::filesystem::path const folder = temporary.path();
  std::optional<ParameterService> service;
  std::optional<Owner> first;
  std::optional<Owner> second;
};

TEST_F(Service, DownloadsNothingUntilSomebodyAsks) {
  loop.run_until_done(pass(loop, 20s));
  EXPECT_TRUE(first->asked.empty());
  auto const value = loop.run_until_done(service->read(1, "P5"));
  ASSERT_TRUE(value);
  EXPECT_EQ(value->value, 7);
  EXPECT_EQ(first->asked, (std::vector<std::string>{"P5"})) << "one read is no list";
}

TEST_F(Service, KeepsIntegersExact) {
  auto const changed = loop.run_until_done(service->change(1, "P3", 2147483647.0));
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(first->values[3], 2147483647);
  EXPECT_EQ(changed->after.value, 2147483647.0);
}

TEST_F(Service, AsksAgainWhenNothingConfirmsTheCache) {
  all();
  first->values[9] = 42;  // while nobody listens
  restart();
  auto const now = all();
  EXPECT_EQ(first->lists, 2);
  EXPECT_EQ(now.confirmed, Confirmed::by_vehicle);
  EXPECT_EQ(now.parameters[9].value, 42);
}

TEST_F(Service, ServesTheCacheWhenTheHashConfirmsIt) {
  first->hash = 0xC0FFEE;
  all();
  restart();
  auto const again = all();
  EXPECT_EQ(first->lists, 1);
  EXPECT_EQ(again.confirmed, Confirmed::by_hash);
  EXPECT_EQ(again.parameters.size(), 100u);
  first->hash = 0xC0FFEF;
  first->values[0] = 1;
  restart();
  EXPECT_EQ(all().parameters[0].value, 1);
  EXPECT_EQ(first->lists, 2);
}

TEST_F(Service, MarksOldValuesForThoseWhoTakeThem) {
  all();
  restart();
  auto const old = all(Wanted::cached_too);
  EXPECT_EQ(old.confirmed, Confirmed::not_at_all);
  EXPECT_EQ(first->lists, 1);
}

TEST_F(Service, CorrectsTheCacheByWhatVehiclesSayUnasked) {
  first->hash = 1;
  all();
  first->values[8] = 88;
  first->tell(8, false);
  loop.run_until_done(pass(loop, 1s));
  restart();
  EXPECT_EQ(all(Wanted::cached_too).parameters[8].value, 88);
  (void)all();
  EXPECT_EQ(first->lists, 2) << "the old hash confirms it no more";
}

TEST_F(Service, ForgetsACacheOfAnotherLength) {
  all();
  first->values.push_back(1);
  restart();
  (void)loop.run_until_done(service->read(1, "P100"));
  EXPECT_EQ(all(Wanted::cached_too).parameters.size(), 101u);
}

TEST_F(Service, GivesNoVehicleTheCacheOfAnotherWithItsSystemId) {
  all();
  first->version.uid2.fill(99);
  restart();
  EXPECT_EQ(all(Wanted::cached_too).confirmed, Confirmed::by_vehicle);
}

base::Task<> note_end(base::Task<base::Result<Snapshot>> task, base::Loop& loop, base::TimePoint& ended) {
  auto const got = co_await task;
  EXPECT_TRUE(got);
  ended = loop.now();
}

TEST_F(Service, ListsOneVehicleAtATimeOnALink) {
  base::Scope scope(loop);
  base::TimePoint first_ended{};
  base::TimePoint second_ended{};
  auto const begun = loop.now();
  scope.spawn(note_end(service->all(1), loop, first_ended));
  scope.spawn(note_end(service->all(2), loop, second_ended));
  loop.run_until_done(pass(loop, 300ms));
  EXPECT_EQ(second->lists, 0);
  loop.run_until_done(pass(loop, 10s));
  EXPECT_GE(first_ended - begun, 495ms);
  EXPECT_GE(second_ended - first_ended, 495ms);
}

TEST_F(Service, WaitsForAMissionTransferOnTheLink) {
  base::Scope scope(loop);
  base::TimePoint ended{};
  for (int i = 0; i < 3; ++i) {
    second->connection.send_to_all(MissionRequest{.target = {255, 190}, .seq = static_cast<std::uint16_t>(i)});
    loop.run_until_done(pass(loop, 100ms));
    if (i == 0) scope.spawn(note_end(service->all(1), loop, ended));
  }
  EXPECT_EQ(first->lists, 0);
  second->connection.send_to_all(MissionAck{.target = {255, 190}});
  loop.run_until_done(pass(loop, 200ms));
  EXPECT_EQ(first->lists, 1) << "the transfer has ended";
  loop.run_until_done(pass(loop, 5s));
  EXPECT_NE(ended, base::TimePoint{});
}

TEST_F(Service, TakesAnotherVehicleOfTheSameIdForWhatItIs) {
  EXPECT_EQ(all().parameters[0].value, 7);
  first.reset();
  loop.run_until_done(pass(loop, 10s));
  first.emplace(loop, hub.connect(), 1);
  first->version.uid2.fill(99);
  first->values.assign(100, 8);
  loop.run_until_done(pass(loop, 2s));
  EXPECT_EQ(all(Wanted::cached_too).parameters[0].value, 8);
}

TEST_F(Service, KnowsOnlyVehiclesThatItHeard) {
  auto const got = loop.run_until_done(service->all(9));
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().kind, base::ErrorKind::lost);
}

TEST(Firmware, ReadsAsPeopleSayIt) {
  EXPECT_EQ(firmware_text(0x04060100), "4.6.1");
}

}  // namespace
}  // namespace lapwing::parameters
