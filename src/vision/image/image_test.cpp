#include "vision/image/image.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

std::span<std::byte const> bytes_of(std::string const& text) {
  return std::as_bytes(std::span(text));
}

/// 40 by 20, red in its upper left corner.
cv::Mat flag() {
  cv::Mat picture(20, 40, CV_8UC3, cv::Scalar(255, 255, 255));
  cv::rectangle(picture, {0, 0, 10, 10}, {0, 0, 255}, cv::FILLED);
  return picture;
}

std::string encoded(char const* extension, cv::Mat const& picture) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, picture, bytes);
  return {bytes.begin(), bytes.end()};
}

/// A JPEG whose EXIF says how the camera was held.
std::string jpeg_held(int orientation) {
  std::string const tiff("II\x2A\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 18);
  std::string body = std::string("Exif\0\0", 6) + tiff + static_cast<char>(orientation) + std::string(7, '\0');
  std::string const segment = std::string("\xFF\xE1\0", 3) + static_cast<char>(body.size() + 2) + body;
  auto jpeg = encode_jpeg(flag());
  jpeg.insert(2, segment);
  return jpeg;
}

TEST(Image, ReadsJpegPngAndWebp) {
  for (auto const* extension : {".jpg", ".png", ".webp"}) {
    auto const image = decode_image(bytes_of(encoded(extension, flag())));
    ASSERT_TRUE(image) << extension;
    EXPECT_EQ(image->stored.size(), cv::Size(40, 20)) << extension;
    EXPECT_LT(image->stored.at<cv::Vec3b>(4, 4)[0], 60) << extension;
  }
}

TEST(Image, ExifTurnsWhatIsSeenAndNotWhatIsStored) {
  for (int orientation = 1; orientation <= 8; ++orientation) {
    auto const image = decode_image(bytes_of(jpeg_held(orientation)));
    ASSERT_TRUE(image) << orientation;
    EXPECT_EQ(image->stored.size(), cv::Size(40, 20)) << orientation;
    auto const upright = image->upright();
    EXPECT_EQ(upright.size(), orientation < 5 ? cv::Size(40, 20) : cv::Size(20, 40)) << orientation;
    // The red corner, found where people see it, is told where it is stored.
    cv::Mat red;
    cv::inRange(upright, cv::Scalar(0, 0, 150), cv::Scalar(150, 150, 255), red);
    auto const seen = cv::boundingRect(red);
    auto const box = image->to_stored({double(seen.x), double(seen.y), double(seen.width), double(seen.height)});
    EXPECT_GT(overlap(box, {0, 0, 10, 10}), 0.6) << orientation;
  }
  // A picture that was taken with the camera on its right side is turned clockwise: what was lower left is upper left.
  auto const turned = decode_image(bytes_of(jpeg_held(6)))->upright();
  EXPECT_LT(turned.at<cv::Vec3b>(3, 16)[0], 60);
}

TEST(Image, WhatIsCutOffIsRefused) {
  for (auto const* extension : {".jpg", ".png", ".webp"}) {
    auto const whole = encoded(extension, flag());
    for (std::size_t const length : {whole.size() / 4, whole.size() / 2, whole.size() - whole.size() / 8}) {
      auto const image = decode_image(bytes_of(whole.substr(0, length)));
      ASSERT_FALSE(image) << extension << " " << length;
      EXPECT_EQ(image.error().kind, base::ErrorKind::invalid_input);
      EXPECT_FALSE(image.error().message.empty());
    }
  }
}

TEST(Image, WhatIsNoPictureIsRefused) {
  EXPECT_EQ(decode_image({}).error().message, "the file is empty");
  EXPECT_EQ(decode_image(bytes_of("hello, world")).error().message, "not a picture that can be read");
  EXPECT_EQ(decode_image(bytes_of("II*")).error().hint, "give a JPEG, PNG or WebP file");
  EXPECT_FALSE(decode_image(bytes_of("\xFF\xD8\xFF\xE1\xFF\xFF")));
}

TEST(Image, AHugeSizeIsRefusedBeforeItIsDecoded) {
  auto png = encoded(".png", flag());
  png.replace(16, 8, std::string("\0\1\0\0\0\1\0\0", 8));  // 65536 by 65536
  auto const image = decode_image(bytes_of(png));
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().message, "65536 by 65536 pixels are too many for a picture");
}

}  // namespace
}  // namespace lapwing::vision
