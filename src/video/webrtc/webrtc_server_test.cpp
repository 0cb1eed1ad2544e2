#include "video/webrtc/webrtc_server.hpp"

#include <gtest/gtest.h>

#include "base/wall_clock.hpp"
#include "video/webrtc/testing/browser_offer.hpp"

namespace lapwing::video {
namespace {

using namespace std::chrono_literals;
using testing::browser_offer;

constexpr std::size_t plain = 0;
constexpr std::size_t drawn = 1;

/// A server in real time, and viewers that offer and never connect. One that looks: web/e2e/video.spec.js.
class WebRtc : public ::testing::Test {
 public:
  void open(WebRtcSettings const& settings = {}) { server = WebRtcServer::open(loop, settings, 2).value(); }
  auto begin(std::size_t view) { return loop.run_until_done(server->begin(view, read_offer(browser_offer()).value())); }
  template <class Condition>
  void until(Condition condition) {
    auto const deadline = loop.now() + 20s;
    while (!condition() && loop.now() < deadline) loop.run_until_done(a_while());
    EXPECT_TRUE(condition());
  }
  base::Task<> a_while() { co_await loop.sleep(10ms); }
  static RawPicture grey() {
    constexpr std::size_t size = 64UL * 48 * 4;
    return {.width = 64, .height = 48, .bytes = std::make_shared<std::string const>(size, 'g')};
  }

  base::Loop loop;
  std::unique_ptr<WebRtcServer> server;
};

TEST_F(WebRtc, AnswersWithH264FromThisMachineAlone) {
  open();
  auto const session = begin(plain);
  ASSERT_TRUE(session) << session.error().message;
  auto const& answer = session->answer;
  for (auto const* const part : {"m=video 9 UDP/TLS/RTP/SAVPF 108", "a=rtpmap:108 H264/90000", "a=sendonly", "a=mid:0",
                                 "a=rtcp-fb:108 nack pli", "a=setup:active", " 127.0.0.1 "})
    EXPECT_NE(answer.find(part), std::string::npos) << part << " is not in\n" << answer;
  std::size_t candidates = 0;
  for (auto at = answer.find("a=candidate"); at != std::string::npos; at = answer.find("a=candidate", at + 1))
    ++candidates;
  EXPECT_EQ(candidates, 1U) << answer;
}

TEST_F(WebRtc, IsWatchedFromTheBeginningOfASessionToItsEnd) {
  open();
  EXPECT_FALSE(server->is_watched(plain));
  auto const session = begin(plain);
  ASSERT_TRUE(session);
  EXPECT_TRUE(server->is_watched(plain));
  EXPECT_FALSE(server->is_watched(drawn));
  EXPECT_FALSE(server->end("another"));
  EXPECT_TRUE(server->end(session->id));
  EXPECT_FALSE(server->is_watched(plain));
  EXPECT_FALSE(server->end(session->id));
}

TEST_F(WebRtc, HasNoMorePlacesThanItSaysAndGivesThemAgain) {
  open({.most_viewers = 1});
  auto const first = begin(plain);
  ASSERT_TRUE(first);
  EXPECT_TRUE(server->is_full());
  auto const second = begin(drawn);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, base::ErrorKind::refused);
  server->end(first->id);
  EXPECT_TRUE(begin(drawn));
}

TEST_F(WebRtc, LetsGoOfWhoDoesNotConnect) {
  open({.connect_patience = 100ms});
  ASSERT_TRUE(begin(plain));
  until([&] { return !server->is_watched(plain); });
}

TEST_F(WebRtc, LetsGoOfWhoLooksWhenTheClockWasSet) {
  open();
  ASSERT_TRUE(begin(plain));
  ASSERT_TRUE(begin(drawn));
  auto const taken = base::wall_now();
  server->show(plain, grey(), taken);
  server->show(plain, grey(), taken + 40ms);
  EXPECT_TRUE(server->is_watched(plain));
  server->show(plain, grey(), taken - 1h);
  EXPECT_FALSE(server->is_watched(plain));
  EXPECT_TRUE(server->is_watched(drawn));
}

TEST_F(WebRtc, EndsWithViewersThatLook) {
  open();
  ASSERT_TRUE(begin(plain));
  server->show(plain, grey(), base::wall_now());
  server.reset();
}

TEST_F(WebRtc, WantsAnAddress) {
  auto const nowhere = WebRtcServer::open(loop, {.address = "drone.example"}, 1);
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().kind, base::ErrorKind::invalid_input);
}

}  // namespace
}  // namespace lapwing::video
