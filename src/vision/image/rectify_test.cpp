#include "vision/image/rectify.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

TEST(Rectify, CornersComeInOrder) {
  Quadrilateral const expected{cv::Point2f(10, 12), cv::Point2f(90, 5), cv::Point2f(95, 60), cv::Point2f(8, 50)};
  EXPECT_EQ(in_order({expected[2], expected[0], expected[3], expected[1]}), expected);
  EXPECT_EQ(in_order(expected), expected);
}

TEST(Rectify, ASignSeenFromTheSideIsSeenFromTheFront) {
  cv::Mat sign(60, 120, CV_8UC3, cv::Scalar(0, 0, 200));
  cv::rectangle(sign, {60, 0, 60, 60}, {0, 200, 0}, cv::FILLED);
  Quadrilateral const flat{cv::Point2f(0, 0), cv::Point2f(120, 0), cv::Point2f(120, 60), cv::Point2f(0, 60)};
  Quadrilateral const seen{cv::Point2f(50, 40), cv::Point2f(170, 70), cv::Point2f(170, 120), cv::Point2f(50, 140)};
  cv::Mat picture;
  cv::warpPerspective(sign, picture, cv::getPerspectiveTransform(flat.data(), seen.data()), {220, 200});
  auto const front = rectified(picture, seen);
  EXPECT_EQ(front.size(), cv::Size(124, 100));
  EXPECT_GT(front.at<cv::Vec3b>(50, 20)[2], 150);
  EXPECT_GT(front.at<cv::Vec3b>(50, 100)[1], 150);
  EXPECT_LT(front.at<cv::Vec3b>(5, 5)[1], 50);
}

TEST(Rectify, ItsSizeHasLimits) {
  cv::Mat const picture(10, 10, CV_8UC3, cv::Scalar(1, 2, 3));
  Quadrilateral const huge{cv::Point2f(-1e6F, 0), cv::Point2f(1e6F, 0), cv::Point2f(1e6F, 10), cv::Point2f(-1e6F, 10)};
  EXPECT_EQ(rectified(picture, huge, 500).size(), cv::Size(500, 8));
  Quadrilateral const point{};
  EXPECT_EQ(rectified(picture, point).size(), cv::Size(8, 8));
}

}  // namespace
}  // namespace lapwing::vision
