#include "vision/signs/sign_finder.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

/// Reads the same everywhere.
class Parrot final : public LineReader {
 public:
  explicit Parrot(Reading words) : words_(std::move(words)) {}
  Reading read(cv::Mat const& line) override { return line.empty() ? Reading{} : words_; }

 private:
  Reading words_;
};

cv::Mat plate(char const* text) {
  cv::Mat picture(400, 640, CV_8UC3, cv::Scalar(210, 215, 220));
  cv::rectangle(picture, {180, 120, 300, 110}, {60, 40, 30}, cv::FILLED);
  cv::putText(picture, text, {205, 195}, cv::FONT_HERSHEY_DUPLEX, 1.8, {240, 240, 240}, 4, cv::LINE_AA);
  return picture;
}

template <class... R>
SignFinder finder(R... readings) {
  std::vector<std::unique_ptr<LineReader>> readers;
  (readers.push_back(std::make_unique<Parrot>(readings)), ...);
  return SignFinder(std::move(readers));
}

TEST(SignFinder, ReadersVoteOnTheNumber) {
  auto const signs = finder(Reading{"ITB-221", 0.9}, Reading{"ITB-271", 0.4}).find(plate("ITB-221"));
  ASSERT_EQ(signs.size(), 1U);
  EXPECT_EQ(signs.front().category, "sign");
  EXPECT_EQ(signs.front().text, "ITB-221");
  EXPECT_GT(overlap(signs.front().box, {190, 140, 260, 70}), 0.5);
  ASSERT_TRUE(signs.front().corners);
  auto const& box = signs.front().box;
  auto const& corners = *signs.front().corners;
  EXPECT_NEAR(corners[0].x, box.x, 6.0) << "upper left";
  EXPECT_NEAR(corners[0].y, box.y, 6.0);
  EXPECT_NEAR(corners[2].x, box.x + box.width, 6.0) << "lower right";
  EXPECT_NEAR(corners[2].y, box.y + box.height, 6.0);
}

TEST(SignFinder, RowsWithoutMeaningAreNoSigns) {
  EXPECT_TRUE(finder(Reading{"PUSH", 0.9}).find(plate("PUSHED")).empty());
  EXPECT_TRUE(finder(Reading{"221", 0.1}).find(plate("ITB-221")).empty());
  EXPECT_TRUE(finder(Reading{"221", 0.9}).find(cv::Mat(200, 200, CV_8UC3, cv::Scalar(9, 9, 9))).empty());
  EXPECT_TRUE(finder(Reading{"221", 0.9}).find({}).empty());
}

TEST(SignFinder, TesseractReadsASign) {
  auto reader = make_tesseract_reader();
  ASSERT_TRUE(reader) << reader.error().message;
  std::vector<std::unique_ptr<LineReader>> readers;
  readers.push_back(*std::move(reader));
  auto const signs = SignFinder(std::move(readers)).find(plate("A-221"));
  ASSERT_EQ(signs.size(), 1U);
  EXPECT_EQ(signs.front().text, "A-221");
}

TEST(SignFinder, ARecogniserThatIsNoneIsRefused) {
  EXPECT_FALSE(make_recogniser({.narrow = "no network", .wide = "no network", .characters = "a\nb\n"}));
  EXPECT_FALSE(make_recogniser({}));
}

Detection thing(char const* category, double x) {
  return {.category = category, .box = {x, 100, 100, 220}, .score = 0.9};
}

TEST(SignFinder, TheNearestDoorGetsTheName) {
  auto sign = thing("sign", 330.0);
  sign.box = {330, 150, 30, 12};
  sign.text = "221";
  sign.kind = "office";
  std::vector<Detection> found{thing("door", 100.0), thing("door", 380.0), sign};
  name_doors(found);
  EXPECT_FALSE(found[0].text);
  EXPECT_EQ(found[1].text, "221");
  EXPECT_EQ(found[1].kind, "office");
}

TEST(SignFinder, ASignFarFromEveryDoorNamesNone) {
  auto sign = thing("sign", 700.0);
  sign.text = "221";
  std::vector<Detection> found{thing("door", 100.0), sign};
  name_doors(found);
  EXPECT_FALSE(found[0].text);
}

}  // namespace
}  // namespace lapwing::vision
