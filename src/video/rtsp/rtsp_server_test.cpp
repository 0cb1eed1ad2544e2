#include "video/rtsp/rtsp_server.hpp"

#include <gtest/gtest.h>

#include "video/rtsp/testing/player.hpp"

namespace lapwing::video {
namespace {

using namespace std::chrono_literals;
using testing::Player;

constexpr std::size_t plain = 0;
constexpr std::size_t drawn = 1;

RawPicture grey(unsigned brightness, int width = 320, int height = 240) {
  auto const size = 4UL * static_cast<unsigned>(width * height);
  auto bytes = std::make_shared<std::string const>(size, static_cast<char>(brightness));
  return {.width = width, .height = height, .bytes = std::move(bytes)};
}

/// A server and foreign players on this machine, in real time.
class Rtsp : public ::testing::Test {
 public:
  void open(RtspSettings settings = {}) {
    settings.port = 0;
    server = RtspServer::open(loop, settings, {"/plain", "/drawn"}).value();
  }
  /// Offers `jpeg` every few milliseconds until `condition` holds.
  template <class Condition>
  void until(Condition condition, std::size_t path = plain, RawPicture const& picture = {}) {
    auto const deadline = loop.now() + 20s;
    bool holds = condition();
    for (; !holds && loop.now() < deadline; holds = condition()) {
      if (picture.bytes) server->offer(path, picture);
      loop.run_until_done(a_while());
    }
    EXPECT_TRUE(holds);
  }
  base::Task<> a_while() { co_await loop.sleep(20ms); }
  void sees(Player& player, bool is_bright, std::size_t path, RawPicture const& picture) {
    until(
        [&] {
          auto const brightness = player.brightness();
          return brightness && (*brightness > 128) == is_bright;
        },
        path, picture);
  }

  base::Loop loop;
  std::unique_ptr<RtspServer> server;
  RawPicture black = grey(20);
  RawPicture white = grey(230);
};

TEST_F(Rtsp, GivesEveryPlayerThePicturesOfItsPathAsTheyChange) {
  open();
  Player first(server->port(), "/plain");
  Player second(server->port(), "/plain", {.protocols = "udp"});
  Player other(server->port(), "/drawn");
  for (bool const is_bright : {false, true, false}) {
    auto const& picture = is_bright ? white : black;
    sees(first, is_bright, plain, picture);
    sees(second, is_bright, plain, picture);
    sees(other, !is_bright, drawn, is_bright ? black : white);
  }
}

TEST_F(Rtsp, BeginsForALatecomerWithAPictureThatStandsAlone) {
  open({.pictures_a_s = 5000});
  Player first(server->port(), "/plain");
  sees(first, true, plain, white);
  Player second(server->port(), "/plain");
  sees(second, true, plain, white);
}

TEST_F(Rtsp, KeepsNoPictureUntilTheNextOneComes) {
  open();
  Player player(server->port(), "/plain");
  sees(player, false, plain, black);
  loop.run_until_done(a_while());
  server->offer(plain, white);
  sees(player, true, plain, {});
}

TEST_F(Rtsp, IsWatchedWhileSomebodyLooks) {
  open();
  EXPECT_FALSE(server->is_watched(plain));
  server->offer(plain, white);  // nobody takes it
  auto first = std::make_unique<Player>(server->port(), "/plain");
  auto second = std::make_unique<Player>(server->port(), "/plain");
  sees(*first, true, plain, white);
  sees(*second, true, plain, white);
  EXPECT_TRUE(server->is_watched(plain));
  EXPECT_FALSE(server->is_watched(drawn));
  first.reset();
  sees(*second, false, plain, black);
  EXPECT_TRUE(server->is_watched(plain));
  second.reset();
  until([&] { return !server->is_watched(plain); });
}

TEST_F(Rtsp, GoesOnWithPicturesOfAnotherSize) {
  open();
  Player player(server->port(), "/plain");
  sees(player, false, plain, black);
  auto const odd = grey(230, 161, 121);
  sees(player, true, plain, odd);
  EXPECT_LE(std::abs(player.width() - 161), 1);
}

TEST_F(Rtsp, AsksForThePassword) {
  open({.token = "swordfish"});
  Player right(server->port(), "/plain", {.password = "swordfish"});
  sees(right, true, plain, white);
  for (auto const* const wrong : {"", "Swordfish"}) {
    Player stranger(server->port(), "/plain", {.password = wrong});
    until([&] { return !stranger.fault().empty(); }, plain, white);
    EXPECT_NE(stranger.fault().find("nauthorized"), std::string::npos) << stranger.fault();
  }
}

TEST_F(Rtsp, HasNoMorePlacesThanItSays) {
  open({.most_viewers = 1});
  Player first(server->port(), "/plain");
  sees(first, true, plain, white);
  Player second(server->port(), "/plain");
  until([&] { return !second.fault().empty(); }, plain, white);
  sees(first, false, plain, black);
}

TEST_F(Rtsp, OpensWhereItMay) {
  auto const everywhere = RtspServer::open(loop, {.address = "0.0.0.0", .port = 0}, {"/plain"});
  ASSERT_FALSE(everywhere);
  EXPECT_EQ(everywhere.error().kind, base::ErrorKind::invalid_input);
  EXPECT_TRUE(RtspServer::open(loop, {.address = "0.0.0.0", .port = 0, .token = "swordfish"}, {"/plain"}));
  open();
  auto const taken = RtspServer::open(loop, {.port = server->port()}, {"/plain"});
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().kind, base::ErrorKind::io);
}

}  // namespace
}  // namespace lapwing::video
