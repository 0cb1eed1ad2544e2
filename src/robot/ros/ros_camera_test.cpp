#include "robot/ros/ros_camera.hpp"

#include <gtest/gtest.h>

#include "base/async/scope.hpp"
#include "bus/participant/topics.hpp"
#include "bus/testing/own_domain.hpp"

namespace lapwing::robot::ros {
namespace {

using namespace std::chrono_literals;

bus::Image two_pixels(std::string const& encoding, std::vector<std::uint8_t> data, std::uint32_t step) {
  return {.height = 1, .width = 2, .encoding = encoding, .step = step, .data = std::move(data)};
}

TEST(RosPicture, IsRedGreenBlueWhateverTheOrder) {
  RosPicture const same{.bytes = "abcdef", .width = 2, .height = 1};
  EXPECT_EQ(picture_of(two_pixels("rgb8", {'a', 'b', 'c', 'd', 'e', 'f'}, 6)).value(), same);
  EXPECT_EQ(picture_of(two_pixels("bgr8", {'c', 'b', 'a', 'f', 'e', 'd'}, 6)).value(), same);
  EXPECT_EQ(picture_of(two_pixels("rgba8", {'a', 'b', 'c', 0, 'd', 'e', 'f', 0}, 8)).value(), same);
  EXPECT_EQ(picture_of(two_pixels("bgra8", {'c', 'b', 'a', 0, 'f', 'e', 'd', 0}, 8)).value(), same);
  EXPECT_EQ(picture_of(two_pixels("mono8", {'a', 'b'}, 2)).value().bytes, "aaabbb");
}

TEST(RosPicture, LeavesOutWhatRowsHaveAtTheirEnds) {
  bus::Image const padded{
      .height = 2, .width = 1, .encoding = "rgb8", .step = 4, .data = {'a', 'b', 'c', 0, 'd', 'e', 'f'}};
  EXPECT_EQ(picture_of(padded).value().bytes, "abcdef");
}

TEST(RosPicture, IsAFileWhereItIsCompressed) {
  auto const picture = picture_of(bus::CompressedImage{.format = "jpeg", .data = {'J', 'P'}}).value();
  EXPECT_EQ(picture, (RosPicture{.bytes = "JP"}));
  EXPECT_FALSE(picture_of(bus::CompressedImage{}));
}

TEST(RosPicture, RefusesWhatIsNone) {
  EXPECT_EQ(picture_of(two_pixels("16UC1", {0, 0, 0, 0}, 4)).error().message, "pictures come as '16UC1'");
  EXPECT_FALSE(picture_of(two_pixels("rgb8", {0, 0, 0, 0, 0}, 6))) << "too few bytes";
  EXPECT_FALSE(picture_of(two_pixels("rgb8", {0, 0, 0, 0, 0, 0}, 5))) << "rows that overlap";
  EXPECT_FALSE(picture_of(bus::Image{.encoding = "rgb8"}));
  EXPECT_FALSE(picture_of(
      bus::Image{.height = 0xFFFFFFFF, .width = 0xFFFFFFFF, .encoding = "mono8", .step = 0xFFFFFFFF, .data = {1}}));
}

struct RosCameraTest : ::testing::Test {
  /// Publishes until one comes.
  template <bus::Message M>
  base::Result<RosCamera::Raw> next_of(RosCamera& camera, std::string const& topic, M const& image) {
    auto writer = bus::Publisher<M>::open(*ros, topic, bus::Profile::standard).value();
    return loop.run_until_done([](base::Loop& on, RosCamera& from, bus::Publisher<M>& to,
                                  M const& what) -> base::Task<base::Result<RosCamera::Raw>> {
      base::Scope scope(on);
      scope.spawn([](base::Loop& beside, bus::Publisher<M>& again, M const& it) -> base::Task<> {
        for (;;) {
          again.publish(it);
          co_await beside.sleep(50ms);
        }
      }(on, to, what));
      auto const deadline = on.now() + 10s;
      for (;;) {  // each end finds the other in its own time
        auto asking = from.next();
        auto raw = co_await std::move(asking);
        if (raw || on.now() > deadline) co_return raw;
      }
    }(loop, camera, writer, image));
  }

  base::Loop loop;
  std::unique_ptr<bus::Bus> ros = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
  std::shared_ptr<bus::Bus> bus = bus::Bus::open(loop, {.domain = bus::testing::own_domain()}).value();
};

TEST_F(RosCameraTest, GivesTheNextPictureOfATopic) {
  auto const camera = RosCamera::open(loop, bus, "/r1/image_raw").value();
  auto const raw = next_of(*camera, "/r1/image_raw", two_pixels("bgr8", {'c', 'b', 'a', 'f', 'e', 'd'}, 6));
  ASSERT_TRUE(raw) << raw.error().message;
  EXPECT_EQ(raw->decode(raw->bytes).value().bytes, "abcdef");
  EXPECT_FALSE(raw->decode("short"));
}

TEST_F(RosCameraTest, GivesPicturesAsLargeAsCamerasMakeThem) {
  constexpr std::uint32_t width = 1'280;
  constexpr std::uint32_t height = 720;
  auto const camera = RosCamera::open(loop, bus, "/r1/large").value();
  auto const raw = next_of(*camera, "/r1/large",
                           bus::Image{.height = height,
                                      .width = width,
                                      .encoding = "rgb8",
                                      .step = 3 * width,
                                      .data = std::vector<std::uint8_t>(std::size_t{3} * width * height, 'x')});
  ASSERT_TRUE(raw) << raw.error().message;
  EXPECT_EQ(raw->decode(raw->bytes).value().bytes, std::string(std::size_t{3} * width * height, 'x'));
}

TEST_F(RosCameraTest, GivesFilesOfACompressedTopic) {
  auto const camera = RosCamera::open(loop, bus, "/r1/image_raw/compressed").value();
  auto const raw = next_of(*camera, "/r1/image_raw/compressed", bus::CompressedImage{.format = "jpeg", .data = {'J'}});
  ASSERT_TRUE(raw) << raw.error().message;
  EXPECT_EQ(raw->decode(raw->bytes).value(), (RosPicture{.bytes = "J"}));
}

TEST_F(RosCameraTest, SaysThatNoneComes) {
  auto const camera = RosCamera::open(loop, bus, "/r1/nobody").value();
  auto const none = loop.run_until_done(camera->next());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "no picture has come on /r1/nobody for 1 s");
  EXPECT_FALSE(RosCamera::open(loop, bus, "no topic"));
}

}  // namespace
}  // namespace lapwing::robot::ros
