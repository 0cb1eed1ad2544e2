#include "host/eyes/sign_look.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

using nlohmann::json;

TEST(SignLook, AnswersComeBack) {
  vision::Detection sign{.category = "sign", .box = {1.5, 2.0, 30.0, 10.25}, .score = 0.75};
  sign.text = "221";
  vision::Detection kind_alone{.category = "sign", .box = {0.0, 0.0, 8.0, 8.0}, .score = 0.5};
  kind_alone.kind = "office";
  auto const seen = signs_in(sign_answer({.signs = {{sign, "crop"}, {kind_alone, "other"}}, .is_sharp = false}));
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_FALSE(seen->is_sharp);
  ASSERT_EQ(seen->signs.size(), 2U);
  EXPECT_EQ(seen->signs[0].sign.category, "sign");
  EXPECT_EQ(seen->signs[0].sign.box, sign.box);
  EXPECT_EQ(seen->signs[0].sign.score, 0.75);
  EXPECT_EQ(seen->signs[0].sign.text, "221");
  EXPECT_EQ(seen->signs[0].crop, "crop");
  EXPECT_EQ(seen->signs[1].sign.kind, "office");
  EXPECT_FALSE(seen->signs[1].sign.text);
  EXPECT_EQ(seen->signs[1].crop, "other");
}

TEST(SignLook, WhatIsNoAnswerIsRefused) {
  for (auto const* head :
       {R"({})", R"({"signs": [], "is_sharp": 1})", R"({"signs": 7, "is_sharp": true})",
        R"({"signs": [7], "is_sharp": true})", R"({"signs": [{"box": [1, 2, 3], "score": 0.5}], "is_sharp": true})",
        R"({"signs": [{"box": [1, 2, 3, -4], "score": 0.5}], "is_sharp": true})",
        R"({"signs": [{"box": [1, 2, 3, 4], "score": 1.5}], "is_sharp": true})",
        R"({"signs": [{"box": [1, 2, 3, 1e300], "score": 0.5}], "is_sharp": true})",
        R"({"signs": [{"box": [1, 2, 3, 4], "score": 0.5, "text": 221}], "is_sharp": true})",
        R"({"signs": [{"box": [1, 2, 3, 4], "score": 0.5, "crop_bytes": 1}], "is_sharp": true})"})
    EXPECT_FALSE(signs_in({.head = json::parse(head)})) << head;
  EXPECT_EQ(signs_in(refusal("it is black")).error().message, "it is black");
}

}  // namespace
}  // namespace lapwing::host
