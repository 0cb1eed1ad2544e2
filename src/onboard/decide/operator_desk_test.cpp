#include "onboard/decide/operator_desk.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "autonomy/operator/map_follower.hpp"
#include "autonomy/operator/map_request.hpp"

namespace lapwing::onboard {
namespace {

namespace wire = link::operator_link;
using namespace std::chrono_literals;
using autonomy::MapRequest;

autonomy::OccupancyMap map_of(std::vector<std::int8_t> cells) {
  auto const columns = static_cast<std::uint32_t>(cells.size());
  return {.columns = columns, .rows = 1, .resolution_m = 0.5, .origin = {}, .cells = std::move(cells)};
}

/// A drone's desk and its operators, on this machine in real time.
struct DeskTest : ::testing::Test {
  DeskTest() {
    wire::ServeSettings settings{.port = 0};
    settings.server.end.name = "drone";
    desk = OperatorDesk::open(loop, std::move(settings), base::Logger(hub, "decide")).value();
  }
  std::unique_ptr<wire::Client> operator_of(std::string name) {
    wire::ConnectSettings settings{.port = desk->port()};
    settings.client.end.name = std::move(name);
    auto client = wire::connect(loop, std::move(settings), {}).value();
    until([&] { return client->is_connected(); });
    return client;
  }
  template <class Condition>
  void until(Condition condition) {
    auto const deadline = loop.now() + 10s;
    while (!condition() && loop.now() < deadline) loop.run_until_done(next_look());
    EXPECT_TRUE(condition());
  }
  base::Task<> next_look() { co_await loop.sleep(2ms); }
  void ask(wire::Client& from, MapRequest request) { say(from, std::string(map_request_text(request))); }
  /// And waits until the desk has read it.
  void say(wire::Client& from, std::string text) {
    auto const id = from.session().send({.kind = wire::Kind::command, .text = std::move(text)});
    ASSERT_TRUE(id);
    until([&] {
      EXPECT_TRUE(desk->take_commands().empty());
      return from.session().waiting(wire::Kind::command) == 0;
    });
  }
  autonomy::Report heard(wire::Client& by) {
    auto const message = loop.run_until_done(by.session().receive(10s));
    return autonomy::parse_report(message ? message->text : "nothing").value();
  }
  void beat() { desk->heartbeat({}, {}, map); }
  /// One heartbeat, and what comes of the map beside it.
  struct Beat {
    std::optional<autonomy::report::Heartbeat> heartbeat = {};
    std::optional<autonomy::report::Map> whole = {};
    std::optional<autonomy::report::MapChanges> changes = {};
  };
  Beat beat_for(wire::Client& by, bool with_map_beside) {
    beat();
    Beat all;
    for (int i = 0; i < (with_map_beside ? 2 : 1); ++i) {
      auto report = heard(by);
      if (auto* const one = std::get_if<autonomy::report::Heartbeat>(&report)) all.heartbeat = *one;
      if (auto* const one = std::get_if<autonomy::report::Map>(&report)) all.whole = *one;
      if (auto* const one = std::get_if<autonomy::report::MapChanges>(&report)) all.changes = *one;
    }
    return all;
  }

  base::LogHub hub;
  base::Loop loop;
  std::optional<autonomy::OccupancyMap> map;
  std::unique_ptr<OperatorDesk> desk;
};

TEST_F(DeskTest, SendsTheWholeMapInEachHeartbeatToWhoDoesNotAsk) {
  auto const old_one = operator_of("old");
  map = map_of({-1, 0, 100});
  for (int i = 0; i < 2; ++i) EXPECT_EQ(beat_for(*old_one, false).heartbeat.value().map.value().cells, map->cells);
}

TEST_F(DeskTest, TellsWhoAsksTheWholeMapOnceAndThenWhatChanges) {
  auto const old_one = operator_of("old");
  auto const new_one = operator_of("new");
  ask(*new_one, MapRequest::as_changes);
  EXPECT_FALSE(beat_for(*new_one, false).heartbeat.value().map) << "there is none yet";
  (void)heard(*old_one);

  map = map_of({-1, 0, 100});
  auto const first = beat_for(*new_one, true);
  EXPECT_FALSE(first.heartbeat.value().map);
  EXPECT_EQ(first.whole.value().revision, 1U);
  EXPECT_EQ(first.whole.value().map.cells, map->cells);
  EXPECT_EQ(std::get<autonomy::report::Heartbeat>(heard(*old_one)).map.value().cells, map->cells);

  EXPECT_FALSE(beat_for(*new_one, false).heartbeat.value().map) << "nothing has changed";
  map->cells[0] = 7;
  auto const second = beat_for(*new_one, true);
  EXPECT_EQ(second.changes.value().since, 1U);
  EXPECT_EQ(second.changes.value().revision, 2U);
  ASSERT_EQ(second.changes.value().runs.size(), 1U);
  EXPECT_EQ(second.changes.value().runs[0].cells, std::vector<std::int8_t>{7});
}

TEST_F(DeskTest, TellsTheWholeMapAgainWhenItIsAskedForOrHasAnotherShape) {
  auto const client = operator_of("new");
  map = map_of({-1, 0, 100});
  ask(*client, MapRequest::as_changes);
  ASSERT_TRUE(beat_for(*client, true).whole);
  ask(*client, MapRequest::as_changes);
  EXPECT_EQ(beat_for(*client, true).whole.value().revision, 1U);
  map = map_of({-1, 0, 100, 5});
  EXPECT_EQ(beat_for(*client, true).whole.value().revision, 2U);
}

TEST_F(DeskTest, GoesBackToHeartbeatsWhenItIsAskedToAndAfterALostConnection) {
  auto const client = operator_of("new");
  map = map_of({-1, 0, 100});
  ask(*client, MapRequest::as_changes);
  ASSERT_TRUE(beat_for(*client, true).whole);
  ask(*client, MapRequest::in_heartbeats);
  EXPECT_TRUE(beat_for(*client, false).heartbeat.value().map);

  ask(*client, MapRequest::as_changes);
  ASSERT_TRUE(beat_for(*client, true).whole);
  client->session().detach("a cut");
  until([&] { return !client->is_connected(); });
  until([&] { return client->is_connected(); });
  EXPECT_TRUE(beat_for(*client, false).heartbeat.value().map);
}

TEST_F(DeskTest, TellsASlowOperatorLessOftenAndMissesNothing) {
  auto const client = operator_of("slow");
  ask(*client, MapRequest::as_changes);
  map = map_of(std::vector<std::int8_t>(50, -1));
  // He takes nothing while the map changes a hundred times.
  for (int i = 0; i < 100; ++i) {
    map->cells[static_cast<std::size_t>(i) % 50] = static_cast<std::int8_t>(i);
    beat();
    loop.run_until_done(next_look());
  }
  autonomy::MapFollower follower;
  std::size_t messages = 0;
  auto const take_all = [&] {
    while (auto const message = client->session().take()) {
      auto report = autonomy::parse_report(message->text).value();
      if (auto* const whole = std::get_if<autonomy::report::Map>(&report)) {
        EXPECT_EQ(follower.take(std::move(*whole)), autonomy::MapFollower::Outcome::shown);
        ++messages;
      } else if (auto const* const changes = std::get_if<autonomy::report::MapChanges>(&report)) {
        EXPECT_EQ(follower.take(*changes), autonomy::MapFollower::Outcome::shown);
        ++messages;
      }
    }
  };
  until([&] {
    take_all();
    beat();
    return follower.map() && follower.map()->cells == map->cells;
  });
  EXPECT_LE(messages, MapPost::most_waiting + 2);
}

TEST_F(DeskTest, AnswersWhoAsksForAnythingElse) {
  auto const client = operator_of("odd");
  say(*client, R"({"Type":"Map","Send":"Poems"})");
  auto const answer = heard(*client);
  EXPECT_TRUE(std::get<autonomy::report::ErrorLog>(answer).message.contains("as Changes or as Heartbeat"));
}

}  // namespace
}  // namespace lapwing::onboard
