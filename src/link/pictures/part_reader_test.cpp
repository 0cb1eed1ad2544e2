#include "link/pictures/part_reader.hpp"

#include <gtest/gtest.h>

namespace lapwing::link::pictures {
namespace {

std::string const head = "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=p\r\n\r\n--p\r\n";

std::string part(std::string const& picture, std::string const& time = "1700000000.250000") {
  return "content-length: " + std::to_string(picture.size()) + "\r\nX-Timestamp: " + time + "\r\n\r\n" + picture +
         "\r\n--p\r\n";
}

TEST(PartReader, ReadsPicturesHoweverTheyAreCut) {
  auto const stream = head + part("first") + part("second");
  PartReader reader;
  std::vector<std::string> read;
  for (char const byte : stream) {
    auto const picture = reader.take({&byte, 1});
    ASSERT_TRUE(picture);
    if (!*picture) continue;
    read.push_back(*(*picture)->jpeg);
    EXPECT_EQ((*picture)->taken, base::UtcTime(std::chrono::milliseconds(1'700'000'000'250)));
  }
  EXPECT_EQ(read, (std::vector<std::string>{"first", "second"}));
}

TEST(PartReader, KeepsTheNewestOfSeveral) {
  PartReader reader;
  auto const picture = reader.take(head + part("first") + part("second"));
  ASSERT_TRUE(picture && *picture);
  EXPECT_EQ(*(*picture)->jpeg, "second");
}

TEST(PartReader, SaysWhatAnotherServerAnswers) {
  PartReader reader;
  auto const refused = reader.take("HTTP/1.1 404 Not Found\r\n\r\nnothing");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("404 Not Found"), std::string::npos);
  EXPECT_EQ(reader.take(head + part("late")).value(), std::nullopt) << "it reads nothing more";
}

TEST(PartReader, TakesNoPictureWithoutLimits) {
  for (auto const& bad :
       {std::string("Content-Length: 99999999999\r\nX-Timestamp: 1\r\n\r\n"),
        std::string("Content-Length: 5\r\n\r\n12345"), std::string("Content-Length: -5\r\nX-Timestamp: 1\r\n\r\n"),
        std::string("Content-Length: 5\r\nX-Timestamp: nan\r\n\r\n12345"), std::string(5000, 'x')}) {
    PartReader reader;
    EXPECT_FALSE(reader.take(head + bad)) << bad.substr(0, 40);
  }
}

}  // namespace
}  // namespace lapwing::link::pictures
