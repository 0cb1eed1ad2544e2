#include "link/operator_link/wire/json_objects.hpp"

#include <gtest/gtest.h>

#include "link/operator_link/testing/samples.hpp"

namespace lapwing::link::operator_link {
namespace {

using testing::bytes;

/// Each item as text, faults with an exclamation mark before.
std::vector<std::string> items(JsonObjects& reader) {
  std::vector<std::string> found;
  while (auto item = reader.next()) found.push_back(*item ? **item : "!" + item->error());
  return found;
}

std::vector<std::string> read(std::string_view text) {
  JsonObjects reader(100);
  reader.feed(bytes(text));
  return items(reader);
}

using Items = std::vector<std::string>;

TEST(JsonObjects, ComeSplitAndJoined) {
  std::string const stream =
      "{\"Type\":\"Arm\"}{\"Type\":\"Autonomous Move\",\"X\":1,\"Y\":[2,{\"a\":{}}]}\n  {\"}\":\"{\\\"\\\\\"}\r\n{}";
  Items const expected{"{\"Type\":\"Arm\"}", "{\"Type\":\"Autonomous Move\",\"X\":1,\"Y\":[2,{\"a\":{}}]}",
                       "{\"}\":\"{\\\"\\\\\"}", "{}"};
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    JsonObjects reader;
    reader.feed(bytes(stream.substr(0, cut)));
    auto found = items(reader);
    reader.feed(bytes(stream.substr(cut)));
    for (auto& item : items(reader)) found.push_back(std::move(item));
    ASSERT_EQ(found, expected) << "cut at " << cut;
  }
  JsonObjects byte_by_byte;
  for (auto const byte : bytes(stream)) byte_by_byte.feed({&byte, 1});
  EXPECT_EQ(items(byte_by_byte), expected);
}

TEST(JsonObjects, MayHaveLineEndsWithin) {
  EXPECT_EQ(read("{\n \"a\": [\n 1 ]\n}\n"), Items{"{\n \"a\": [\n 1 ]\n}"});
}

TEST(JsonObjects, TellsGarbageBetweenThemOnce) {
  EXPECT_EQ(read("hello\n{\"a\":1}"), (Items{"!'h' where an object must begin", "{\"a\":1}"}));
  EXPECT_EQ(read("x\ny\n{}"), (Items{"!'x' where an object must begin", "!'y' where an object must begin", "{}"}));
  EXPECT_EQ(read("{},{}"), (Items{"{}", "!',' where an object must begin", "{}"}));
}

TEST(JsonObjects, GoesOnAfterOneThatWasCutOff) {
  std::string const cut_off = "!an object begins where none can stand, so the one before was cut off: ";
  EXPECT_EQ(read("{\"a\":1\n{\"b\":2}"), (Items{cut_off + "{\"a\":1?", "{\"b\":2}"}));
  EXPECT_EQ(read("{\"a\":1,\n{\"b\":2}"), (Items{cut_off + "{\"a\":1,?", "{\"b\":2}"}));
  EXPECT_EQ(read("{\"a\":[1{\"b\":2}"), (Items{cut_off + "{\"a\":[1", "{\"b\":2}"}));
  EXPECT_EQ(read("{\"a\":\"te\n{\"b\":2}"), (Items{"!a line ends within a text: {\"a\":\"te", "{\"b\":2}"}));
  EXPECT_EQ(read("{\"a\":[}{\"b\":2}"), (Items{"!a bracket does not match: {\"a\":[}", "{\"b\":2}"}));
  EXPECT_EQ(read("{\"a\":[}]}\nx"), (Items{"!a bracket does not match: {\"a\":[}", "!'x' where an object must begin"}));
}

TEST(JsonObjects, TellsOneThatIsTooLongAndLeavesItOut) {
  auto const found = read("{\"a\":\"" + std::string(200, 'x') + "\"}{\"b\":2}");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].substr(0, 34), "!an object of more than 100 bytes,");
  EXPECT_EQ(found[1], "{\"b\":2}");
  EXPECT_EQ(read("{" + std::string(98, ' ') + "}").front().size(), 100u) << "so long it may be";
}

TEST(JsonObjects, RefusesBracketsWithoutEnd) {
  auto const found = read("{\"a\":" + std::string(70, '['));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].substr(0, 31), "!more than 64 brackets are open");
}

}  // namespace
}  // namespace lapwing::link::operator_link
