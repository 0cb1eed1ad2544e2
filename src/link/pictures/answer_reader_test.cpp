#include "link/pictures/answer_reader.hpp"

#include <gtest/gtest.h>

namespace lapwing::link::pictures {
namespace {

std::string const whole =
    "HTTP/1.1 201 Created\r\ncontent-type: application/sdp\r\nLocation: /api/v1/whep/sessions/1\r\n"
    "Content-Length: 5\r\n\r\nv=0\r\n";

TEST(AnswerReader, ReadsAnAnswerHoweverItIsCut) {
  AnswerReader reader;
  for (std::size_t i = 0; i + 1 < whole.size(); ++i) {
    auto const part = reader.take(whole.substr(i, 1));
    ASSERT_TRUE(part) << part.error().message;
    EXPECT_FALSE(*part) << i;
  }
  auto const answer = reader.take(whole.substr(whole.size() - 1));
  ASSERT_TRUE(answer && *answer);
  EXPECT_EQ((*answer)->status, 201);
  EXPECT_EQ((*answer)->content_type, "application/sdp");
  EXPECT_EQ((*answer)->location, "/api/v1/whep/sessions/1");
  EXPECT_EQ((*answer)->body, "v=0\r\n");
}

TEST(AnswerReader, LeavesOutWhatComesAfterTheBody) {
  AnswerReader reader;
  auto const answer = reader.take(whole + "more");
  ASSERT_TRUE(answer && *answer);
  EXPECT_EQ((*answer)->body, "v=0\r\n");
}

TEST(AnswerReader, TakesNoAnswerWithoutLimits) {
  for (auto const& bad :
       {std::string("RTSP/1.0 200 OK\r\n\r\n"), std::string("HTTP/1.1 999 Odd\r\nContent-Length: 0\r\n\r\n"),
        std::string("HTTP/1.1 xyz\r\nContent-Length: 0\r\n\r\n"), std::string("HTTP/1.1 200 OK\r\n\r\n"),
        std::string("HTTP/1.1 200 OK\r\nContent-Length: -1\r\n\r\n"),
        std::string("HTTP/1.1 200 OK\r\nContent-Length: 99999999\r\n\r\n"), std::string(10'000, 'x')}) {
    AnswerReader reader;
    EXPECT_FALSE(reader.take(bad)) << bad.substr(0, 60);
  }
}

}  // namespace
}  // namespace lapwing::link::pictures
