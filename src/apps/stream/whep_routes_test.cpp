#include "apps/stream/whep_routes.hpp"

#include <gtest/gtest.h>

#include "apps/stream/picture_relay.hpp"
#include "base/log.hpp"
#include "station/http/http_server.hpp"
#include "station/testing/http_client.hpp"
#include "video/webrtc/testing/browser_offer.hpp"

namespace lapwing::apps {
namespace {

using station::testing::Answer;
using station::testing::Ask;
using video::testing::browser_offer;
using video::testing::with;

constexpr auto annotated = "/api/v1/whep/annotated";

/// What is served to browsers, asked as they ask, in real time.
class Whep : public ::testing::Test {
 public:
  void open(video::WebRtcSettings const& settings = {}, std::string token = {}) {
    server = video::WebRtcServer::open(loop, settings, relayed_views.size()).value();
    // GStreamer loads its parts for the first one, for which no client that asks over HTTP need have the patience.
    server->end(loop.run_until_done(server->begin(0, video::read_offer(browser_offer()).value()))->id);
    http = station::HttpServer::open(loop, {.port = 0, .token = std::move(token)}, log).value();
    http->set_router(whep_routes(*server, view_names(), log));
  }
  Answer ask(Ask request) { return station::testing::ask(loop, http->port(), std::move(request)); }
  static Ask posted(std::string body, std::string type = "application/sdp") {
    return {
        .method = "POST", .target = annotated, .headers = {{"Content-Type", std::move(type)}}, .body = std::move(body)};
  }

  base::Loop loop;
  base::LogHub hub;
  base::Logger log{hub, "stream"};
  std::unique_ptr<video::WebRtcServer> server;
  std::unique_ptr<station::HttpServer> http;
};

TEST_F(Whep, AnswersAnOfferAndEndsTheSessionThatItMakes) {
  open();
  auto const begun = ask(posted(browser_offer()));
  ASSERT_EQ(begun.status, 201) << begun.body;
  EXPECT_EQ(begun.header("Content-Type"), "application/sdp");
  EXPECT_NE(begun.body.find("a=rtpmap:108 H264/90000"), std::string::npos) << begun.body;
  EXPECT_TRUE(server->is_watched(1)) << "the annotated view";
  auto const session = begun.header("Location");
  ASSERT_TRUE(session.starts_with("/api/v1/whep/sessions/")) << session;
  EXPECT_EQ(ask({.method = "DELETE", .target = session}).status, 200);
  EXPECT_FALSE(server->is_watched(1));
  EXPECT_EQ(ask({.method = "DELETE", .target = session}).status, 404);
}

TEST_F(Whep, SaysWhatIsWrongWithAnOffer) {
  open();
  auto const json = ask(posted("{}", "application/json"));
  EXPECT_EQ(json.status, 415);
  EXPECT_NE(json.body.find("application/sdp"), std::string::npos) << json.body;
  EXPECT_EQ(ask(posted("v=0\r\nnonsense")).status, 422) << "SDP without a video";
  EXPECT_EQ(ask(posted("nonsense")).status, 400);
  EXPECT_EQ(ask(posted("")).status, 400);
  EXPECT_EQ(ask(posted(std::string(video::largest_offer + 1, 'x'))).status, 413);
  auto const other = ask(posted(with(browser_offer(), "H264", "H265")));
  EXPECT_EQ(other.status, 422);
  EXPECT_NE(other.body.find("constrained baseline"), std::string::npos) << other.body;
  EXPECT_FALSE(server->is_watched(1));
}

TEST_F(Whep, KnowsNoOtherViewsAndWays) {
  open();
  auto request = posted(browser_offer());
  request.target = "/api/v1/whep/infrared";
  EXPECT_EQ(ask(request).status, 404);
  EXPECT_EQ(ask({.target = annotated}).status, 405);
  auto trickle = posted("a=candidate", "application/sdp");
  trickle.method = "PATCH";
  EXPECT_EQ(ask(trickle).status, 405) << "an answer has all candidates, and those of offers are not needed";
}

TEST_F(Whep, TellsWhoComesWhenItIsFullToComeAgain) {
  open({.most_viewers = 1});
  ASSERT_EQ(ask(posted(browser_offer())).status, 201);
  auto const refused = ask(posted(browser_offer()));
  EXPECT_EQ(refused.status, 503);
  EXPECT_FALSE(refused.header("Retry-After").empty());
  EXPECT_NE(refused.body.find("as many look"), std::string::npos) << refused.body;
}

TEST_F(Whep, IsForThoseWhoKnowTheTokenAndAskByAddress) {
  open({}, "swordfish");
  EXPECT_EQ(ask(posted(browser_offer())).status, 401);
  auto wrong = posted(browser_offer());
  wrong.headers.push_back({"Authorization", "Bearer Swordfish"});
  EXPECT_EQ(ask(wrong).status, 401);
  auto right = posted(browser_offer());
  right.headers.push_back({"Authorization", "Bearer swordfish"});
  EXPECT_EQ(ask(right).status, 201);
  right.host = "rebound.example";
  EXPECT_EQ(ask(right).status, 403);
  right.host = {};
  right.headers.push_back({"Origin", "http://elsewhere.example"});
  EXPECT_EQ(ask(right).status, 403) << "a page of elsewhere";
}

}  // namespace
}  // namespace lapwing::apps
