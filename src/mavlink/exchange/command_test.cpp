#include "mavlink/exchange/command.hpp"

#include <gtest/gtest.h>

#include "mavlink/testing/fake_vehicle.hpp"
#include "mavlink/testing/stalling_link.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

base::Result<> run(Bench& bench, Command command, CommandOptions options = {}) {
  return bench.loop.run_until_done(run_command(bench.ground, Bench::target, command, options));
}

TEST(Command, SucceedsWhenAccepted) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (auto const* command = std::get_if<CommandLong>(&message))
      bench.vehicle->answer(CommandAck{.command = command->command});
  };
  EXPECT_TRUE(run(bench, arm()));
  auto const sent = bench.vehicle->all<CommandLong>();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].command, MavCmd::component_arm_disarm);
  EXPECT_EQ(sent[0].params[0], 1.0F);
}

TEST(Command, TakesNoOtherComponentsAcknowledgement) {
  Bench bench;
  FakeVehicle camera(bench.loop, bench.hub.connect(), {1, 100});
  bench.run_for(2s);
  bench.vehicle->on = [&](Message const& message) {
    auto const* command = std::get_if<CommandLong>(&message);
    if (!command) return;
    camera.answer(CommandAck{.command = command->command});
    bench.vehicle->answer(CommandAck{.command = command->command, .result = MavResult::denied});
  };
  auto const result = run(bench, arm());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "vehicle 1 answered COMPONENT_ARM_DISARM: denied");
}

TEST(Command, NamesCommandAndResultWhenRefused) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (std::get_if<CommandLong>(&message))
      bench.vehicle->answer(CommandAck{.command = MavCmd::component_arm_disarm, .result = MavResult::failed});
  };
  auto const result = run(bench, arm());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(result.error().message, "vehicle 1 answered COMPONENT_ARM_DISARM: failed");
}

/// Answers the first `times` commands with "temporarily rejected".
void be_busy(FakeVehicle& vehicle, int times) {
  vehicle.on = [&vehicle, times, seen = 0](Message const& message) mutable {
    auto const* command = std::get_if<CommandLong>(&message);
    if (!command) return;
    auto const result = ++seen <= times ? MavResult::temporarily_rejected : MavResult::accepted;
    vehicle.answer(CommandAck{.command = command->command, .result = result});
  };
}

TEST(Command, IsAskedAgainOfAVehicleThatIsBusy) {
  Bench bench;
  be_busy(*bench.vehicle, 3);
  auto const begun = bench.loop.now();
  EXPECT_TRUE(run(bench, arm()));
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 4u);
  EXPECT_GE(bench.loop.now() - begun, 3s);
}

TEST(Command, IsNotAskedForEverOfAVehicleThatIsBusy) {
  Bench bench;
  be_busy(*bench.vehicle, 1000);
  auto const begun = bench.loop.now();
  auto const result = run(bench, arm(), {.expiry = 60s});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(result.error().message, "vehicle 1 answered COMPONENT_ARM_DISARM: temporarily rejected");
  EXPECT_LE(bench.loop.now() - begun, 9s);
  auto const sent = bench.vehicle->all<CommandLong>().size();
  EXPECT_FALSE(run(bench, disarm(), {.is_urgent = true}));
  EXPECT_LE(bench.loop.now() - begun, 12s);
  EXPECT_GE(bench.vehicle->all<CommandLong>().size(), sent + 5);
}

TEST(Command, ThatIsBusyIsNotSentAfterItsExpiry) {
  Bench bench;
  be_busy(*bench.vehicle, 1000);
  auto const begun = bench.loop.now();
  EXPECT_FALSE(run(bench, arm(), {.expiry = 2s}));
  EXPECT_LE(bench.loop.now() - begun, 2s);
}

TEST(Command, RepeatsWithConfirmationCountingUpUntilItGivesUp) {
  Bench bench;
  auto const result = run(bench, arm(), {.tries = 4, .ack_timeout = 500ms});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::timed_out);
  auto const sent = bench.vehicle->all<CommandLong>();
  ASSERT_EQ(sent.size(), 4u);
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_EQ(sent[i].confirmation, i);
}

/// Tells its clock, and says nothing to commands but to the `nth`.
void answer_only(FakeVehicle& vehicle, std::size_t nth) {
  vehicle.on = [&vehicle, nth, seen = std::size_t{0}](Message const& message) mutable {
    if (auto const* sync = std::get_if<Timesync>(&message)) vehicle.answer(Timesync{.tc1 = 1s, .ts1 = sync->ts1});
    auto const* command = std::get_if<CommandLong>(&message);
    if (command && ++seen == nth) vehicle.answer(CommandAck{.command = command->command});
  };
}

TEST(Command, IsRepeatedSoonerOnALinkWhoseRoundTripIsKnown) {
  Bench bench({.delay = 20ms}, 5s);
  answer_only(*bench.vehicle, 3);
  bench.run_for(2s);
  ASSERT_EQ(bench.ground.round_trip(1), 40ms);
  auto const begun = bench.loop.now();
  EXPECT_TRUE(run(bench, disarm()));
  EXPECT_LT(bench.loop.now() - begun, 1s);
}

TEST(Command, IsNotRepeatedBeforeASlowLinkCanHaveAnswered) {
  Bench bench({.delay = 600ms}, 5s);
  answer_only(*bench.vehicle, 1);
  bench.run_for(5s);
  ASSERT_EQ(bench.ground.round_trip(1), 1200ms);
  EXPECT_TRUE(run(bench, disarm()));
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 1u);
}

TEST(Command, IsGivenUpAfterTheSameTimeOnEveryLink) {
  Bench bench({.delay = 20ms}, 5s);
  answer_only(*bench.vehicle, 100);
  bench.run_for(2s);
  auto const begun = bench.loop.now();
  EXPECT_FALSE(run(bench, disarm(), {.tries = 4, .ack_timeout = 500ms}));
  EXPECT_EQ(bench.loop.now() - begun, 2s);
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 5u);
}

TEST(Command, SendsNothingAfterItsExpiry) {
  Bench bench;
  auto const begun = bench.loop.now();
  EXPECT_FALSE(run(bench, arm(), {.tries = 100, .ack_timeout = 1s, .expiry = 3s}));
  EXPECT_LE(bench.loop.now() - begun, 4s);
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 3u);
}

base::Task<void> answer_slowly(FakeVehicle& vehicle, base::Loop& loop) {
  for (int i = 0; i < 4; ++i) {
    vehicle.answer(
        CommandAck{.command = MavCmd::preflight_calibration, .result = MavResult::in_progress, .progress = i / 4.0});
    co_await loop.sleep(5s);
  }
  vehicle.answer(CommandAck{.command = MavCmd::preflight_calibration});
}

TEST(Command, WaitsLongerWhileItIsInProgress) {
  Bench bench;
  base::Scope scope(bench.loop);
  bench.vehicle->on = [&](Message const& message) {
    if (std::get_if<CommandLong>(&message)) scope.spawn(answer_slowly(*bench.vehicle, bench.loop));
  };
  EXPECT_TRUE(run(bench, {MavCmd::preflight_calibration, {}}));
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 1u) << "a command that is being done is not repeated";
}

TEST(Command, OfDangerIsNotSentIntoSilenceThoughACompanionIsHeard) {
  Bench bench;
  FakeVehicle companion(bench.loop, bench.hub.connect(), {1, 191});
  bench.run_for(2s);
  bench.vehicle.reset();
  bench.run_for(4s);
  auto const result = run(bench, arm());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "COMPONENT_ARM_DISARM for vehicle 1 expired before it could be sent");
}

TEST(Command, SaysWhenProgressEndsInSilence) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (std::get_if<CommandLong>(&message))
      bench.vehicle->answer(CommandAck{.command = MavCmd::preflight_calibration, .result = MavResult::in_progress});
  };
  auto const result = run(bench, {MavCmd::preflight_calibration, {}}, {.progress_timeout = 2s});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("did not say how it ended"), std::string::npos);
}

TEST(Command, IgnoresAnswersToOthersAndToOtherCommands) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (!std::get_if<CommandLong>(&message)) return;
    bench.vehicle->answer(CommandAck{.command = MavCmd::do_set_mode, .result = MavResult::denied});
    bench.vehicle->connection.send_to_all(
        CommandAck{.target = {254, 190}, .command = MavCmd::component_arm_disarm, .result = MavResult::denied});
    bench.vehicle->answer(CommandAck{.command = MavCmd::component_arm_disarm});
  };
  EXPECT_TRUE(run(bench, arm()));
}

TEST(Command, ReportsAVehicleThatWasNeverHeard) {
  Bench bench;
  auto const result = bench.loop.run_until_done(run_command(bench.ground, {9, 1}, arm(), {}));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::lost);
}

TEST(Command, TravelsAsCommandIntWithItsPlace) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (auto const* command = std::get_if<CommandInt>(&message))
      bench.vehicle->answer(CommandAck{.command = command->command});
  };
  auto const place = geo::Wgs84::from_degrees(40.5, -7.25, 800);
  EXPECT_TRUE(bench.loop.run_until_done(run_command(bench.ground, Bench::target, set_home(place))));
  auto const sent = bench.vehicle->all<CommandInt>();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_NEAR(sent[0].place.lat_rad, place.lat_rad, 1e-9);
  EXPECT_EQ(sent[0].place.z_m, 800);
}

TEST(Command, UnpacksPx4ModesForItsAutopilot) {
  auto const ardupilot = set_mode(MavAutopilot::ardupilotmega, 4);
  EXPECT_EQ(ardupilot.params[1], 4.0F);
  auto const px4 = set_mode(MavAutopilot::px4, *mode_number(Autopilot::px4, Family::copter, "AUTO.MISSION"));
  EXPECT_EQ(px4.params[1], 4.0F);
  EXPECT_EQ(px4.params[2], 4.0F);
}

/// Answers each command with what `answer` says of it; with nothing, it stays silent.
void obey(Bench& bench, std::function<std::optional<MavResult>(Message const&)> answer) {
  bench.vehicle->on = [&bench, answer = std::move(answer)](Message const& message) {
    std::optional<MavCmd> id;
    if (auto const* as_long = std::get_if<CommandLong>(&message)) id = as_long->command;
    if (auto const* as_int = std::get_if<CommandInt>(&message)) id = as_int->command;
    if (!id) return;
    if (auto const result = answer(message)) bench.vehicle->answer(CommandAck{.command = *id, .result = *result});
  };
}

TEST(Command, FallsBackToCommandLongWhereNoOtherIsKnown) {
  Bench bench;
  obey(bench, [](Message const& message) {
    return std::get_if<CommandInt>(&message) ? MavResult::unsupported : MavResult::accepted;
  });
  auto const place = geo::Wgs84::from_degrees(40.5, -7.25, 800);
  EXPECT_TRUE(run(bench, set_home(place)));
  EXPECT_EQ(bench.vehicle->all<CommandInt>().size(), 1u);
  auto const sent = bench.vehicle->all<CommandLong>();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].params[4], 40.5F);
  EXPECT_EQ(sent[0].params[5], -7.25F);
  EXPECT_EQ(sent[0].params[6], 800.0F);
}

TEST(Command, GoesAsCommandLongAtOnceWhereTheVehicleHasSaidSo) {
  Bench bench;
  obey(bench, [](Message const&) { return MavResult::accepted; });
  EXPECT_TRUE(run(bench, set_home({}), {.takes_int = false}));
  EXPECT_TRUE(bench.vehicle->all<CommandInt>().empty());
}

TEST(Command, ChangesItsFormOnlyOnce) {
  Bench bench;
  obey(bench, [](Message const&) { return MavResult::unsupported; });
  auto const result = run(bench, set_home({}));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "vehicle 1 answered DO_SET_HOME: unsupported");
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 1u);
}

TEST(Command, GoesAsCommandIntWhereTheVehicleAsksForIt) {
  Bench bench;
  obey(bench, [](Message const& message) {
    return std::get_if<CommandLong>(&message) ? MavResult::command_int_only : MavResult::accepted;
  });
  EXPECT_TRUE(run(bench, take_off(20)));
  auto const sent = bench.vehicle->all<CommandInt>();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(sent[0].place.z_m, 20);
}

TEST(Command, DoesNotBelieveALateAnswerToAnEarlierOne) {
  Bench bench;
  // The answer to the arming comes only when the disarming is on its way, which is then refused.
  obey(bench, [](Message const&) -> std::optional<MavResult> { return std::nullopt; });
  EXPECT_FALSE(run(bench, arm(), {.tries = 1, .ack_timeout = 500ms}));
  int disarms = 0;
  bench.vehicle->on = [&](Message const& message) {
    if (!std::get_if<CommandLong>(&message)) return;
    if (++disarms == 1) bench.vehicle->answer(CommandAck{.command = MavCmd::component_arm_disarm});
    bench.vehicle->answer(CommandAck{.command = MavCmd::component_arm_disarm, .result = MavResult::failed});
  };
  auto const result = run(bench, disarm());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, base::ErrorKind::refused);
}

TEST(Command, AsksAgainWhenTheOnlyAnswerMayBeAnEarlierOnes) {
  Bench bench;
  obey(bench, [](Message const&) -> std::optional<MavResult> { return std::nullopt; });
  EXPECT_FALSE(run(bench, arm(), {.tries = 1, .ack_timeout = 500ms}));
  obey(bench, [](Message const&) { return MavResult::accepted; });
  EXPECT_TRUE(run(bench, disarm()));
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 3u) << "one arming and two tries to disarm";
}

TEST(Command, BelievesAgainAfterAWhile) {
  Bench bench;
  obey(bench, [](Message const&) -> std::optional<MavResult> { return std::nullopt; });
  EXPECT_FALSE(run(bench, arm(), {.tries = 1, .ack_timeout = 500ms}));
  bench.run_for(6s);
  obey(bench, [](Message const&) { return MavResult::accepted; });
  EXPECT_TRUE(run(bench, disarm()));
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 2u);
}

base::Task<> run_into(Bench& bench, Command command, CommandOptions options, base::Result<>& result) {
  result = co_await run_command(bench.ground, Bench::target, command, options);
}

TEST(Command, WaitsForItsTurnBehindOneOfItsKind) {
  Bench bench;
  std::vector<float> heard;
  obey(bench, [&heard](Message const& message) -> std::optional<MavResult> {
    heard.push_back(std::get<CommandLong>(message).params[0]);
    return heard.size() < 3 ? std::nullopt : std::optional(MavResult::accepted);
  });
  base::Scope scope(bench.loop);
  base::Result<> armed;
  base::Result<> disarmed;
  scope.spawn(run_into(bench, arm(), {}, armed));
  scope.spawn(run_into(bench, disarm(), {}, disarmed));
  bench.run_for(9s);
  EXPECT_TRUE(armed);
  EXPECT_TRUE(disarmed);
  ASSERT_GE(heard.size(), 4u);
  EXPECT_EQ(heard[2], 1.0F) << "the arming has been answered before the disarming is sent";
  EXPECT_EQ(heard[3], 0.0F);
}

TEST(Command, ThatIsUrgentOvertakesTheOthers) {
  Bench bench;
  obey(bench, [](Message const& message) -> std::optional<MavResult> {
    if (std::get<CommandLong>(message).params[0] == 1.0F) return std::nullopt;
    return MavResult::accepted;
  });
  base::Scope scope(bench.loop);
  base::Result<> armed;
  scope.spawn(run_into(bench, arm(), {}, armed));
  bench.run_for(100ms);
  EXPECT_TRUE(run(bench, disarm(), {.is_urgent = true}));
  bench.run_for(10s);
  ASSERT_FALSE(armed);
  EXPECT_EQ(armed.error().kind, base::ErrorKind::cancelled);
  auto const sent = bench.vehicle->all<CommandLong>();
  EXPECT_EQ(sent.back().params[0], 0.0F) << "nothing follows the stop";
}

/// A vehicle behind a link that keeps what it is given while it stalls, as TCP does.
struct StallingBench {
  StallingBench() : ground(loop, {}, {}) {
    ground.add_link(stall(hub.take_server(), way));
    vehicle = std::make_unique<FakeVehicle>(loop, hub.connect());
    vehicle->on = [this](Message const& message) {
      if (auto const* command = std::get_if<CommandLong>(&message))
        vehicle->answer(CommandAck{.command = command->command});
    };
    run_for(2s);
  }
  base::Task<> nap(base::Duration time) { co_await loop.sleep(time); }
  void run_for(base::Duration time) { loop.run_until_done(nap(time)); }
  int arms() const { return static_cast<int>(vehicle->all<CommandLong>().size()); }

  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  std::shared_ptr<StalledWay> way = std::make_shared<StalledWay>();
  link::PipeHub hub{loop};
  Connection ground;
  std::unique_ptr<FakeVehicle> vehicle;
};

TEST(Command, IsNotPutIntoALinkThatKeepsIt) {
  StallingBench bench;
  bench.way->begin();
  bench.run_for(5s);
  auto const result = bench.loop.run_until_done(run_command(bench.ground, Bench::target, arm()));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "COMPONENT_ARM_DISARM for vehicle 1 expired before it could be sent");
  bench.way->end();
  bench.run_for(5s);
  EXPECT_EQ(bench.arms(), 0) << "a late ARM never arms";
}

TEST(Command, IsSentWhenTheVehicleIsBackInTime) {
  StallingBench bench;
  bench.way->begin();
  bench.run_for(5s);
  base::Scope scope(bench.loop);
  base::Result<> armed = base::fail(base::ErrorKind::io, "");
  scope.spawn([](StallingBench& on, base::Result<>& result) -> base::Task<> {
    result = co_await run_command(on.ground, Bench::target, arm());
  }(bench, armed));
  bench.run_for(3s);
  bench.way->end();
  bench.run_for(3s);
  EXPECT_TRUE(armed);
  EXPECT_EQ(bench.arms(), 1);
}

TEST(Command, IsNotSentLaterThanWhoAskedForItWants) {
  Bench bench;
  auto const asked = bench.loop.now();
  bench.run_for(4s);
  EXPECT_FALSE(run(bench, arm(), {.tries = 100, .ack_timeout = 1s, .not_after = asked + 6s}));
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 2u);
  EXPECT_FALSE(run(bench, arm(), {.not_after = asked + 6s}));
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 2u);
}

TEST(Command, IsHazardousWhenItMovesAVehicle) {
  for (auto const number : {22, 24, 34, 84, 92, 115, 176, 189, 192, 218, 246, 300, 3000, 43001})
    EXPECT_TRUE(is_hazardous({static_cast<MavCmd>(number), {}})) << number;
  for (auto const number : {203, 410, 511, 512, 1000, 2000})
    EXPECT_FALSE(is_hazardous({static_cast<MavCmd>(number), {}})) << number;
  EXPECT_TRUE(is_hazardous(arm()));
  EXPECT_FALSE(is_hazardous(disarm()));
}

TEST(Command, KeepsNoLongAccountOfWhatNobodyAnswers) {
  Bench bench;
  bench.run_for(2s);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(run(bench, disarm(), {.tries = 4, .ack_timeout = 500ms}));
  EXPECT_EQ(bench.vehicle->all<CommandLong>().size(), 80u);
  EXPECT_LE(bench.ground.commands().line(1, MavCmd::component_arm_disarm).unanswered(), 12u);
}

TEST(Connection, LetsAGuardHoldBackWhatIsSent) {
  Bench bench;
  bench.ground.set_send_guard([](Address, Message const& message) -> base::Result<> {
    if (std::get_if<CommandLong>(&message)) return base::fail(base::ErrorKind::refused, "held back");
    return {};
  });
  auto const result = run(bench, arm());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "held back");
  EXPECT_TRUE(bench.vehicle->all<CommandLong>().empty());
  EXPECT_TRUE(bench.ground.send(Bench::target, ParamRequestList{}));
}

}  // namespace
}  // namespace lapwing::mavlink
