// What pages get that look back: the state of a moment, and what followed, in parts that can be put together.
#include "station/past/history_routes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <variant>

#include "station/testing/fake_store.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

struct HistoryRoutesTest : ::testing::Test {
  base::Loop loop{{.unpaced = true}};
  testing::FakeStore store;

  static base::UtcTime at(std::int64_t milliseconds) { return base::UtcTime(std::chrono::milliseconds(milliseconds)); }

  void show(std::int64_t milliseconds, std::string content, bool is_whole = false, std::string feed = "notes") {
    store.record({.at = at(milliseconds),
                  .session = "s1",
                  .feed = std::move(feed),
                  .is_whole = is_whole,
                  .content = std::move(content)});
  }

  HttpResponse get(std::string const& target, bool has_store = true) {
    Router router;
    add_history_routes(router, has_store ? &store : nullptr);
    auto reply = router.answer(request_for("GET", target).value());
    if (auto* response = std::get_if<HttpResponse>(&reply)) return *response;
    HttpResponse answer;
    loop.run_until_done([](base::Task<HttpResponse> work, HttpResponse& into) -> base::Task<> {
      into = co_await std::move(work);
    }(std::get<base::Task<HttpResponse>>(std::move(reply)), answer));
    return answer;
  }
  json body(std::string const& target) { return json::parse(get(target).body); }
};

TEST_F(HistoryRoutesTest, ListsSessionsTheNewestFirst) {
  store.known = {{"s1", "first", at(1000), at(2000)}, {"s2", "second", at(3000), at(4000)}};
  auto const list = body("/api/v1/history")["sessions"];
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0], json({{"id", "s2"}, {"name", "second"}, {"began_ms", 3000}, {"ended_ms", 4000}}));
}

TEST_F(HistoryRoutesTest, LeadsToAMomentFromTheLastWholeOn) {
  show(1000, R"({"n":1})", true);
  show(2000, R"({"n":2})");
  show(3000, R"({"n":3})", true);
  show(4000, R"({"n":4})");
  show(5000, R"({"n":5})");
  auto const frames = body("/api/v1/history/s1/state?at_ms=4500")["frames"];
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0], json({{"at_ms", 3000}, {"feed", "notes"}, {"whole", true}, {"message", {{"n", 3}}}}));
  EXPECT_EQ(frames[1]["message"]["n"], 4);
}

TEST_F(HistoryRoutesTest, TellsWhatFollowedAndUpToWhen) {
  show(1000, R"({"n":1})", true);
  show(2000, R"({"n":2})");
  auto const answer = body("/api/v1/history/s1/frames?from_ms=1500&to_ms=9000");
  EXPECT_EQ(answer["complete_to_ms"], 9000);
  ASSERT_EQ(answer["frames"].size(), 1U);
  EXPECT_EQ(answer["frames"][0]["message"]["n"], 2);
}

TEST_F(HistoryRoutesTest, PartsOfALongTimePutTogetherAreAllOfItOnce) {
  constexpr int moments = 7000;
  for (int i = 0; i < moments; ++i) {
    show(i, R"({"n":1})", false, "a");
    show(i, R"({"n":2})", false, "b");
  }
  std::int64_t from = 0;
  std::size_t count = 0;
  for (int asked = 0; from < moments; ++asked) {
    ASSERT_LT(asked, 10);
    auto const answer = body("/api/v1/history/s1/frames?from_ms=" + std::to_string(from) + "&to_ms=7000");
    count += answer["frames"].size();
    ASSERT_GT(answer["complete_to_ms"].get<std::int64_t>(), from) << "it gets on";
    from = answer["complete_to_ms"];
  }
  EXPECT_EQ(count, 2U * moments);
}

TEST_F(HistoryRoutesTest, OneMomentLargerThanAnAnswerIsToldWhole) {
  for (int i = 0; i < 5200; ++i) show(1000, "{}");
  auto const answer = body("/api/v1/history/s1/frames?from_ms=0&to_ms=9000");
  EXPECT_EQ(answer["frames"].size(), 5200U);
  EXPECT_EQ(answer["complete_to_ms"], 1001);
}

TEST_F(HistoryRoutesTest, MistakesAreTold) {
  EXPECT_EQ(get("/api/v1/history/s1/state").status, 400);
  EXPECT_EQ(get("/api/v1/history/s1/state?at_ms=noon").status, 400);
  EXPECT_EQ(get("/api/v1/history/s1/state?at_ms=-1").status, 400);
  EXPECT_EQ(get("/api/v1/history/s1/state?at_ms=99999999999999999999").status, 400);
  EXPECT_EQ(get("/api/v1/history/s1/frames?from_ms=5&to_ms=5").status, 400);
  auto const without = get("/api/v1/history", false);
  EXPECT_EQ(without.status, 404);
  EXPECT_NE(without.body.find("--store"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::station
