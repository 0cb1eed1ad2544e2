#include "perceive/filming.hpp"

#include <gtest/gtest.h>

namespace lapwing::perceive {
namespace {

using namespace std::chrono_literals;

/// In real time, since pictures come from a thread. What the camera is and from where it looks may be changed.
struct Set {
  base::Loop loop;
  base::LogHub hub;
  std::optional<video::CameraSettings> camera =
      video::CameraSettings{.kind = video::CameraSettings::Kind::pattern, .lens = geo::pinhole(64, 48, 1.0)};
  std::optional<video::Moment> moment = video::Moment{.at = base::UtcTime(1700000000s)};
  double pictures_a_s = 200.0;
  Filming film{loop,
               {.camera = [this] { return camera; },
                .moment = [this] { return moment; },
                .pictures_a_s = [this] { return pictures_a_s; }},
               base::Logger(hub, "test")};

  Filming::Shot next(std::uint64_t after) { return loop.run_until_done(film.next(after)); }
  void wait(base::Duration time) {
    auto const waiting = [&]() -> base::Task<> { co_await loop.sleep(time); };
    loop.run_until_done(waiting());
  }
};

TEST(Filming, GivesOnePictureAfterTheOther) {
  Set set;
  auto const first = set.next(0);
  EXPECT_EQ(first.frame.picture.cols, 64);
  EXPECT_EQ(first.frame.taken, base::UtcTime(1700000000s));
  EXPECT_GT(set.next(first.number).number, first.number);
  EXPECT_TRUE(set.film.record().is_open);
  EXPECT_EQ(set.film.record().fault, "");
}

TEST(Filming, WaitsUntilItIsKnownWhereTheDroneIs) {
  Set set;
  set.moment.reset();
  set.wait(100ms);
  EXPECT_EQ(set.film.record().pictures, 0U);
  EXPECT_EQ(set.film.record().failed, 0U) << "that is no fault";
  set.moment = video::Moment{};
  EXPECT_GT(set.next(0).number, 0U);
}

TEST(Filming, TellsOfACameraThatDoesNotOpen) {
  Set set;
  set.camera = video::CameraSettings{.kind = video::CameraSettings::Kind::folder, .folder = "/nowhere"};
  set.wait(200ms);
  EXPECT_FALSE(set.film.record().is_open);
  EXPECT_NE(set.film.record().fault.find("/nowhere"), std::string::npos) << set.film.record().fault;
  EXPECT_EQ(set.film.record().failed, 1U) << "it is not tried all the time";
}

}  // namespace
}  // namespace lapwing::perceive
