#include "video/rtsp/jpeg.hpp"

#include <gtest/gtest.h>

#include "video/rtsp/testing/player.hpp"

namespace lapwing::video {
namespace {

TEST(ReadJpeg, GivesThePictureAsItIs) {
  auto const picture = read_jpeg(*testing::grey_jpeg(100, 33, 20));
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->width, 33);
  EXPECT_EQ(picture->height, 20);
  ASSERT_EQ(picture->bytes->size(), 33U * 20 * 4);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(static_cast<unsigned char>(picture->bytes->at(1000 + i)), 100, 3);
}

TEST(ReadJpeg, RefusesWhatIsTorn) {
  auto const jpeg = testing::grey_jpeg(100);
  for (std::size_t length = 0; length + 2 < jpeg->size(); ++length)
    EXPECT_FALSE(read_jpeg(jpeg->substr(0, length))) << length;
  EXPECT_FALSE(read_jpeg(std::string(1000, 'x')));
}

TEST(ReadJpeg, RefusesWhatSaysToBeHuge) {
  auto jpeg = *testing::grey_jpeg(100);
  auto const frame = jpeg.find("\xFF\xC0");  // then length and depth, height, width
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame + 5, 4, std::string("\x40\x10\x40\x10"));
  auto const read = read_jpeg(jpeg);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("16400 by 16400"), std::string::npos) << read.error().message;
}

}  // namespace
}  // namespace lapwing::video
