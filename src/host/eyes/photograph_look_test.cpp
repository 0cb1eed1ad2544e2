#include "host/eyes/photograph_look.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using nlohmann::json;

TEST(PhotographLook, AnswersComeBack) {
  auto const picture =
      photograph_in(photograph_answer({.jpeg = "all of it", .thumbnail = "small", .width = 960, .height = 720}));
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->jpeg, "all of it");
  EXPECT_EQ(picture->thumbnail, "small");
  EXPECT_EQ(picture->width, 960);
  EXPECT_EQ(picture->height, 720);
}

TEST(PhotographLook, WhatIsNoAnswerIsRefused) {
  for (auto const* head :
       {R"({})", R"({"width": 9, "height": 9})", R"({"width": 9, "height": 9, "jpeg_bytes": 0})",
        R"({"width": 9, "height": 9, "jpeg_bytes": 5})", R"({"width": 0, "height": 9, "jpeg_bytes": 2})",
        R"({"width": 90000000, "height": 90000000, "jpeg_bytes": 2})"})
    EXPECT_FALSE(photograph_in({.head = json::parse(head), .body = "abcde"})) << head;
  EXPECT_EQ(photograph_in(refusal("it is black")).error().message, "it is black");
}

}  // namespace
}  // namespace lapwing::host
