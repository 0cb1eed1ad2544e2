#include "apps/stream/picture_relay.hpp"

#include <gtest/gtest.h>

#include "base/wall_clock.hpp"
#include "link/pictures/picture_server.hpp"
#include "video/rtsp/testing/player.hpp"

namespace lapwing::apps {
namespace {

using namespace std::chrono_literals;
using link::pictures::PictureServer;
using link::pictures::View;
using video::testing::grey_jpeg;
using video::testing::Player;

/// A camera's pictures, the relay, and foreign players on this machine, in real time.
class Relay : public ::testing::Test {
 public:
  /// Shows the camera's pictures every few milliseconds until `condition` holds.
  template <class Condition>
  void until(Condition condition) {
    auto const deadline = loop.now() + 20s;
    bool holds = condition();
    for (; !holds && loop.now() < deadline; holds = condition()) {
      if (camera) {
        show(View::raw, plain);
        show(View::annotated, drawn);
      }
      loop.run_until_done(a_while());
    }
    EXPECT_TRUE(holds);
  }
  base::Task<> a_while() { co_await loop.sleep(20ms); }
  void show(View view, std::shared_ptr<std::string const> const& jpeg) const {
    camera->offer(view, {.jpeg = jpeg, .taken = base::wall_now()});
  }
  void sees(Player& player, bool is_bright) {
    until([&] {
      auto const brightness = player.brightness();
      return brightness && (*brightness > 128) == is_bright;
    });
  }

  base::Loop loop;
  base::LogHub hub;
  std::shared_ptr<std::string const> black = grey_jpeg(20);
  std::shared_ptr<std::string const> white = grey_jpeg(230);
  std::shared_ptr<std::string const> plain = black;
  std::shared_ptr<std::string const> drawn = white;
  std::unique_ptr<PictureServer> camera = PictureServer::open(loop, {.port = 0, .token = "swordfish"}).value();
  std::uint16_t camera_port = camera->port();
  std::unique_ptr<video::RtspServer> server = video::RtspServer::open(loop, {.port = 0}, relayed_paths()).value();
  PictureRelay relay{
      loop, {.rtsp = server.get()}, {.port = camera_port, .token = "swordfish"}, base::Logger(hub, "stream")};
};

TEST_F(Relay, HandsOnEachViewWhileSomebodyLooksAtIt) {
  auto raw = std::make_unique<Player>(server->port(), "/raw");
  sees(*raw, false);
  EXPECT_TRUE(camera->is_watched(View::raw));
  EXPECT_FALSE(camera->is_watched(View::annotated)) << "nobody looks at it";
  Player annotated(server->port(), "/annotated");
  sees(annotated, true);
  std::swap(plain, drawn);
  sees(*raw, true);
  sees(annotated, false);
  raw.reset();
  until([&] { return !camera->is_watched(View::raw); });
  EXPECT_TRUE(camera->is_watched(View::annotated));
}

TEST_F(Relay, PassesOverTornPictures) {
  Player player(server->port(), "/raw");
  sees(player, false);
  for (std::size_t const length : {1UL, 3UL, 40UL, 300UL, white->size() / 2})
    for (int i = 0; i < 5; ++i) {
      show(View::raw, std::make_shared<std::string const>(white->substr(0, length)));
      loop.run_until_done(a_while());
    }
  plain = white;
  sees(player, true);
  EXPECT_EQ(player.fault(), "");
}

TEST_F(Relay, WaitsForACameraThatIsGone) {
  Player player(server->port(), "/raw");
  sees(player, false);
  camera.reset();
  auto const gone_until = loop.now() + 2500ms;
  until([&] { return loop.now() > gone_until; });
  camera = PictureServer::open(loop, {.port = camera_port, .token = "swordfish"}).value();
  plain = white;
  sees(player, true);
  EXPECT_EQ(player.fault(), "");
}

}  // namespace
}  // namespace lapwing::apps
