#include "perceive/live_view.hpp"

#include <gtest/gtest.h>

#include "base/wall_clock.hpp"
#include "link/pictures/picture_client.hpp"
#include "vision/image/image.hpp"

namespace lapwing::perceive {
namespace {

using namespace std::chrono_literals;
using link::pictures::View;

cv::Mat grey() {
  return {480, 640, CV_8UC3, cv::Scalar(90, 90, 90)};
}

/// A camera ten metres above the middle of a slot, looking straight down.
explore::LotSight sight_of_a_slot() {
  explore::LotSight sight;
  sight.view = {.lens = geo::pinhole(640, 480, 1.0821),
                .site_from_camera = geo::camera_at({0.0, 0.0, 10.0}, 1.5708, 0.0)};
  sight.slots.push_back(
      {.outline = {{{-1.2, -2.5}, {1.2, -2.5}, {1.2, 2.5}, {-1.2, 2.5}}}, .surety = 0.9, .taken_chance = 0.9});
  return sight;
}

/// Whether the pixel is no longer grey.
bool is_drawn(cv::Mat const& picture, double x, double y) {
  cv::Rect const around(static_cast<int>(x) - 3, static_cast<int>(y) - 3, 7, 7);
  return cv::norm(picture(around), grey()(around), cv::NORM_INF) > 30.0;
}

TEST(LiveView, DrawsASlotWhereItLies) {
  auto const sight = sight_of_a_slot();
  auto const drawn = with_findings(grey(), base::UtcTime(1700000000s), &sight);
  for (auto const& corner : sight.slots[0].outline) {
    auto const pixel = geo::seen_at(sight.view, corner);
    ASSERT_TRUE(pixel);
    EXPECT_TRUE(is_drawn(drawn, pixel->x, pixel->y)) << pixel->x << ", " << pixel->y;
  }
  EXPECT_FALSE(is_drawn(drawn, 40.0, 40.0));
  EXPECT_TRUE(is_drawn(drawn, 30.0, 470.0)) << "the time stands in the lower left corner";
}

TEST(LiveView, LeavesOutWhatLiesBeyondTheEdge) {
  auto sight = sight_of_a_slot();
  for (auto& corner : sight.slots[0].outline) corner = {corner.x() + 6.0, corner.y()};
  EXPECT_FALSE(is_drawn(with_findings(grey(), {}, &sight), 600.0, 240.0));
}

/// In real time, since sockets live in it.
TEST(LiveView, ShowsTheNewestToWhoLooks) {
  base::Loop loop;
  auto const view = LiveView::open(loop, {.port = 0}).value();
  auto const raw = link::pictures::PictureClient::open(loop, {.port = view->port()}, View::raw).value();
  auto const annotated = link::pictures::PictureClient::open(loop, {.port = view->port()}, View::annotated).value();
  auto const taken = base::wall_now();
  // Whoever looks comes in sometime: pictures go on coming, as from a camera.
  auto const camera = [&]() -> base::Task<> {
    for (;;) {
      view->show(grey(), taken);
      view->show(grey(), taken, sight_of_a_slot());
      co_await loop.sleep(10ms);
    }
  };
  base::Scope scope(loop);
  scope.spawn(camera());
  auto const plain = loop.run_until_done(raw->next(0, 10s));
  auto const drawn = loop.run_until_done(annotated->next(0, 10s));
  ASSERT_TRUE(plain && drawn);
  EXPECT_LT(plain->picture.taken - taken, 1ms);
  EXPECT_TRUE(plain->picture.jpeg->starts_with("\xFF\xD8"));
  EXPECT_GT(drawn->picture.jpeg->size(), plain->picture.jpeg->size());
}

}  // namespace
}  // namespace lapwing::perceive
