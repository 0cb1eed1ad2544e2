#include "sim/building/scene/faces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/building/noise.hpp"
#include "sim/building/scene/solids.hpp"

namespace lapwing::sim::building {
namespace {

Shift unit(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

TEST(FaceIndex, FindsWhatLookingAtEveryFaceFinds) {
  Noise noise(3, "test");
  std::vector<Face> faces;
  for (int i = 0; i < 60; ++i)
    add_faces(rectangle({{noise.uniform(-10, 10), noise.uniform(-6, 6)}, noise.uniform(-3, 3)}, noise.uniform(0.1, 4),
                        noise.uniform(0.05, 1)),
              {}, faces);
  FaceIndex const index(faces);
  int hits = 0;
  for (int i = 0; i < 4'000; ++i) {
    Place const from(noise.uniform(-14, 14), noise.uniform(-9, 9));
    auto const way = i % 10 == 0 ? unit(i * 1.5707963267948966) : unit(noise.uniform(-4, 4));
    std::optional<Hit> nearest;
    for (auto const& face : faces) {
      auto const hit = meet(face, from, way, nearest ? nearest->range_m : 8.0);
      if (hit) nearest = hit;
    }
    auto const found = index.cast(from, way, 8.0);
    ASSERT_EQ(found.has_value(), nearest.has_value()) << i;
    if (!found) continue;
    ++hits;
    EXPECT_NEAR(found->range_m, nearest->range_m, 1e-9);
    EXPECT_NEAR(found->normal.length(), 1.0, 1e-9);
    EXPECT_LT(found->normal.dot(way), 0.0);
  }
  EXPECT_GT(hits, 1'000);
}

TEST(FaceIndex, OfNothingMeetsNothing) {
  FaceIndex const index({});
  EXPECT_FALSE(index.cast({0, 0}, {1, 0}, 100.0));
}

TEST(Post, IsMetOnItsRimAndNotFromInside) {
  Post const post{.middle = {3, 0}, .radius_m = 0.5};
  auto const hit = meet(post, {0, 0}, {1, 0}, 10.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range_m, 2.5, 1e-12);
  EXPECT_NEAR(hit->normal.x(), -1.0, 1e-12);
  EXPECT_FALSE(meet(post, {0, 0}, {1, 0}, 2.4));
  EXPECT_FALSE(meet(post, {3.1, 0}, {1, 0}, 10.0));
  EXPECT_FALSE(meet(post, {0, 0.6}, {1, 0}, 10.0));
}

}  // namespace
}  // namespace lapwing::sim::building
