// Feeds as viewers see them: through a station, over a WebSocket.
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/feeds/envelope.hpp"
#include "station/station.hpp"
#include "station/testing/fake_script.hpp"
#include "station/testing/http_client.hpp"
#include "station/testing/toy_feeds.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using testing::run_until;
using testing::WebSocketClient;

/// What comes before the bytes of a binary message, read as any client would.
struct Header {
  explicit Header(std::string const& message) {
    auto const number = [&](std::size_t at, std::size_t size) {
      std::uint64_t value = 0;
      for (std::size_t i = size; i-- > 0;) value = value << 8U | static_cast<unsigned char>(message.at(at + i));
      return value;
    };
    format = number(0, 1);
    is_whole = (number(1, 1) & 1U) != 0;
    feed = number(2, 2);
    revision = number(8, 8);
  }
  std::uint64_t format;
  bool is_whole;
  std::uint64_t feed;
  std::uint64_t revision;
};

struct StationFeedsTest : ::testing::Test {
  void open(Station::Options options = {}) {
    options.http.port = 0;
    options.period = period;
    auto opened = Station::open(loop, registry, script, hub, std::move(options));
    ASSERT_TRUE(opened) << opened.error().message;
    station = std::move(*opened);
  }
  /// With feeds of somebody else's.
  void open_with_toys(std::size_t tiles_limit = std::size_t{64} * 1024) {
    Station::Options options;
    auto notes_feed = std::make_unique<testing::NotesFeed>();
    auto tiles_feed = std::make_unique<testing::TilesFeed>(tiles_limit);
    notes = notes_feed.get();
    tiles = tiles_feed.get();
    options.feeds.push_back(std::move(notes_feed));
    options.feeds.push_back(std::move(tiles_feed));
    open(std::move(options));
  }
  std::unique_ptr<WebSocketClient> watch(std::string query = "") {
    return WebSocketClient::open(loop, station->port(), {.target = "/api/v1/ws" + query});
  }
  /// The next text of that type, skipping all else; null when none comes.
  static json next(WebSocketClient& client, std::string_view type) {
    while (auto const text = client.receive()) {
      if (client.last_was_binary()) continue;
      auto message = json::parse(*text);
      if (message["type"] == type) return message;
    }
    return {};
  }
  /// All texts up to the answer to a ping, which comes behind what was to be sent before.
  static std::vector<json> told(WebSocketClient& client) {
    client.send(R"({"type":"ping","id":"end"})");
    std::vector<json> messages;
    while (auto const text = client.receive()) {
      if (client.last_was_binary()) continue;
      messages.push_back(json::parse(*text));
      if (messages.back()["type"] == "pong") return messages;
    }
    ADD_FAILURE() << "no answer";
    return messages;
  }
  static std::string types_of(std::vector<json> const& messages) {
    std::string types;
    for (auto const& message : messages) types += message["type"].get<std::string>() + " ";
    return types;
  }
  static std::optional<std::string> next_bytes(WebSocketClient& client) {
    while (auto message = client.receive())
      if (client.last_was_binary()) return message;
    return std::nullopt;
  }
  void move_vehicle(double alt_m) {
    registry.edit({"1"}).motion.relative_alt_m.set(alt_m, loop.now());
    registry.touch({"1"});
  }
  void let_some_rounds_pass() {
    auto const until = std::chrono::steady_clock::now() + std::chrono::milliseconds(25);
    (void)run_until(loop, [&] { return std::chrono::steady_clock::now() > until; });
  }

  base::Loop loop;
  std::chrono::milliseconds period{5};
  vehicle::Registry registry{loop};
  testing::FakeScript script;
  base::LogHub hub;
  testing::NotesFeed* notes = nullptr;
  testing::TilesFeed* tiles = nullptr;
  std::unique_ptr<Station> station;
};

TEST_F(StationFeedsTest, TellsWhichThereAre) {
  open_with_toys();
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  auto const hello = next(*viewer, "hello");
  EXPECT_EQ(hello["run"].get<std::string>().size(), 16U);
  std::string usual;
  std::string further;
  std::set<int> ids;
  for (auto const& feed : hello["feeds"]) {
    (feed["usual"] ? usual : further) += feed["name"].get<std::string>() + " ";
    ids.insert(feed["id"].get<int>());
  }
  EXPECT_EQ(usual, "vehicles plans pictures script tasks log alarms ");
  EXPECT_EQ(further,
            "map.sites map.slots map.walls map.points_of_interest map.pictures map.tracks map.areas map.grids notes "
            "tiles ");
  EXPECT_EQ(ids.size(), hello["feeds"].size());
}

TEST_F(StationFeedsTest, SendsOneWhoHasNotSubscribedTheUsualFeedsAlone) {
  open_with_toys();
  notes->write("one");
  tiles->draw('a', "picture");
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  let_some_rounds_pass();
  for (auto const& message : told(*viewer)) EXPECT_NE(message["type"], "notes");
  EXPECT_FALSE(viewer->last_was_binary());
}

TEST_F(StationFeedsTest, ShowsTextsThatSomebodyBrings) {
  open_with_toys();
  notes->write("one");
  auto const viewer = watch("?subscribe");
  ASSERT_TRUE(viewer);
  EXPECT_EQ(types_of(told(*viewer)), "hello pong ") << "it waits for the subscription";
  viewer->send(R"({"type":"subscribe","id":"s","feeds":["notes"]})");
  EXPECT_EQ(next(*viewer, "reply")["ok"], true);
  EXPECT_EQ(next(*viewer, "notes"),
            json({{"type", "notes"}, {"notes", {"one"}}, {"feed", "notes"}, {"revision", 2}, {"whole", true}}));
  notes->write("two");
  EXPECT_EQ(next(*viewer, "notes"), json({{"type", "notes"}, {"notes", {"two"}}, {"feed", "notes"}, {"revision", 3}}));
}

TEST_F(StationFeedsTest, ShowsBytesThatSomebodyBrings) {
  open_with_toys();
  tiles->draw('a', "first");
  tiles->draw('b', "second");
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  auto const hello = next(*viewer, "hello");
  std::uint64_t id = 0;
  for (auto const& feed : hello["feeds"])
    if (feed["name"] == "tiles") id = feed["id"];
  viewer->send(R"({"type":"subscribe","feeds":["tiles","vehicles"]})");
  auto const first = next_bytes(*viewer);
  ASSERT_TRUE(first);
  Header const header(*first);
  EXPECT_EQ(header.format, 1U);
  EXPECT_EQ(header.feed, id);
  EXPECT_EQ(header.revision, 2U);
  EXPECT_TRUE(header.is_whole);
  EXPECT_EQ(first->substr(binary_header_size), "afirst");
  auto const second = next_bytes(*viewer);
  EXPECT_EQ(second->substr(binary_header_size), "bsecond");
  EXPECT_FALSE(Header(*second).is_whole);
  tiles->draw('a', "third");
  auto const third = next_bytes(*viewer);
  EXPECT_EQ(third->substr(binary_header_size), "athird");
  EXPECT_EQ(Header(*third).revision, 4U);
}

TEST_F(StationFeedsTest, RefusesASubscriptionToWhatThereIsNot) {
  open_with_toys();
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  viewer->send(R"({"type":"subscribe","id":"s","feeds":["notes","weather"]})");
  auto const reply = next(*viewer, "reply");
  EXPECT_EQ(reply["id"], "s");
  EXPECT_EQ(reply["ok"], false);
  EXPECT_EQ(reply["error"]["message"], "There is no feed \"weather\".");
  EXPECT_EQ(reply["error"]["hint"],
            "This station has vehicles, plans, pictures, script, tasks, log, alarms, map.sites, map.slots, map.walls, "
            "map.points_of_interest, map.pictures, map.tracks, map.areas, map.grids, notes, tiles.");
  move_vehicle(7);
  EXPECT_EQ(next(*viewer, "vehicles")["vehicles"][0]["relative_alt_m"], 7.0) << "all stays as it was";
}

TEST_F(StationFeedsTest, EndsWhatIsNotSubscribedToAnyMore) {
  open_with_toys();
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  viewer->send(R"({"type":"subscribe","id":"s","feeds":[]})");
  EXPECT_EQ(next(*viewer, "reply")["ok"], true);
  move_vehicle(7);
  let_some_rounds_pass();
  EXPECT_EQ(types_of(told(*viewer)), "pong ");
  viewer->send(R"({"type":"subscribe","id":"t","feeds":["vehicles"]})");
  EXPECT_EQ(next(*viewer, "vehicles")["full"], true);
}

TEST_F(StationFeedsTest, GoesOnWhereAViewerWasThatComesBack) {
  open_with_toys();
  move_vehicle(1);
  base::Logger(hub, "test").info("before");
  notes->write("one");
  auto viewer = watch("?subscribe");
  auto const run = next(*viewer, "hello")["run"].get<std::string>();
  viewer->send(R"({"type":"subscribe","feeds":["vehicles","script","log","notes"]})");
  json revisions;
  for (auto const& message : told(*viewer))
    if (message.contains("feed")) revisions[message["feed"].get<std::string>()] = message["revision"];
  EXPECT_EQ(revisions.size(), 4U);
  viewer.reset();
  ASSERT_TRUE(run_until(loop, [&] { return station->viewers() == 0; }));

  move_vehicle(2);
  base::Logger(hub, "test").info("meanwhile");
  notes->write("two");
  json subscribe{{"type", "subscribe"}, {"feeds", {"vehicles", "script", "log", "notes"}}, {"revisions", revisions}};
  subscribe["run"] = run;
  viewer = watch("?subscribe");
  viewer->send(subscribe.dump());
  auto const messages = told(*viewer);
  EXPECT_EQ(types_of(messages), "hello reply vehicles log notes pong ") << "the script is as it was";
  EXPECT_EQ(messages[2]["full"], false);
  EXPECT_EQ(messages[2]["vehicles"][0]["relative_alt_m"], 2.0);
  EXPECT_FALSE(messages[2]["vehicles"][0].contains("family")) << "which it knows";
  ASSERT_EQ(messages[3]["lines"].size(), 1U);
  EXPECT_EQ(messages[3]["lines"][0]["text"], "meanwhile");
  EXPECT_EQ(messages[4]["notes"], json({"two"}));

  subscribe["run"] = "of another day";
  viewer = watch("?subscribe");
  viewer->send(subscribe.dump());
  EXPECT_EQ(next(*viewer, "vehicles")["full"], true) << "revisions of another run mean nothing";
}

TEST_F(StationFeedsTest, TellsAllAnewToOneWhoMissedTooMuch) {
  open_with_toys();
  notes->write("one");
  auto const resume = [&](std::uint64_t revision) {
    auto const viewer = watch("?subscribe");
    auto const run = next(*viewer, "hello")["run"].get<std::string>();
    viewer->send(
        json{{"type", "subscribe"}, {"feeds", {"notes"}}, {"run", run}, {"revisions", {{"notes", revision}}}}.dump());
    return next(*viewer, "notes");
  };
  (void)resume(0);
  for (auto const* text : {"two", "three", "four", "five"}) notes->write(text);
  let_some_rounds_pass();
  (void)resume(0);
  EXPECT_EQ(resume(4)["notes"], json({"four", "five"}));
  EXPECT_FALSE(resume(4).contains("whole"));
  auto const anew = resume(2);
  EXPECT_EQ(anew["notes"], json({"three", "four", "five"})) << "no more are kept";
  EXPECT_EQ(anew["whole"], true);
  EXPECT_EQ(resume(1'000'000)["whole"], true) << "there was never such a revision";
}

TEST_F(StationFeedsTest, SendsASlowViewerAgainOnlyWhatItMissed) {
  open();
  for (int i = 0; i < 40; ++i) {
    vehicle::VehicleId const id{std::to_string(i)};
    registry.edit(id).motion.relative_alt_m.set(1.0, loop.now());
    registry.touch(id);
  }
  for (int i = 0; i < 100; ++i) base::Logger(hub, "test").info("what was said before");
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  (void)next(*viewer, "alarms");
  // Each script is so long that the system's buffers hold only a few of them.
  viewer->pause();
  constexpr int sent = 8;
  constexpr std::size_t length = 3'000'000;
  script.current.source = std::string(length, 'x');
  for (int i = 0; i < sent; ++i) {
    script.current.message = fmt::format("{}", i);
    let_some_rounds_pass();
    move_vehicle(i);
  }
  script.current.source = "short";
  move_vehicle(99);
  base::Logger(hub, "test").info("last");
  let_some_rounds_pass();
  viewer->resume();
  std::map<std::string, std::size_t> bytes;
  int scripts = 0;
  std::string last_script;
  double alt_m = 0;
  while (last_script != "short" || alt_m != 99.0) {
    auto const text = viewer->receive();
    ASSERT_TRUE(text);
    auto const message = json::parse(*text);
    bytes[message["type"]] += text->size();
    if (message["type"] == "script") last_script = message["source"];
    if (message["type"] == "script") ++scripts;
    if (message["type"] != "vehicles") continue;
    EXPECT_EQ(message["full"], false) << "nothing of the vehicles was missed";
    for (auto const& vehicle : message["vehicles"])
      if (vehicle["id"] == "1") alt_m = vehicle.value("relative_alt_m", alt_m);  // one heard again tells its age alone
  }
  EXPECT_LT(scripts, sent) << "it missed some";
  EXPECT_LT(bytes["vehicles"], 3'000U);
  EXPECT_LT(bytes["log"], 1'000U);
  EXPECT_EQ(bytes["tasks"] + bytes["hello"] + bytes["alarms"], 0U);
}

TEST_F(StationFeedsTest, SendsALargeFeedInPiecesWithTheOthersBetween) {
  constexpr std::size_t limit = 1'000'000;
  constexpr char count = 24;
  open_with_toys(limit);
  for (char i = 0; i < count; ++i) tiles->draw(i, std::string(limit, 'x'));
  auto const viewer = watch("?subscribe");
  ASSERT_TRUE(viewer);
  (void)next(*viewer, "hello");
  viewer->pause();
  viewer->send(R"({"type":"subscribe","feeds":["tiles","vehicles"]})");
  let_some_rounds_pass();
  move_vehicle(99);
  let_some_rounds_pass();
  viewer->resume();
  int tiles_before = 0;
  int tiles_in_all = 0;
  bool has_moved = false;
  while (tiles_in_all < count) {
    auto const message = viewer->receive();
    ASSERT_TRUE(message);
    if (viewer->last_was_binary()) {
      EXPECT_EQ((*message)[binary_header_size], static_cast<char>(tiles_in_all)) << "each once and in order";
      ++tiles_in_all;
      if (!has_moved) ++tiles_before;
      continue;
    }
    auto const text = json::parse(*message);
    if (text["type"] == "vehicles" && !text["vehicles"].empty()) has_moved = true;
  }
  EXPECT_TRUE(has_moved);
  EXPECT_LT(tiles_before, count) << "a vehicle's place does not wait for the whole map";
  EXPECT_LE(tiles->most_at_once(), limit + 1);
}

TEST_F(StationFeedsTest, SendsASlowViewerTheNewestOfWhatItMissed) {
  constexpr std::size_t limit = 1'000'000;
  open_with_toys(limit);
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  viewer->send(R"({"type":"subscribe","id":"s","feeds":["tiles"]})");
  (void)next(*viewer, "reply");
  viewer->pause();
  constexpr int drawn = 40;
  for (int i = 0; i < drawn; ++i) {
    tiles->draw('a', std::to_string(i) + std::string(limit, 'x'));
    let_some_rounds_pass();
  }
  viewer->resume();
  int came = 0;
  for (std::string last; !last.starts_with(std::to_string(drawn - 1)); ++came) {
    auto const bytes = next_bytes(*viewer);
    ASSERT_TRUE(bytes);
    last = bytes->substr(binary_header_size + 1);
  }
  EXPECT_LT(came, drawn) << "what was drawn over meanwhile is not sent";
}

TEST_F(StationFeedsTest, ShowsTheMapsNewsBeforeTheNextRound) {
  map::LiveMap map([this] { return loop.utc_now(); });
  map.put_site(geo::Site::make("lot", {}, {}).value());
  period = std::chrono::hours(1);
  Station::Options options;
  options.map = &map;
  open(std::move(options));
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  viewer->send(R"({"type":"subscribe","id":"s","feeds":["map.areas"]})");
  (void)next(*viewer, "reply");
  ASSERT_TRUE(map.put({.id = "a",
                       .site = "lot",
                       .account = {.writer = "operator", .at = loop.utc_now()},
                       .content = map::Area{.outline = {{{{0, 0}, {9, 0}, {9, 9}}}}}}));
  auto const news = next(*viewer, "features");
  ASSERT_EQ(news["features"].size(), 1U);
  EXPECT_EQ(news["features"][0]["id"], "a");
}

}  // namespace
}  // namespace lapwing::station
