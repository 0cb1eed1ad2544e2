// Cameras that give pictures and some that do not, and programs in place of the one that looks.
#include "host/eyes/picture_eyes.hpp"

#include <set>

#include <gtest/gtest.h>

#include "base/async/scope.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;
namespace code = robot::code;

struct PictureEyes : ::testing::Test {
  /// `script` answers each line that it reads; the pictures have no bytes.
  void open(std::string script, std::size_t cameras = 1) {
    child = std::make_unique<LookingChild>(
        loop,
        LookingChild::Settings{.program = {.program = "/bin/sh", .words = {"-c", std::move(script)}, .longest = 0s},
                               .longest_look = 1s},
        base::Logger(hub, "test"));
    std::vector<PictureSource> sources;
    for (std::size_t i = 0; i < cameras; ++i)
      sources.push_back({.mount = {.yaw_rad = static_cast<double>(i)}, .take = [this, i] { return take(i); }});
    eyes = eyes_with(loop, sources, sources.front(), *child);
  }
  base::Task<base::Result<PictureSource::Develop>> take(std::size_t camera) {
    if (silent.contains(camera)) co_return base::fail(base::ErrorKind::lost, "unplugged");
    co_return PictureSource::Develop([] { return LookPicture(); });
  }
  std::optional<robot::Look> look(std::size_t camera = 0) { return loop.run_until_done(eyes.for_tags[camera].look()); }

  base::LogHub hub;
  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  std::unique_ptr<LookingChild> child;
  robot::Eyes eyes;
  std::set<std::size_t> silent;
};

constexpr auto sees_nothing = R"(while read line; do echo '{"signs": [], "is_sharp": true}'; done)";

TEST_F(PictureEyes, LookWithEachCameraAndAreWell) {
  open(sees_nothing, 2);
  ASSERT_EQ(eyes.for_tags.size(), 2U);
  EXPECT_EQ(eyes.for_tags[1].mount.yaw_rad, 1.0);
  EXPECT_TRUE(look(0));
  EXPECT_TRUE(look(1));
  EXPECT_EQ(eyes.trouble(), code::none);
}

TEST_F(PictureEyes, SayThatOneCameraGivesNoPicturesUntilItDoesAgain) {
  open(sees_nothing, 2);
  silent = {1};
  EXPECT_TRUE(look(0));
  EXPECT_FALSE(look(1));
  EXPECT_FALSE(look(1));
  EXPECT_TRUE(look(0));
  EXPECT_EQ(eyes.trouble(), code::camera_silent) << "whatever the other one does";
  silent.clear();
  EXPECT_TRUE(look(1));
  EXPECT_EQ(eyes.trouble(), code::none);
}

TEST_F(PictureEyes, SayThatMostPicturesAreBlurredWhileTheyAre) {
  // A sign is seen in the first three of four pictures; in the end they are sharp again.
  open(R"(n=0; while read line; do n=$((n + 1)); sharp=false; [ $n -gt 40 ] && sharp=true
if [ $((n % 4)) -eq 0 ]; then echo '{"signs": [], "is_sharp": true}'
else echo '{"signs": [{"box": [1, 2, 30, 20], "score": 0.5}], "is_sharp": '$sharp'}'; fi; done)");
  for (int i = 0; i < 24; ++i) ASSERT_TRUE(look());
  EXPECT_EQ(eyes.trouble(), code::none) << "a few pictures are no reason to complain";
  for (int i = 0; i < 16; ++i) ASSERT_TRUE(look());
  EXPECT_EQ(eyes.trouble(), code::pictures_blurred);
  for (int i = 0; i < 16; ++i) ASSERT_TRUE(look());
  EXPECT_EQ(eyes.trouble(), code::none);
}

TEST_F(PictureEyes, SayThatWhoLooksIsGone) {
  open("exit 1");
  EXPECT_FALSE(look());
  EXPECT_EQ(eyes.trouble(), code::eyes_away);
  child = std::make_unique<LookingChild>(loop, LookingChild::Settings{.program = {.program = "/nowhere/at/all"}},
                                         base::Logger(hub, "test"));
  eyes = eyes_with(loop, {{.mount = {}, .take = [this] { return take(0); }}}, std::nullopt, *child);
  EXPECT_FALSE(look());
  EXPECT_EQ(eyes.trouble(), code::no_reader);
}

TEST_F(PictureEyes, SayNothingWhileALookHangs) {
  base::Loop real;
  LookingChild hangs(
      real, {.program = {.program = "/bin/sh", .words = {"-c", "exec sleep 60"}, .longest = 0s}, .takes = std::nullopt},
      base::Logger(hub, "test"));
  auto const slow = eyes_with(real, {{.mount = {}, .take = [this] { return take(0); }}}, std::nullopt, hangs);
  base::Scope scope(real);
  scope.spawn([](robot::Eyes const& by) -> base::Task<> { (void)co_await by.for_tags.front().look(); }(slow));
  EXPECT_TRUE(real.run_until_done([](base::Loop& on, robot::Eyes const& by) -> base::Task<bool> {
    auto const deadline = on.now() + 20s;
    while (by.trouble() && on.now() < deadline) co_await on.sleep(50ms);
    co_return !by.trouble();
  }(real, slow)));
}

TEST_F(PictureEyes, TellWhyThereIsNoPhotograph) {
  open(R"(while read line; do echo '{"error": "it is black"}'; done)");
  EXPECT_EQ(loop.run_until_done(eyes.photographer->take()).error().message, "it is black");
  silent = {0};
  EXPECT_EQ(loop.run_until_done(eyes.photographer->take()).error().message, "unplugged");
}

}  // namespace
}  // namespace lapwing::host
