#include "host/eyes/look_frame.hpp"

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

TEST(LookFrame, ComesBackWhereverItIsCut) {
  LookFrame const first{.head = {{"look", "signs"}}, .body = "two\nlines"};
  LookFrame const second{.head = {{"look", "nothing"}}, .body = ""};
  auto const bytes = to_bytes(first) + to_bytes(second);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    LookFrameReader reader;
    std::vector<LookFrame> frames;
    for (auto const& piece : {bytes.substr(0, cut), bytes.substr(cut)}) {
      reader.take(piece);
      for (auto frame = reader.next(); frame && *frame; frame = reader.next()) frames.push_back(**frame);
    }
    ASSERT_EQ(frames.size(), 2U) << "cut at " << cut;
    EXPECT_EQ(frames[0].head["look"], "signs");
    EXPECT_EQ(frames[0].body, first.body);
    EXPECT_EQ(frames[1].head["look"], "nothing");
    EXPECT_TRUE(frames[1].body.empty());
    EXPECT_TRUE(reader.is_empty());
  }
}

bool is_refused(std::string_view bytes) {
  LookFrameReader reader;
  reader.take(bytes);
  return !reader.next();
}

TEST(LookFrame, WhatIsNoneIsRefused) {
  EXPECT_TRUE(is_refused("nonsense\n"));
  EXPECT_TRUE(is_refused("[1, 2]\n"));
  EXPECT_TRUE(is_refused("{\"bytes\": -1}\n"));
  EXPECT_TRUE(is_refused("{\"bytes\": \"many\"}\n"));
  EXPECT_TRUE(is_refused("{\"bytes\": 200000000}\n")) << "before anything of it has come";
  EXPECT_TRUE(is_refused(std::string(most_head_bytes + 1, ' ')));
}

TEST(LookFrame, ABeginningIsNotRefused) {
  LookFrameReader reader;
  reader.take("{\"bytes\": 3");
  EXPECT_FALSE(*reader.next());
  EXPECT_FALSE(reader.is_empty());
  reader.take("}\nab");
  EXPECT_FALSE(*reader.next());
  EXPECT_FALSE(reader.is_empty());
}

TEST(LookFrame, RefusalsSayWhy) {
  EXPECT_EQ(refusal_in(refusal("it is black")), "it is black");
  EXPECT_FALSE(refusal_in({.head = {{"signs", 0}}}));
  EXPECT_TRUE(refusal_in({.head = {{"error", 7}}}));
}

}  // namespace
}  // namespace lapwing::host
