#include "host/eyes/shot_look.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using nlohmann::json;

TEST(ShotLook, QuestionsComeBack) {
  ShotQuestion const question{.source = "/dev/video0", .width_px = 960, .height_px = 720};
  EXPECT_EQ(shot_question_in(shot_request(question)).value(), question);
}

TEST(ShotLook, WhatIsNoQuestionIsRefused) {
  for (auto const* head : {R"({})", R"({"source": 7, "wanted_width": 9, "wanted_height": 9})",
                           R"({"source": "", "wanted_width": 9, "wanted_height": 9})", R"({"source": "/dev/video0"})",
                           R"({"source": "/dev/video0", "wanted_width": 9, "wanted_height": 90000})"})
    EXPECT_FALSE(shot_question_in({.head = json::parse(head)})) << head;
}

TEST(ShotLook, PicturesComeBackRawAndAsFiles) {
  auto const raw = shot_in(shot_answer({.bytes = "abcdef", .width = 2, .height = 1}));
  ASSERT_TRUE(raw) << raw.error().message;
  EXPECT_EQ(raw->bytes, "abcdef");
  EXPECT_EQ(raw->width, 2);
  EXPECT_EQ(shot_in(shot_answer({.bytes = "a file"})).value().width, 0);
}

TEST(ShotLook, WhatIsNoPictureIsRefused) {
  EXPECT_EQ(shot_in(refusal("it is unplugged")).error().message, "it is unplugged");
  EXPECT_FALSE(shot_in({}));
  EXPECT_FALSE(shot_in({.head = json::parse(R"({"width": 2, "height": 2})"), .body = "abcdef"}));
}

}  // namespace
}  // namespace lapwing::host
