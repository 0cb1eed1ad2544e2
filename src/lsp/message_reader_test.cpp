#include "lsp/message_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lapwing::lsp {
namespace {

/// What a reader makes of a stream that arrives `step` bytes at a time; mistakes in square brackets.
std::vector<std::string> read(std::string const& stream, std::size_t step, std::size_t max_size = max_message_size) {
  MessageReader reader(max_size);
  std::vector<std::string> out;
  for (std::size_t at = 0; at < stream.size(); at += step) {
    reader.feed(std::string_view(stream).substr(at, step));
    while (auto const message = reader.next()) {
      out.push_back(message->mistake.empty() ? message->body : "[" + message->mistake + "]");
    }
  }
  return out;
}

using Messages = std::vector<std::string>;

TEST(MessageReader, CutsTheStreamWhateverThePiecesThatArrive) {
  auto const stream =
      with_header("{}") + with_header("{\"a\":\"ä\"}") + "content-LENGTH:  3\r\nContent-Type: x\r\n\r\nabc";
  for (std::size_t const step : {1u, 2u, 7u, 1000u}) {
    EXPECT_EQ(read(stream, step), (Messages{"{}", "{\"a\":\"ä\"}", "abc"})) << step;
  }
}

TEST(MessageReader, TakesEmptyMessagesAndBareLineFeeds) {
  EXPECT_EQ(read("Content-Length: 0\n\nContent-Length: 1\n\nx", 5), (Messages{"", "x"}));
}

TEST(MessageReader, FindsTheNextMessageBehindBadHeaders) {
  auto const good = with_header("{}");
  EXPECT_EQ(read("\r\n" + good, 100), (Messages{"[a message without Content-Length]", "{}"}));
  EXPECT_EQ(read("nonsense\r\n\r\n" + good, 100), (Messages{"[a header line without a colon]", "{}"}));
  EXPECT_EQ(read("Content-Length: -1\r\n\r\n{\"id\":1}" + good, 100),
            (Messages{"[a Content-Length that is no number]", "{}"}));
  EXPECT_EQ(read("Content-Length: 99999999999999999999999\r\n\r\n" + good, 100),
            (Messages{"[a Content-Length that is no number]", "{}"}));
  EXPECT_EQ(read(std::string(5000, 'x') + good, 3), (Messages{"{}"}));
}

TEST(MessageReader, ReadsOverMessagesThatAreTooLong) {
  auto const stream = with_header(std::string(100, 'x')) + with_header("{}");
  for (std::size_t const step : {1u, 10u, 1000u}) {
    EXPECT_EQ(read(stream, step, 99), (Messages{"[a message of 100 bytes; at most 99 are read]", "{}"})) << step;
  }
}

TEST(MessageReader, WaitsForTheWholeMessage) {
  MessageReader reader;
  reader.feed("Content-Length: 10\r\n\r\n12345");
  EXPECT_FALSE(reader.next());
  reader.feed("67890");
  EXPECT_EQ(reader.next()->body, "1234567890");
  EXPECT_FALSE(reader.next());
}

}  // namespace
}  // namespace lapwing::lsp
