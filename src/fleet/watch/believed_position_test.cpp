#include "fleet/watch/believed_position.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;

geo::Wgs84 const here = geo::Wgs84::from_degrees(40.0, -8.0, 100.0);
geo::Wgs84 const far_away = geo::Wgs84::from_degrees(41.0, -8.0, 100.0);

TEST(BelievedPosition, FollowsAFastVehicleAndALongSilence) {
  BelievedPosition position;
  EXPECT_TRUE(position.note(here, {}));
  EXPECT_TRUE(position.note(geo::displaced(here, {.north = 60.0, .east = 0.0, .down = 0.0}), 1s));
  EXPECT_TRUE(position.note(geo::displaced(here, {.north = 3000.0, .east = 0.0, .down = 0.0}), 30s));
  EXPECT_FALSE(position.jump());
}

TEST(BelievedPosition, NoticesAJump) {
  BelievedPosition position;
  position.note(here, {});
  EXPECT_FALSE(position.note(far_away, 200ms));
  ASSERT_TRUE(position.jump());
  EXPECT_EQ(to_text(*position.jump()), "its position jumped by 111.0 km within 0.2 s");
  EXPECT_EQ(position.jump()->lasts, base::Duration{});
  EXPECT_FALSE(position.note(far_away, 1s));
  EXPECT_EQ(position.jump()->lasts, 1s);
}

TEST(BelievedPosition, ForgetsAJumpThatWasTakenBack) {
  BelievedPosition position;
  position.note(here, {});
  position.note(far_away, 200ms);
  EXPECT_TRUE(position.note(here, 200ms));
  EXPECT_FALSE(position.jump());
}

TEST(BelievedPosition, CountsAnewWhenItJumpsAbout) {
  BelievedPosition position;
  position.note(here, {});
  position.note(far_away, 200ms);
  position.note(far_away, 1s);
  position.note(geo::Wgs84::from_degrees(42.0, -8.0, 100.0), 200ms);
  EXPECT_EQ(position.jump()->lasts, base::Duration{});
}

}  // namespace
}  // namespace lapwing::fleet
