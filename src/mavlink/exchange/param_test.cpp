#include "mavlink/exchange/param.hpp"

#include <bit>
#include <random>

#include <gtest/gtest.h>

#include "mavlink/exchange/param_list.hpp"
#include "mavlink/testing/fake_vehicle.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;
using enum MavParamType;

float wire_of(double value, MavParamType type, ParamEncoding encoding) {
  auto const wire = encode_param({.name = "X", .value = value, .type = type}, encoding);
  EXPECT_TRUE(wire) << value;
  return wire.value_or(0.0F);
}

std::string refusal(double value, MavParamType type, ParamEncoding encoding = ParamEncoding::c_cast) {
  auto const wire = encode_param({.name = "X", .value = value, .type = type}, encoding);
  EXPECT_FALSE(wire) << value;
  return wire ? "" : wire.error().message;
}

TEST(ParamValues, AreExactBothWaysByTheirBytes) {
  std::mt19937 random(1);
  for (int i = 0; i < 10'000; ++i) {
    auto const bits = static_cast<std::uint32_t>(random());
    for (auto const type : {uint8, int8, uint16, int16, uint32, int32}) {
      auto const value =
          decode_param({.value = std::bit_cast<float>(bits), .type = type}, ParamEncoding::bytewise).value;
      auto const wire = wire_of(value, type, ParamEncoding::bytewise);
      EXPECT_EQ(decode_param({.value = wire, .type = type}, ParamEncoding::bytewise).value, value);
    }
  }
  EXPECT_EQ(std::bit_cast<std::uint32_t>(wire_of(-1, int32, ParamEncoding::bytewise)), 0xFFFFFFFFU);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(wire_of(123456789, int32, ParamEncoding::bytewise)), 123456789U);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(wire_of(4294967295.0, uint32, ParamEncoding::bytewise)), 0xFFFFFFFFU);
  EXPECT_EQ(wire_of(0.1, real32, ParamEncoding::bytewise), 0.1F);
}

TEST(ParamValues, AreFloatsForAnAutopilotThatCasts) {
  EXPECT_EQ(wire_of(-7, int8, ParamEncoding::c_cast), -7.0F);
  EXPECT_EQ(wire_of(16777216, int32, ParamEncoding::c_cast), 16777216.0F);
  EXPECT_EQ(decode_param({.value = 1500, .type = int32}, ParamEncoding::c_cast).value, 1500);
}

TEST(ParamValues, AreRefusedWhereAnotherWouldBeStored) {
  EXPECT_NE(refusal(16777217, int32).find("16777216"), std::string::npos) << "a float has 24 bits";
  EXPECT_NE(refusal(1.5, int16).find("integer"), std::string::npos);
  EXPECT_NE(refusal(128, int8).find("-128 to 127"), std::string::npos);
  EXPECT_NE(refusal(-1, uint32, ParamEncoding::bytewise).find("0 to"), std::string::npos);
  EXPECT_NE(refusal(1e300, real32).find("too large"), std::string::npos);
  EXPECT_NE(refusal(std::nan(""), real32).find("not a number"), std::string::npos);
  EXPECT_NE(refusal(1, real64).find("real64"), std::string::npos);
}

TEST(ParamValues, AreComparedAsTheVehicleHoldsThem) {
  auto const same = [](double a, MavParamType a_type, double b, MavParamType b_type) {
    return same_value({"X", a, a_type}, {"X", b, b_type});
  };
  EXPECT_TRUE(same(0.1, real32, static_cast<double>(0.1F), real32));
  EXPECT_FALSE(same(123456789, int32, 123456788, real32)) << "though they are one float";
  EXPECT_TRUE(same(std::nan(""), real32, std::nan(""), real32));
  EXPECT_FALSE(same(1, int8, 2, int8));
}

TEST(ParamValues, ReadAsPeopleWriteThem) {
  EXPECT_EQ(value_text({.value = 1500, .type = int32}), "1500");
  EXPECT_EQ(value_text({.value = static_cast<double>(0.1F), .type = real32}), "0.1");
  EXPECT_EQ(value_text({.value = 3.5, .type = int8}), "3.5") << "nonsense is shown, not mended";
}

/// A vehicle with parameters as ArduPilot has them: a list in order, silence about what it lacks.
class Shelf {
 public:
  Shelf(FakeVehicle& vehicle, std::size_t count) : vehicle_(vehicle), scope_(vehicle.connection.loop()) {
    for (std::size_t i = 0; i < count; ++i)
      values.push_back({.name = "P" + std::to_string(i), .value = static_cast<float>(i), .type = int32});
    vehicle.on = [this](Message const& message) { take(message); };
  }
  void send(std::size_t index, bool in_list) {
    auto value = values[index];
    value.count = static_cast<std::uint16_t>(values.size());
    value.index = in_list ? static_cast<std::uint16_t>(index) : std::uint16_t{65535};
    vehicle_.answer(value);
  }

  std::vector<ParamValue> values;
  float limit = 1e9F;
  bool refuses = false;
  std::set<std::size_t> swallows;  ///< numbers that the list leaves out
  base::Duration pace = 1ms;       ///< between two of the list
  int lists = 0;
  int reads = 0;

 private:
  void take(Message const& message) {
    if (auto const* read = std::get_if<ParamRequestRead>(&message)) answer(*read);
    if (auto const* set = std::get_if<ParamSet>(&message)) store(*set);
    if (std::get_if<ParamRequestList>(&message)) begin_list();
  }
  void answer(ParamRequestRead const& read) {
    ++reads;
    if (read.index >= 0 && static_cast<std::size_t>(read.index) < values.size())
      return send(static_cast<std::size_t>(read.index), true);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i].name == read.name) send(i, false);
  }
  void store(ParamSet const& set) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i].name != set.name) continue;
      if (refuses) return vehicle_.answer(ParamError{.name = set.name, .error = MavParamError::read_only});
      values[i].value = std::min(set.value, limit);
      send(i, false);
    }
  }
  void begin_list() {
    ++lists;
    next_ = 0;
    if (!std::exchange(streaming_, true)) scope_.spawn(stream());
  }
  base::Task<void> stream() {
    while (next_ < values.size()) {
      auto const i = next_++;
      if (!swallows.contains(i)) send(i, true);
      co_await vehicle_.connection.loop().sleep(pace);
    }
    streaming_ = false;
  }

  FakeVehicle& vehicle_;
  std::size_t next_ = 0;
  bool streaming_ = false;
  base::Scope scope_;
};

base::Result<ParamList> download(Bench& bench, ParamListOptions options = {}) {
  return bench.loop.run_until_done(download_params(bench.ground, Bench::target, options));
}

TEST(Param, ReadsByNameAmongUnaskedValues) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (auto const* request = std::get_if<ParamRequestRead>(&message)) {
      bench.vehicle->answer(ParamValue{.name = "STAT_RUNTIME", .value = 99});
      bench.vehicle->answer(ParamValue{.name = request->name, .value = 1500});
    }
  };
  auto const value = bench.loop.run_until_done(read_param(bench.ground, Bench::target, "RTL_ALT"));
  ASSERT_TRUE(value);
  EXPECT_EQ(value->value, 1500);
}

TEST(Param, IsTheAutopilotsThoughAnotherComponentHasOneOfThatName) {
  Bench bench;
  FakeVehicle gimbal(bench.loop, bench.hub.connect(), {1, 154});
  bench.run_for(2s);
  bench.vehicle->on = [&](Message const& message) {
    auto const* request = std::get_if<ParamRequestRead>(&message);
    if (!request) return;
    gimbal.answer(ParamValue{.name = request->name, .value = 7});
    bench.vehicle->answer(ParamValue{.name = request->name, .value = 1500});
  };
  auto const value = bench.loop.run_until_done(read_param(bench.ground, Bench::target, "BRD_SERIAL_NUM"));
  ASSERT_TRUE(value);
  EXPECT_EQ(value->value, 1500);
}

TEST(Param, TimesOutOnANameThatTheVehicleDoesNotKnow) {
  Bench bench;
  auto const value = bench.loop.run_until_done(read_param(bench.ground, Bench::target, "NO_SUCH"));
  ASSERT_FALSE(value);
  EXPECT_EQ(value.error().kind, base::ErrorKind::timed_out);
  EXPECT_NE(value.error().message.find("NO_SUCH"), std::string::npos);
  EXPECT_EQ(bench.vehicle->all<ParamRequestRead>().size(), 8u);
}

TEST(Param, SaysAtOnceWhatTheVehicleSaysAboutAName) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (auto const* request = std::get_if<ParamRequestRead>(&message))
      bench.vehicle->answer(ParamError{.name = request->name, .error = MavParamError::does_not_exist});
  };
  auto const value = bench.loop.run_until_done(read_param(bench.ground, Bench::target, "NO_SUCH"));
  ASSERT_FALSE(value);
  EXPECT_EQ(value.error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(bench.vehicle->all<ParamRequestRead>().size(), 1u);
}

TEST(Param, SendsNothingForANameThatIsNone) {
  Bench bench;
  auto const value = bench.loop.run_until_done(read_param(bench.ground, Bench::target, "SEVENTEEN_LETTERS"));
  ASSERT_FALSE(value);
  EXPECT_EQ(value.error().kind, base::ErrorKind::invalid_input);
  EXPECT_TRUE(bench.vehicle->all<ParamRequestRead>().empty());
}

TEST(Param, VerifiesWhatWasStored) {
  Bench bench;
  Shelf shelf(*bench.vehicle, 10);
  auto const changed = bench.loop.run_until_done(set_param(bench.ground, Bench::target, "P7", 50));
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->before.value, 7);
  EXPECT_EQ(changed->after.value, 50);
  EXPECT_EQ(bench.vehicle->all<ParamSet>().at(0).type, int32) << "the vehicle's own type";
  shelf.limit = 100;
  auto const clipped = bench.loop.run_until_done(set_param(bench.ground, Bench::target, "P7", 500));
  ASSERT_FALSE(clipped);
  EXPECT_EQ(clipped.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(clipped.error().message, "vehicle 1 stored P7 = 100, not 500");
}

TEST(Param, SetsNothingThatItsTypeCannotHold) {
  Bench bench;
  Shelf const shelf(*bench.vehicle, 10);
  auto const result = bench.loop.run_until_done(set_param(bench.ground, Bench::target, "P7", 0.5));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::invalid_input);
  EXPECT_TRUE(bench.vehicle->all<ParamSet>().empty());
}

TEST(Param, GivesTheVehiclesReasonForARefusal) {
  Bench bench;
  Shelf shelf(*bench.vehicle, 10);
  shelf.refuses = true;
  auto const result = bench.loop.run_until_done(set_param(bench.ground, Bench::target, "P7", 5));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::refused);
  EXPECT_NE(result.error().message.find("read-only"), std::string::npos);
}

TEST(ParamList, ComesInOneGoOverAGoodLink) {
  Bench bench;
  Shelf const shelf(*bench.vehicle, 1350);
  auto const begun = bench.loop.now();
  auto const list = download(bench);
  ASSERT_TRUE(list);
  ASSERT_EQ(list->parameters.size(), 1350u);
  EXPECT_EQ(list->parameters[1349], (Parameter{"P1349", 1349, int32}));
  EXPECT_EQ(shelf.reads, 0);
  EXPECT_LE(bench.loop.now() - begun, 1400ms);
}

TEST(ParamList, AsksForHolesWhenTheRestHasCome) {
  Bench bench;
  Shelf shelf(*bench.vehicle, 400);
  shelf.swallows = {0, 17, 18, 19, 399};
  auto const begun = bench.loop.now();
  auto const list = download(bench);
  ASSERT_TRUE(list);
  EXPECT_EQ(list->parameters[399].name, "P399");
  EXPECT_EQ(shelf.reads, 5);
  EXPECT_EQ(shelf.lists, 1);
  EXPECT_LE(bench.loop.now() - begun, 900ms) << "the end of the stream is noticed soon";
}

TEST(ParamList, IsAskedForAgainWhenSingleRequestsWouldTakeLonger) {
  Bench bench({.loss = 0.3, .delay = 100ms, .seed = 2});
  Shelf const shelf(*bench.vehicle, 1350);
  auto const begun = bench.loop.now();
  ASSERT_TRUE(download(bench));
  EXPECT_GE(shelf.lists, 2);
  EXPECT_LE(bench.loop.now() - begun, 15s) << "one by one it takes more than 20 s";
}

TEST(ParamList, IsWholeOverABadLink) {
  for (double const loss : {0.1, 0.3, 0.5}) {
    Bench bench({.loss = loss, .duplication = 0.1, .delay = 30ms, .jitter = 20ms, .seed = 5});
    Shelf const shelf(*bench.vehicle, 600);
    std::size_t told = 0;
    auto const list = bench.loop.run_until_done(
        download_params(bench.ground, Bench::target, {}, [&](std::size_t done, std::size_t) { told = done; }));
    ASSERT_TRUE(list) << loss;
    for (std::size_t i = 0; i < 600; ++i) EXPECT_EQ(list->parameters[i].value, static_cast<double>(i));
    EXPECT_EQ(told, 600u);
  }
}

TEST(ParamList, DoesNotHurryASlowLink) {
  Bench bench({.delay = 500ms});
  Shelf shelf(*bench.vehicle, 100);
  shelf.pace = 50ms;
  auto const list = download(bench);
  ASSERT_TRUE(list);
  EXPECT_EQ(shelf.reads, 0);
}

TEST(ParamList, KeepsRequestsInFlightBounded) {
  Bench bench({.delay = 200ms});
  Shelf shelf(*bench.vehicle, 300);
  for (std::size_t i = 0; i < 290; ++i) shelf.swallows.insert(i);
  std::size_t most = 0;
  auto const list = download(bench, {.may_send = [&] {
                               most = std::max(most, bench.vehicle->all<ParamRequestRead>().size());
                               return true;
                             }});
  ASSERT_TRUE(list);
  EXPECT_EQ(list->parameters.size(), 300u);
  EXPECT_GT(most, 200u);
  EXPECT_LT(most, 400u) << "hardly any was asked for twice";
}

TEST(ParamList, WaitsWhileTheLinkIsNeededForMore) {
  Bench bench;
  Shelf const shelf(*bench.vehicle, 50);
  auto const free_at = bench.loop.now() + 30s;
  auto const list = download(bench, {.may_send = [&] { return bench.loop.now() >= free_at; }});
  ASSERT_TRUE(list);
  EXPECT_GE(bench.loop.now(), free_at);
  EXPECT_EQ(shelf.lists, 1);
}

TEST(ParamList, BeginsAnewWhenTheVehicleNumbersItsParametersAnew) {
  Bench bench;
  Shelf shelf(*bench.vehicle, 200);
  base::Scope scope(bench.loop);
  auto const grow = [&]() -> base::Task<void> {
    co_await bench.loop.sleep(100ms);
    shelf.values.insert(shelf.values.begin(), {.name = "NEW", .value = 7, .type = int8});
  };
  scope.spawn(grow());
  auto const list = download(bench);
  ASSERT_TRUE(list);
  ASSERT_EQ(list->parameters.size(), 201u);
  EXPECT_EQ(list->parameters[0].name, "NEW");
  EXPECT_EQ(list->parameters[200].name, "P199");
}

/// As one does that another ground station asks for its list.
TEST(ParamList, LeavesOutWhatAnotherComponentLists) {
  Bench bench({.delay = 20ms});
  Shelf shelf(*bench.vehicle, 200);
  FakeVehicle gimbal(bench.loop, bench.hub.connect(), {1, 154});
  bench.run_for(2s);
  base::Scope scope(bench.loop);
  auto const chatter = [&]() -> base::Task<void> {
    for (unsigned i = 0; i < 2000; ++i) {
      auto const index = static_cast<std::uint16_t>(i % 20);
      gimbal.answer(ParamValue{.name = "GMB_MAX_RATE", .value = 1, .type = real32, .count = 20, .index = index});
      co_await bench.loop.sleep(9ms);
    }
  };
  scope.spawn(chatter());
  auto const begun = bench.loop.now();
  auto const list = download(bench);
  EXPECT_LT(bench.loop.now() - begun, 5s) << "while the other one goes on";
  ASSERT_TRUE(list);
  ASSERT_EQ(list->parameters.size(), 200u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(list->parameters[i].name, "P" + std::to_string(i));
}

TEST(ParamList, SaysHowFarItCameWhenTheVehicleFallsSilent) {
  Bench bench;
  auto const nothing = download(bench);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().message, "vehicle 1 did not send its parameters");
  bench.vehicle->on = [&](Message const& message) {
    if (std::get_if<ParamRequestList>(&message))
      bench.vehicle->answer(ParamValue{.name = "ONE", .value = 1, .count = 9, .index = 0});
  };
  auto const some = download(bench);
  ASSERT_FALSE(some);
  EXPECT_EQ(some.error().kind, base::ErrorKind::timed_out);
  EXPECT_EQ(some.error().message, "vehicle 1 fell silent after 1 of 9 parameters");
}

TEST(ParamList, TakesPx4sHashAndLaterValues) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (!std::get_if<ParamRequestList>(&message)) return;
    bench.vehicle->answer(
        ParamValue{.name = "_HASH_CHECK", .value = std::bit_cast<float>(0xFFC00001U), .type = uint32, .count = 2});
    bench.vehicle->answer(ParamValue{.name = "A", .value = 1, .type = real32, .count = 2, .index = 0});
    bench.vehicle->answer(ParamValue{.name = "A", .value = 5, .type = real32, .count = 2});
    bench.vehicle->answer(
        ParamValue{.name = "B", .value = std::bit_cast<float>(-9), .type = int32, .count = 2, .index = 1});
  };
  auto const list = download(bench, {.encoding = ParamEncoding::bytewise});
  ASSERT_TRUE(list);
  EXPECT_EQ(list->hash, 0xFFC00001U);
  EXPECT_EQ(list->parameters[0].value, 5) << "changed while the list came";
  EXPECT_EQ(list->parameters[1].value, -9);
}

}  // namespace
}  // namespace lapwing::mavlink
