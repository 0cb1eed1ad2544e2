// What was shown is kept so that any moment can be come back to, at a bounded cost.
#include "station/past/recorder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/testing/fake_store.hpp"
#include "station/testing/toy_feeds.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

struct RecorderTest : ::testing::Test {
  base::Loop loop{{.unpaced = true}};
  testing::FakeStore store;
  testing::NotesFeed notes;

  Recorder recorder(double growth = 4.0) {
    return {loop, {&notes}, store, {.session = "today", .growth = growth, .longest_without_whole = 15min}};
  }
  void pass(base::Duration time) {
    loop.run_until_done(
        [](base::Loop& on, base::Duration how_long) -> base::Task<> { co_await on.sleep(how_long); }(loop, time));
  }
};

TEST_F(RecorderTest, KeepsTheWholeFirstAndThenWhatIsNew) {
  auto kept = recorder();
  notes.write("one");
  kept.keep();
  notes.write("two");
  kept.keep();
  ASSERT_EQ(store.kept.size(), 2U);
  EXPECT_TRUE(store.kept[0].is_whole);
  EXPECT_FALSE(store.kept[1].is_whole);
  EXPECT_EQ(json::parse(store.kept[1].content)["notes"], json({"two"}));
  EXPECT_EQ(json::parse(store.kept[1].content)["feed"], "notes") << "as viewers get it";
  EXPECT_EQ(store.kept[1].session, "today");
}

TEST_F(RecorderTest, KeepsNothingWhileNothingChanges) {
  auto kept = recorder();
  notes.write("one");
  for (int i = 0; i < 10; ++i) kept.keep();
  EXPECT_EQ(store.kept.size(), 1U);
}

TEST_F(RecorderTest, KeepsAWholeAnewOnceWhatFollowedOutgrowsIt) {
  auto kept = recorder(2.0);
  for (int i = 0; i < 40; ++i) {
    notes.write("a note");
    kept.keep();
  }
  int longest_run = 0;
  int run = 0;
  for (auto const& shown : store.kept) longest_run = std::max(longest_run, run = shown.is_whole ? 0 : run + 1);
  EXPECT_GT(longest_run, 1);
  EXPECT_LT(longest_run, 10) << "to come to a moment must not mean to read all before it";
}

TEST_F(RecorderTest, KeepsAWholeAnewAfterSomeTimeThoughNothingChanged) {
  auto kept = recorder();
  notes.write("one");
  kept.keep();
  pass(16min);
  kept.keep();
  ASSERT_EQ(store.kept.size(), 2U);
  EXPECT_TRUE(store.kept[1].is_whole) << "what came before is thrown away one day";
}

TEST_F(RecorderTest, TimesLieOnMilliseconds) {
  auto kept = recorder();
  pass(1234567ns);
  notes.write("one");
  kept.keep();
  EXPECT_EQ(store.kept.at(0).at.time_since_epoch() % 1ms, 0ns);
}

}  // namespace
}  // namespace lapwing::station
