#include "autonomy/operator/command_text.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace lapwing::autonomy {
namespace {

template <class T>
T read(std::string_view text) {
  auto const command = parse_command(text);
  EXPECT_TRUE(command) << (command ? "" : command.error().message);
  if (!command || !std::holds_alternative<T>(*command)) {
    ADD_FAILURE() << text;
    return T{};
  }
  return std::get<T>(*command);
}

std::string why_not(std::string_view text) {
  auto const command = parse_command(text);
  return command ? "" : command.error().message;
}

TEST(CommandText, NamesGoWithAndWithoutTheBlank) {
  for (auto const& [text, index] : std::initializer_list<std::pair<std::string_view, std::size_t>>{
           {R"({"Type":"Kill"})", 0},
           {R"({"Type":"Arm"})", 2},
           {R"({"Type":"Disarm"})", 3},
           {R"({"Type":"Takeoff"})", 4},
           {R"({"Type":"Land"})", 5},
           {R"({"Type":"Autonomous Explore"})", 6},
           {R"({"Type":"AutonomousExplore"})", 6},
           {R"({"Type":"AutonomousMove","X":1,"Y":2})", 7},
           {R"({"Type":"Autonomous Move","X":1,"Y":2})", 7},
           {R"({"Type":"CompulsiveMove","X":1,"Y":2})", 8},
           {R"({"Type":"Compulsive Move","X":1,"Y":2})", 8}}) {
    auto const command = parse_command(text);
    ASSERT_TRUE(command) << text;
    EXPECT_EQ(command->index(), index) << text;
  }
}

TEST(CommandText, HeightsGoByEitherSpelling) {
  HoverHeights const heights{7, 10.5, 20};
  EXPECT_EQ(read<command::Configure>(R"({"Type":"Configure","Min":7,"Des":10.5,"Max":20})").heights, heights);
  EXPECT_EQ(read<command::Configure>(
                R"({"Type":"Configure","MinHoverHeight":7.0,"DesiredHoverHeight":10.5,"MaxHoverHeight":2e1})")
                .heights,
            heights);
  EXPECT_EQ(read<command::Configure>(R"({"Type":"Configure","Min":7,"MinHoverHeight":7,"Des":10.5,"Max":20})").heights,
            heights);
  EXPECT_EQ(why_not(R"({"Type":"Configure","Min":7,"MinHoverHeight":8,"Des":10.5,"Max":20})"),
            "Configure has Min and MinHoverHeight, which differ");
  EXPECT_EQ(why_not(R"({"Type":"Configure","Min":7,"Max":20})"), "Configure has neither Des nor DesiredHoverHeight");
}

TEST(CommandText, PlacesAreInTheLocalFrameOrOnTheGlobe) {
  auto const move = read<command::AutonomousMove>(R"({"Type":"Autonomous Move","X":-3.5,"Y":4})");
  EXPECT_EQ(move.place, geo::Point<ArmingFrame>(-3.5, 4));
  EXPECT_EQ(move.yaw_rad, std::nullopt);
  auto const local = read<command::CompulsiveMove>(R"({"Type":"Compulsive Move","X":5,"Y":6})");
  EXPECT_EQ(std::get<geo::Point<ArmingFrame>>(local.place), geo::Point<ArmingFrame>(5, 6));
  auto const global = read<command::CompulsiveMove>(R"({"Type":"Compulsive Move","Lat":43.25,"Long":-79.92,"w":0})");
  EXPECT_EQ(std::get<geo::Wgs84>(global.place), geo::Wgs84::from_degrees(43.25, -79.92));
  EXPECT_NEAR(*global.yaw_rad, std::numbers::pi, 1e-12);
}

TEST(CommandText, TheOriginalsOrientationBecomesAYaw) {
  auto const ahead = read<command::AutonomousMove>(R"({"Type":"Autonomous Move","X":1,"Y":2,"w":1})");
  EXPECT_NEAR(*ahead.yaw_rad, 0.0, 1e-12);
  auto const left = read<command::AutonomousMove>(R"({"Type":"Autonomous Move","X":1,"Y":2,"w":0.7071067811865476})");
  EXPECT_NEAR(*left.yaw_rad, std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(why_not(R"({"Type":"Autonomous Move","X":1,"Y":2,"w":1.1})"),
            "Autonomous Move: w is 1.1, and not from -1 to 1");
}

TEST(CommandText, PassesOverKeysThatNobodyKnows) {
  EXPECT_EQ(parse_command(R"( {"Type":"Arm","Time":[1,{"a":null}]} )")->index(), 2u);
}

TEST(CommandText, SaysWhatIsWrong) {
  for (auto const& [text, why] : std::initializer_list<std::pair<std::string_view, std::string_view>>{
           {"", "a command is no JSON"},
           {"Arm", "a command is no JSON"},
           {R"({"Type":"Arm")", "a command is no JSON"},
           {R"({"Type":"Arm"}{"Type":"Arm"})", "a command is no JSON"},
           {R"({"Type":"Autonomous Move","X":NaN,"Y":1})", "a command is no JSON"},
           {R"({"Type":"Autonomous Move","X":1e999,"Y":1})", "a command is no JSON"},
           {"\"\xFF\"", "a command is no JSON"},
           {R"(["Arm"])", "a command is no JSON object"},
           {"null", "a command is no JSON object"},
           {"{}", "a command has no Type that is a text"},
           {R"({"type":"Arm"})", "a command has no Type that is a text"},
           {R"({"Type":7})", "a command has no Type that is a text"},
           {R"({"Type":"arm!"})", "there is no command 'arm!'"},
           {R"({"Type":"Land\u0007"})", "there is no command 'Land?'"},
           {R"({"Type":"Autonomous Move","Y":1})", "Autonomous Move has no X"},
           {R"({"Type":"AutonomousMove","X":"1","Y":1})", "Autonomous Move: X is no number"},
           {R"({"Type":"Autonomous Move","X":null,"Y":1})", "Autonomous Move: X is no number"},
           {R"({"Type":"Autonomous Move","X":2000000,"Y":1})",
            "Autonomous Move: X is 2000000, and not from -1000000 to 1000000"},
           {R"({"Type":"Compulsive Move","Lat":91,"Long":0})", "Compulsive Move: Lat is 91, and not from -90 to 90"},
           {R"({"Type":"Compulsive Move","Lat":9})", "Compulsive Move has no Long"},
           {R"({"Type":"Compulsive Move","Lat":9,"Long":1,"X":1})", "Compulsive Move has X, Y and Lat, Long"},
           {R"({"Type":"Compulsive Move"})", "Compulsive Move has no X"},
           {R"({"Type":"Configure","Min":true,"Des":8,"Max":9})", "Configure: Min is no number"}})
    EXPECT_EQ(why_not(text), why) << text;
}

TEST(CommandText, HelpsWithNamesThatComeNear) {
  auto const command = parse_command(R"({"Type":"Autonomus Move"})");
  ASSERT_FALSE(command);
  EXPECT_EQ(command.error().hint, "did you mean Autonomous Move?");
}

TEST(CommandText, HasALimit) {
  std::string const padding(longest_command, ' ');
  EXPECT_EQ(why_not(padding + R"({"Type":"Arm"})"), "a command has at most 4096 bytes, and this one 4110");
  EXPECT_EQ(why_not(std::string(4000, '[')), "a command is no JSON");
}

}  // namespace
}  // namespace lapwing::autonomy
