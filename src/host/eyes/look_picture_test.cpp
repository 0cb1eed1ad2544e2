#include "host/eyes/look_picture.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using nlohmann::json;

TEST(LookPicture, PixelsComeBack) {
  LookFrame request;
  put_picture(request, {.bytes = std::string(2 * 3 * 3, 'x'), .width = 2, .height = 3});
  auto const picture = take_picture(request);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 2);
  EXPECT_EQ(picture->height, 3);
  EXPECT_EQ(picture->bytes.size(), 18U);
}

TEST(LookPicture, AFileHasItsSizeInItself) {
  LookFrame request;
  put_picture(request, {.bytes = "a JPEG file"});
  auto const picture = take_picture(request);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 0);
  EXPECT_EQ(picture->bytes, "a JPEG file");
}

TEST(LookPicture, PixelsThatAreNotAsManyAsWasSaidAreRefused) {
  for (auto const* head : {R"({"width": 2, "height": 3})", R"({"width": 2})", R"({"width": -2, "height": -3})",
                           R"({"width": 0, "height": 3})", R"({"width": 100000000, "height": 100000000})"}) {
    LookFrame request{.head = json::parse(head), .body = std::string(17, 'x')};
    EXPECT_FALSE(take_picture(request)) << head;
  }
}

}  // namespace
}  // namespace lapwing::host
