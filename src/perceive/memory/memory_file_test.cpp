#include "perceive/memory/memory_file.hpp"

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::perceive {
namespace {

using namespace std::chrono_literals;

auto const now = base::UtcTime(std::chrono::hours(24 * 365 * 55));

struct MemoryFile : testing::Test {
  std::string written(base::UtcTime at) {
    return folder.write("survey.jsonl", memory_text({.at = at, .pictures = 5}, site, ""));
  }
  base::testing::TemporaryFolder folder;
  geo::Site site = geo::Site::make("lot", geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0)).value();
};

TEST_F(MemoryFile, IsTakenUp) {
  auto const recalled = recall(written(now - 5s), site, now, 60min);
  ASSERT_TRUE(recalled.memory);
  EXPECT_EQ(recalled.memory->pictures, 5U);
  EXPECT_FALSE(recalled.is_fault);
  EXPECT_NE(recalled.words.find("of 5.0 s ago is taken up"), std::string::npos) << recalled.words;
}

TEST_F(MemoryFile, IsNotMissedWhereThereIsNone) {
  auto const recalled = recall(folder.path() / "survey.jsonl", site, now, 60min);
  EXPECT_FALSE(recalled.memory);
  EXPECT_EQ(recalled.words, "");
}

TEST_F(MemoryFile, IsLeftWhereItIsTooOld) {
  auto const file = written(now - 61min);
  auto const recalled = recall(file, site, now, 60min);
  EXPECT_FALSE(recalled.memory || recalled.is_fault);
  EXPECT_NE(recalled.words.find("3660 s old"), std::string::npos) << recalled.words;
  EXPECT_TRUE(std::filesystem::exists(file));
}

TEST_F(MemoryFile, IsLeftWhereTheClockSaysThatItIsOfTomorrow) {
  auto const recalled = recall(written(now + 24h), site, now, 60min);
  EXPECT_FALSE(recalled.memory || recalled.is_fault);
  EXPECT_NE(recalled.words.find("later than now"), std::string::npos) << recalled.words;
}

TEST_F(MemoryFile, IsNotLookedAtByWhoRemembersNothing) {
  EXPECT_FALSE(recall(written(now - 5s), site, now, 0s).memory);
}

TEST_F(MemoryFile, IsPutAsideWhenItIsDamaged) {
  auto const file = folder.write("survey.jsonl", "{\"format\":\"lapwing survey\"");
  auto const recalled = recall(file, site, now, 60min);
  EXPECT_FALSE(recalled.memory);
  EXPECT_TRUE(recalled.is_fault);
  EXPECT_NE(recalled.words.find("it begins empty"), std::string::npos) << recalled.words;
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_EQ(folder.read("survey.jsonl.unread"), "{\"format\":\"lapwing survey\"");
}

TEST_F(MemoryFile, OfWhichSomethingWasSeenTooLongAgoIsTakenUpWithoutThat) {
  std::string lines;
  for (auto const* const at : {"2024-12-18T22:00:00Z", "2024-12-18T23:59:00Z"})
    lines += std::string(R"({"at":")") + at +
             R"(","vehicle":"d","lens":[64,48,60,60,32,24,0,0,0,0,0],"camera":[0,0,10,1,0,0,0],"ground":[0],)" +
             R"("slots":[],"cars":[]})" + "\n";
  auto const at = base::UtcTime(std::chrono::sys_days{std::chrono::December / 19 / 2024});
  auto const file = folder.write("survey.jsonl", memory_text({.at = at}, site, lines));
  auto const recalled = recall(file, site, at, 60min);
  ASSERT_TRUE(recalled.memory) << recalled.words;
  EXPECT_EQ(recalled.memory->sights.size(), 1U);
}

}  // namespace
}  // namespace lapwing::perceive
