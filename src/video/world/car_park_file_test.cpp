#include "video/world/car_park_file.hpp"

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::video {
namespace {

std::string const sound = R"(
name = "Yard"
anchor = [41.178, -8.598, 90]
seed = 7
[light]
sun_azimuth_deg = 180
sun_height_deg = 45
[ground]
wear = 0.2
[cars]
share = 0.25
stay_min = 20
[[area]]
ground = "asphalt"
kerb = true
corners = [[-20, -20], [20, -20], [20, 20], [-20, 20]]
[[row]]
name = "A"
at = [-10, 0]
count = 4
taken = [1]
free = [2]
left_out = [4]
paint = ["sides", "heads"]
[[slot]]
at = [10, 10]
heading_deg = 90
name = "disabled"
taken = false
[[car]]
at = [-3.75, 2.5]
heading_deg = 90
kind = "van"
colour = "#ff0000"
[[line]]
points = [[-10, -5], [10, -5]]
[[lane]]
points = [[-15, -8], [15, -8]]
[[tree]]
at = [15, 15]
[[building]]
corners = [[-18, 10], [-12, 10], [-12, 18], [-18, 18]]
)";

std::string message_of(std::string const& text) {
  auto const park = car_park_of("yard.toml", text);
  EXPECT_FALSE(park);
  return park ? std::string() : park.error().message;
}

std::string const head = "anchor = [41, -8, 90]\n";

TEST(CarParkFile, ReadsAllThatPeopleWrite) {
  auto const park = car_park_of("yard.toml", sound);
  ASSERT_TRUE(park) << park.error().message;
  EXPECT_EQ(park->name, "Yard");
  EXPECT_DOUBLE_EQ(park->anchor.alt_m, 90.0);
  EXPECT_EQ(park->seed, 7U);
  EXPECT_NEAR(park->light.sun_azimuth_rad, std::numbers::pi, 1e-12);
  EXPECT_DOUBLE_EQ(park->stay_s, 1200.0);
  ASSERT_EQ(park->slots.size(), 4U);
  EXPECT_EQ(park->slots[0].id, "A1");
  EXPECT_EQ(park->slots[0].habit, Slot::Habit::taken);
  EXPECT_EQ(park->slots[1].habit, Slot::Habit::free);
  EXPECT_EQ(park->slots[2].habit, Slot::Habit::left_to_listed);
  EXPECT_DOUBLE_EQ(park->slots[2].share, 0.25);
  EXPECT_EQ(park->slots[3].id, "disabled");
  EXPECT_EQ(park->slots[3].habit, Slot::Habit::free);
  ASSERT_EQ(park->cars.size(), 1U);
  EXPECT_EQ(park->cars[0].slot, 2U);
  EXPECT_EQ(park->cars[0].look.kind->name, "van");
  EXPECT_EQ(park->cars[0].look.paint, (Colour{1.0, 0.0, 0.0}));
  EXPECT_EQ(park->lanes.size(), 1U);
  EXPECT_EQ(park->trees.size(), 1U);
  EXPECT_EQ(park->blocks.size(), 1U);
}

TEST(CarParkFile, MistakesAreToldWithTheirPlaceAllAtOnce) {
  auto const message =
      message_of(head + "sead = 3\n[[row]]\nat = [0, 0]\nwidth_m = 200\n[[area]]\ncorners = [[0, 0], [1, 1]]\n");
  EXPECT_NE(message.find("yard.toml:2:1"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean seed"), std::string::npos) << message;
  EXPECT_NE(message.find("width_m"), std::string::npos) << message;
  EXPECT_NE(message.find("count = 12"), std::string::npos) << message;
  EXPECT_NE(message.find("3 places at least"), std::string::npos) << message;
}

TEST(CarParkFile, ACarParkNeedsAPlaceOnEarth) {
  EXPECT_NE(message_of("name = \"x\"\n").find("anchor = [latitude"), std::string::npos);
  EXPECT_NE(message_of("anchor = [100, 0, 0]\n").find("no place on Earth"), std::string::npos);
}

TEST(CarParkFile, SlotsOfOneNameAreRefused) {
  EXPECT_NE(message_of(head +
                       "[[row]]\nname = \"A\"\nat = [0, 0]\ncount = 2\n[[row]]\nname = \"A\"\nat = [9, 9]\ncount = 1\n")
                .find("two slots are called A1"),
            std::string::npos);
}

TEST(CarParkFile, MoreThanCanBeDrawnIsRefused) {
  std::string rows = head;
  for (int i = 0; i < 3; ++i) rows += "[[row]]\nat = [0, 0]\ncount = 2000\n";
  EXPECT_NE(message_of(rows).find("more than 5000 slots"), std::string::npos);
  std::string trees = head;
  for (std::size_t i = 0; i <= most_parts; ++i) trees += "[[tree]]\nat = [0, 0]\n";
  EXPECT_NE(message_of(trees).find("more than 2000 [[tree]]"), std::string::npos);
  EXPECT_NE(message_of(std::string(most_world_bytes + 1, '\n')).find("at most are read"), std::string::npos);
}

TEST(CarParkFile, AreasThatCrossThemselvesAreRefused) {
  EXPECT_NE(message_of(head + "[[building]]\ncorners = [[0, 0], [9, 9], [9, 0], [0, 9]]\n").find("no area"),
            std::string::npos);
}

TEST(CarParkFile, WordsThatNothingHasAreToldWithThoseThatCanBe) {
  EXPECT_NE(
      message_of(head + "[[area]]\nground = \"lava\"\ncorners = [[0, 0], [1, 0], [1, 1]]\n").find("asphalt, concrete"),
      std::string::npos);
  EXPECT_NE(message_of(head + "[[car]]\nat = [0, 0]\nkind = \"tank\"\n").find("saloon, hatchback"), std::string::npos);
  EXPECT_NE(message_of(head + "[[row]]\nat = [0, 0]\ncount = 1\npaint = [\"feet\"]\n").find("sides, heads, mouths"),
            std::string::npos);
  EXPECT_NE(message_of(head + "[[line]]\npoints = [[0, 0], [1, 0]]\ncolour = \"red\"\n").find("#e6e6e0"),
            std::string::npos);
}

TEST(CarParkFile, APictureOfTheGroundNeedsItsBox) {
  EXPECT_NE(message_of(head + "[ground]\npicture = \"a.png\"\n").find("picture_box"), std::string::npos);
}

TEST(CarParkFile, TheDemosCarParkIsSound) {
  auto const park = load_car_park(std::filesystem::path(LAPWING_SOURCE_DIR) / "examples/car-park/world.toml");
  ASSERT_TRUE(park) << park.error().message;
  EXPECT_EQ(park->slots.size(), 432U);
  EXPECT_NEAR(park->anchor.lat_deg(), 41.178, 1e-9);
}

TEST(CarParkFile, ThePictureOfTheGroundIsFoundBesideIt) {
  base::testing::TemporaryFolder const folder;
  auto const file = folder.write("yard.toml", head + "[ground]\npicture = \"a.png\"\npicture_box = [0, 0, 9, 9]\n");
  auto const park = load_car_park(file);
  ASSERT_TRUE(park) << park.error().message;
  EXPECT_EQ(park->picture->file, folder.path() / "a.png");
}

TEST(CarParkFile, AFolderOrAFileThatIsNotThereIsNamed) {
  EXPECT_EQ(load_car_park("/").error().kind, base::ErrorKind::not_found);
  auto const park = load_car_park("/nowhere/world.toml");
  ASSERT_FALSE(park);
  EXPECT_EQ(park.error().kind, base::ErrorKind::not_found);
  EXPECT_NE(park.error().message.find("/nowhere/world.toml"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::video
