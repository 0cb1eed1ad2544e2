#include <gtest/gtest.h>

#include "base/wall_clock.hpp"
#include "link/pictures/picture_client.hpp"
#include "link/pictures/picture_server.hpp"

namespace lapwing::link::pictures {
namespace {

using namespace std::chrono_literals;

/// A drone's end and its viewers on this machine, in real time.
class Pictures : public ::testing::Test {
 public:
  template <class Condition>
  void until(Condition condition) {
    auto const deadline = loop.now() + 10s;
    while (!condition() && loop.now() < deadline) loop.run_until_done(next_look());
    EXPECT_TRUE(condition());
  }
  base::Task<> next_look() { co_await loop.sleep(2ms); }
  std::unique_ptr<PictureClient> look(View view) {
    return PictureClient::open(loop, {.port = server->port()}, view).value();
  }
  auto next(PictureClient& client, std::uint64_t after, base::Duration patience = 5s) {
    return loop.run_until_done(client.next(after, patience));
  }
  void offer(View view, std::string content) {
    server->offer(view, {.jpeg = std::make_shared<std::string const>(std::move(content)), .taken = base::wall_now()});
  }

  base::Loop loop;
  std::unique_ptr<PictureServer> server = PictureServer::open(loop, {.port = 0, .most_viewers = 2}).value();
};

TEST_F(Pictures, GoToThoseWhoLookAtThatView) {
  EXPECT_FALSE(server->is_watched(View::raw));
  auto const raw = look(View::raw);
  auto const annotated = look(View::annotated);
  until([&] { return server->is_watched(View::raw) && server->is_watched(View::annotated); });
  offer(View::raw, "plain");
  offer(View::annotated, "drawn");
  auto const plain = next(*raw, 0);
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_EQ(*plain->picture.jpeg, "plain");
  EXPECT_LT(base::wall_now() - plain->picture.taken, 5s);
  EXPECT_EQ(*next(*annotated, 0)->picture.jpeg, "drawn");
  offer(View::raw, "plain again");
  EXPECT_EQ(*next(*raw, plain->number)->picture.jpeg, "plain again");
}

TEST_F(Pictures, NobodyLooksWhenTheViewerIsGone) {
  auto raw = look(View::raw);
  until([&] { return server->is_watched(View::raw); });
  raw.reset();
  until([&] { return !server->is_watched(View::raw); });
}

TEST_F(Pictures, TellNoImageFromNoConnection) {
  auto const raw = look(View::raw);
  until([&] { return server->is_watched(View::raw); });
  auto const none = next(*raw, 0, 50ms);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, base::ErrorKind::timed_out);
  EXPECT_TRUE(none.error().message.starts_with("NoImage"));
  server.reset();
  auto const lost = next(*raw, 0, 300ms);
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().kind, base::ErrorKind::lost);
  EXPECT_TRUE(lost.error().message.starts_with("FailedToSend"));
}

TEST_F(Pictures, AllowSoManyViewersAndTellTheNextOne) {
  auto const first = look(View::raw);
  until([&] { return server->is_watched(View::raw); });
  auto const second = look(View::annotated);
  until([&] { return server->is_watched(View::annotated); });
  auto const third = look(View::raw);
  auto const refused = next(*third, 0, 500ms);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("503"), std::string::npos) << refused.error().message;
}

TEST_F(Pictures, AreForThoseWhoKnowTheToken) {
  server = PictureServer::open(loop, {.port = 0, .token = "swordfish"}).value();
  auto const at = [&](std::string token) {
    return PictureClient::open(loop, {.port = server->port(), .token = std::move(token)}, View::raw).value();
  };
  for (auto const* const wrong : {"", "sword", "swordfisH"}) {
    auto const stranger = at(wrong);
    auto const refused = next(*stranger, 0, 500ms);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("401"), std::string::npos) << refused.error().message;
  }
  auto const friendly = at("swordfish");
  until([&] { return server->is_watched(View::raw); });
  offer(View::raw, "plain");
  EXPECT_TRUE(next(*friendly, 0));
}

TEST_F(Pictures, WantATokenWhereOtherMachinesReachThem) {
  auto const open = PictureServer::open(loop, {.address = "0.0.0.0", .port = 0});
  ASSERT_FALSE(open);
  EXPECT_EQ(open.error().kind, base::ErrorKind::invalid_input);
  EXPECT_TRUE(PictureServer::open(loop, {.address = "0.0.0.0", .port = 0, .token = "swordfish"}));
}

TEST_F(Pictures, MissWhatASlowViewerHasNoTimeFor) {
  auto const quick = look(View::annotated);
  until([&] { return server->is_watched(View::annotated); });
  auto big = std::make_shared<std::string const>(std::string(1024UL * 1024, 'x'));
  std::weak_ptr<std::string const> const first = big;
  server->offer(View::annotated, {.jpeg = std::move(big), .taken = base::wall_now()});
  for (int i = 0; i < 50; ++i) offer(View::annotated, std::string(1024UL * 1024, 'y'));
  auto const one = next(*quick, 0);
  ASSERT_TRUE(one);
  auto newest = *one->picture.jpeg;
  auto number = one->number;
  while (newest.front() != 'y') {
    auto const another = next(*quick, number);
    ASSERT_TRUE(another);
    newest = *another->picture.jpeg;
    number = another->number;
  }
  EXPECT_LE(number, 2U) << "fifty were offered while the first was under way, and the last one took their place";
  until([&] { return first.expired(); });
}

}  // namespace
}  // namespace lapwing::link::pictures
