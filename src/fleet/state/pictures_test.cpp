#include "fleet/state/pictures.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using base::TimePoint;

struct PictureTraceTest : ::testing::Test {
  mavlink::CameraImageCaptured captured(std::int32_t image, base::Duration since_boot = 10s) const {
    mavlink::CameraImageCaptured message;
    message.since_boot = since_boot;
    message.image = image;
    message.captured = true;
    message.position = here;
    message.relative_alt_m = 20.0;
    return message;
  }
  mavlink::CameraFeedback feedback(std::uint16_t image) const {
    mavlink::CameraFeedback message;
    message.image = image;
    message.position = here;
    return message;
  }
  bool take(mavlink::CameraImageCaptured const& message, base::Duration at = 1s) {
    return trace.take(message, 100, shown, TimePoint(at));
  }
  bool take(mavlink::CameraFeedback const& message, base::Duration at = 1s) {
    return trace.take(message, shown, TimePoint(at));
  }
  std::vector<int> numbers() const {
    std::vector<int> all;
    for (auto const& picture : shown.value->recent) all.push_back(picture.number);
    return all;
  }

  geo::Wgs84 const here = geo::Wgs84::from_degrees(40.0, -8.0, 120.0);
  PictureTrace trace;
  vehicle::Aged<vehicle::Pictures> shown;
};

TEST_F(PictureTraceTest, ShowsWhereEachPictureWasTaken) {
  EXPECT_TRUE(take(captured(7)));
  EXPECT_TRUE(take(captured(8), 2s));
  EXPECT_EQ(shown.value->taken, 2);
  EXPECT_EQ(shown.value->lost, 0);
  EXPECT_EQ(numbers(), (std::vector{1, 2}));
  EXPECT_EQ(shown.value->recent[0].position, here);
  EXPECT_EQ(shown.heard, TimePoint(2s));
  EXPECT_TRUE(trace.take_missing().empty());  // what was before we listened is not asked for
}

TEST_F(PictureTraceTest, AsksOnceForPicturesThatNobodyToldOf) {
  take(captured(1));
  take(captured(4));
  EXPECT_EQ(trace.take_missing(), (std::vector<PictureTrace::Missing>{{100, 2}, {100, 3}}));
  EXPECT_TRUE(trace.take_missing().empty());
  EXPECT_TRUE(trace.is_missing({100, 3}));
  EXPECT_EQ(shown.value->taken, 4);
  EXPECT_EQ(shown.value->lost, 2);
  EXPECT_TRUE(take(captured(3)));
  EXPECT_FALSE(trace.is_missing({100, 3}));
  EXPECT_EQ(shown.value->taken, 4);
  EXPECT_EQ(shown.value->lost, 1);
  EXPECT_EQ(numbers(), (std::vector{1, 2, 3}));
}

TEST_F(PictureTraceTest, CountsNothingTwice) {
  take(captured(1));
  EXPECT_FALSE(take(captured(1)));
  take(feedback(5));
  EXPECT_EQ(shown.value->taken, 1);
}

TEST_F(PictureTraceTest, PrefersTheMessageThatTellsMost) {
  EXPECT_TRUE(trace.take(mavlink::CameraTrigger{.time = {}, .seq = 1}, std::nullopt, shown, TimePoint(1s)));
  EXPECT_EQ(shown.value->lost, 1);  // taken, but where?
  EXPECT_TRUE(take(feedback(1), 1200ms));
  EXPECT_EQ(shown.value->taken, 1);
  EXPECT_EQ(shown.value->lost, 0);
  EXPECT_TRUE(take(captured(0), 1400ms));
  EXPECT_EQ(shown.value->taken, 1);
  EXPECT_FALSE(trace.take(mavlink::CameraTrigger{.time = {}, .seq = 2}, here, shown, TimePoint(5s)));
  EXPECT_FALSE(take(feedback(2), 5s));
  EXPECT_TRUE(take(captured(1), 5s));
  EXPECT_EQ(shown.value->taken, 2);
  EXPECT_EQ(shown.value->recent.size(), 2u);
}

TEST_F(PictureTraceTest, CountsLostFeedbackAcrossTheWrapOfItsCounter) {
  take(feedback(65534));
  take(feedback(1));
  EXPECT_EQ(shown.value->taken, 4);
  EXPECT_EQ(shown.value->lost, 2);
  EXPECT_TRUE(trace.take_missing().empty());  // nobody can be asked
  take(feedback(30000));                      // began anew
  EXPECT_EQ(shown.value->taken, 5);
}

TEST_F(PictureTraceTest, NoticesACameraThatCountsAnew) {
  take(captured(50, 100s));
  EXPECT_TRUE(take(captured(0, 5s)));
  EXPECT_EQ(shown.value->taken, 2);
  trace.restart();
  EXPECT_TRUE(take(captured(0, 5s)));
  EXPECT_EQ(shown.value->taken, 3);
}

TEST_F(PictureTraceTest, LeavesOutPicturesThatFailedAndPlacesThatAreNone) {
  auto failed = captured(1);
  failed.captured = false;
  take(failed);
  EXPECT_FALSE(shown.known());
  auto nowhere = captured(2);
  nowhere.position = {};
  take(nowhere);
  EXPECT_EQ(shown.value->taken, 1);
  EXPECT_EQ(shown.value->lost, 1);
}

TEST_F(PictureTraceTest, KeepsTheNewestOfManyPictures) {
  for (int i = 0; i < 3000; ++i) take(captured(i));
  EXPECT_EQ(shown.value->taken, 3000);
  EXPECT_EQ(shown.value->recent.size(), 2000u);
  EXPECT_EQ(shown.value->recent.back().number, 3000);
  take(captured(2'000'000'000));
  EXPECT_TRUE(trace.take_missing().empty());
}

}  // namespace
}  // namespace lapwing::fleet
