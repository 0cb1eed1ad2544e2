#include "vision/signs/room_text.hpp"

#include <array>

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

TEST(RoomText, NumbersAsSignsHaveThem) {
  struct Case {
    char const* line;
    char const* number;
  };
  for (auto const& [line, number] :
       {Case{"16-188", "16-188"}, Case{"W20-205", "W20-205"}, Case{"ITB-221", "ITB-221"}, Case{"A113", "A113"},
        Case{"2.004", "2.004"}, Case{"76\u00B7155", "76-155"}, Case{"76\u2013100SC", "76-100SC"},
        Case{"Room 305", "305"}, Case{"Lab 2.17", "2.17"}, Case{"E25    143", "E25-143"}, Case{"C 118", "C-118"},
        Case{"A1", "A1"}, Case{"2b", "2B"}, Case{"e14-102.", "E14-102"}, Case{"3F-22", "3F-22"},
        Case{"E201B", "E201B"}}) {
    auto const text = room_text(line);
    ASSERT_TRUE(text.number) << line;
    EXPECT_EQ(*text.number, number) << line;
  }
}

TEST(RoomText, LettersBetweenDigitsAreDigits) {
  EXPECT_EQ(room_text("8-1I3").number, "8-113");
  EXPECT_EQ(room_text("2O5").number, "205");
  EXPECT_EQ(room_text("D310").number, "D310");
}

TEST(RoomText, WhatIsNoNumberIsNone) {
  for (auto const* line : {"", "---", "PUSH", "4", "617-253-1000", "12345678", "ROOM", "a,b;c", "Gate A1", "A1 B2"})
    EXPECT_FALSE(room_text(line).number) << line;
}

TEST(RoomText, BuildingAndRoomAreJoined) {
  EXPECT_EQ(joined_number("E25", "143"), "E25-143");
  EXPECT_EQ(joined_number("C", "118"), "C-118");
  EXPECT_FALSE(joined_number("8-113", "143"));
  EXPECT_FALSE(joined_number("143", "E25"));
}

TEST(RoomText, KindsOfRooms) {
  EXPECT_EQ(room_text("WOMEN").kind, "women");
  EXPECT_EQ(room_text("MEN").kind, "men");
  EXPECT_EQ(room_text("Stairs 3").kind, "stairs");
  EXPECT_EQ(room_text("0ffice 7").kind, "office");
  EXPECT_EQ(room_text("Server Room").kind, "server room");
  EXPECT_FALSE(room_text("OMEN").kind == "men");
  EXPECT_FALSE(room_text("PUSH").kind);
}

TEST(RoomText, ReadersVote) {
  std::array const readings{Reading{"8-113", 0.9}, Reading{"B-113", 0.3}, Reading{"8-113", 0.7}, Reading{"", 0.0}};
  auto const vote = vote_on_number(readings);
  ASSERT_TRUE(vote);
  EXPECT_EQ(vote->number, "8-113");
  EXPECT_DOUBLE_EQ(vote->confidence, 1.6 / 4.0);
  EXPECT_FALSE(vote_on_number({}));
}

TEST(RoomText, ReadersAgreeOnALetterAndADigit) {
  std::array agree{Reading{"A1", 0.9}, Reading{"A1", 0.5}};
  auto const vote = vote_on_number(agree);
  ASSERT_TRUE(vote);
  EXPECT_EQ(vote->number, "A1");
  agree[1].text = "AT";
  EXPECT_FALSE(vote_on_number(agree));
}

}  // namespace
}  // namespace lapwing::vision
