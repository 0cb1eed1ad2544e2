#include "base/text/json.hpp"

#include <bit>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lapwing::base {
namespace {

using Json = nlohmann::ordered_json;

TEST(PlainLine, KeepsTheOrderAndEscapesTexts) {
  Json const json{
      {"z", "he said \"no\\\"\n\x01"}, {"a", {1, true, nullptr}}, {"q\"", Json::object()}, {"e", Json::array()}};
  EXPECT_EQ(to_plain_line(json), R"({"z":"he said \"no\\\"\n\u0001","a":[1,true,null],"q\"":{},"e":[]})");
  EXPECT_EQ(to_plain_line(Json("a\xff z")), "\"a\uFFFD z\"");
}

TEST(PlainLine, SpellsNumbersAsShortAsCanBe) {
  Json const json{820.0, 0.1, 41.1049090735, -0.0, 1e-5, 2e15, 1e300, std::numeric_limits<double>::quiet_NaN(), 7};
  EXPECT_EQ(to_plain_line(json), "[820,0.1,41.1049090735,-0,1e-05,2000000000000000,1e+300,null,7]");
}

TEST(PlainLine, ReadsAsWhatWasWritten) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20'000; ++i) {
    auto const value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(Json::parse(to_plain_line(Json(value))).get<double>(), value);
  }
}

TEST(Shortest, IsSpelledAsTheFloat) {
  EXPECT_EQ(shortest(0.1F), 0.1);
  EXPECT_TRUE(std::isnan(shortest(std::numeric_limits<float>::quiet_NaN())));
  EXPECT_TRUE(std::isinf(shortest(std::numeric_limits<float>::infinity())));
  std::mt19937 random(4);
  for (int i = 0; i < 20'000; ++i) {
    auto const value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isnan(value)) continue;
    EXPECT_EQ(fmt::format("{}", shortest(value)), fmt::format("{}", value));
    EXPECT_EQ(static_cast<float>(shortest(value)), value);
  }
}

TEST(JsonNumber, IsAnIntegerWhereItIsOne) {
  EXPECT_EQ(json_number<Json>(820.0).dump(), "820");
  EXPECT_EQ(json_number<Json>(-0.5).dump(), "-0.5");
  EXPECT_EQ(json_number<Json>(1e300).dump(), "1e+300");
  EXPECT_EQ(json_number<Json>(std::numeric_limits<double>::infinity()).dump(), "null");
}

}  // namespace
}  // namespace lapwing::base
