#include "autonomy/operator/map_request.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "autonomy/operator/command_text.hpp"

namespace lapwing::autonomy {
namespace {

TEST(MapRequest, IsReadAsItIsWritten) {
  for (auto const request : {MapRequest::as_changes, MapRequest::in_heartbeats}) {
    auto const read = parse_map_request(map_request_text(request));
    ASSERT_TRUE(read && *read);
    EXPECT_EQ(**read, request);
  }
}

TEST(MapRequest, IsNothingOfAnotherType) {
  std::vector<std::string> texts{"", "7", "[]", R"({"Type":"Arm"})", R"({"Type":7})"};
  texts.push_back(R"({"Type":"Map"})" + std::string(longest_command, ' '));
  for (auto const& text : texts) EXPECT_FALSE(parse_map_request(text)) << text.substr(0, 40);
}

TEST(MapRequest, SaysWhatMayBeAskedFor) {
  for (auto const* const text : {R"({"Type":"Map"})", R"({"Type":"Map","Send":7})", R"({"Type":"Map","Send":"All"})"}) {
    auto const read = parse_map_request(text);
    ASSERT_TRUE(read) << text;
    ASSERT_FALSE(*read) << text;
    EXPECT_TRUE(read->error().message.contains("Changes or as Heartbeat"));
  }
}

}  // namespace
}  // namespace lapwing::autonomy
