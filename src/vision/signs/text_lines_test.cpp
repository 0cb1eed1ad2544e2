#include "vision/signs/text_lines.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "vision/detection.hpp"

namespace lapwing::vision {
namespace {

cv::Mat sign(cv::Scalar const& ground, cv::Scalar const& letters) {
  cv::Mat picture(300, 600, CV_8U, ground);
  cv::putText(picture, "ITB-221", {180, 160}, cv::FONT_HERSHEY_DUPLEX, 1.6, letters, 3, cv::LINE_AA);
  return picture;
}

/// The best row covers where the letters are.
void expect_found(cv::Mat const& picture) {
  auto const lines = find_text_lines(picture);
  ASSERT_FALSE(lines.empty());
  auto const box = lines.front().box();
  EXPECT_GT(overlap({box.x, box.y, box.width, box.height}, {180, 124, 212, 38}), 0.5);
  EXPECT_GE(lines.front().letters, 5);
}

TEST(TextLines, DarkOnLightAndLightOnDark) {
  expect_found(sign(225, 40));
  expect_found(sign(50, 230));
}

TEST(TextLines, ARowThatIsSlanted) {
  cv::Mat slanted;
  cv::warpAffine(sign(225, 40), slanted, cv::getRotationMatrix2D({300, 150}, 6.0, 1.0), {600, 300}, cv::INTER_LINEAR,
                 cv::BORDER_REPLICATE);
  auto const lines = find_text_lines(slanted);
  ASSERT_FALSE(lines.empty());
  auto const& corners = lines.front().corners;
  double const slope = (corners[1].y - corners[0].y) / (corners[1].x - corners[0].x);
  EXPECT_NEAR(slope, -std::tan(6.0 * CV_PI / 180.0), 0.04);
}

/// Seen aslant: narrow letters, whose edges run into each other.
cv::Mat narrow_and_blurred(cv::Scalar const& ground, cv::Scalar const& letters) {
  cv::Mat wide(240, 500, CV_8U, ground);
  cv::putText(wide, "221", {180, 85}, cv::FONT_HERSHEY_DUPLEX, 1.8, letters, 3, cv::LINE_AA);
  cv::Mat picture;
  cv::resize(wide, picture, {170, 240}, 0.0, 0.0, cv::INTER_AREA);
  cv::GaussianBlur(picture, picture, {5, 5}, 0.8);
  return picture;
}

TEST(TextLines, LettersThatHaveGrownTogether) {
  for (auto const& picture : {narrow_and_blurred(225, 40), narrow_and_blurred(50, 230)}) {
    auto const lines = find_text_lines(picture);
    ASSERT_FALSE(lines.empty());
    EXPECT_EQ(lines.front().letters, 3);
  }
}

TEST(TextLines, AWallHasNone) {
  EXPECT_TRUE(find_text_lines(cv::Mat(300, 600, CV_8U, cv::Scalar(200))).empty());
  EXPECT_TRUE(find_text_lines(cv::Mat(3, 3, CV_8U, cv::Scalar(200))).empty());
}

TEST(TextLines, NoMoreThanWanted) {
  cv::Mat page(900, 900, CV_8U, cv::Scalar(230));
  for (int y = 40; y < 880; y += 45)
    cv::putText(page, "many words here", {40, y}, cv::FONT_HERSHEY_DUPLEX, 0.9, 30, 2, cv::LINE_AA);
  EXPECT_EQ(find_text_lines(page, 5).size(), 5U);
}

}  // namespace
}  // namespace lapwing::vision
