#include "sim/building/plan/building_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace lapwing::sim::building {
namespace {

/// One room of 4 by 3 metres with a door in its southern wall.
std::string room(std::string const& more = {}) {
  return "wall_thickness_m = 0.1\n"
         "[[wall]]\nline = [[0, 0], [4, 0], [4, 3], [0, 3]]\nclosed = true\n"
         "[[door]]\nid = \"7\"\nhinge = [1, 0]\nlatch = [2, 0]\nsign = \"7\"\n" +
         more;
}

std::string complaint(std::string const& text) {
  auto const plan = building_of("b.toml", text);
  return plan ? "" : plan.error().message;
}

TEST(BuildingFile, ReadsEveryPart) {
  auto const plan =
      building_of("b.toml",
                  "name = \"Hut\"\nanchor = [41.5, -8.5, 90]\norigin = [10, 20]\nturned_deg = 90\nceiling_m = 3\n"
                  "door_colour = \"#ff8000\"\n" +
                      room("angle_deg = 45\nopens_to = \"right\"\nopen_s = 10\nclosed_s = 20\n"
                           "[[person]]\nat = [1, 1]\nway = [[1, 1], [3, 1]]\n"
                           "[[furniture]]\nat = [3, 2]\nsize = [1, 0.5, 0.8]\nmaterial = \"dark\"\n"
                           "[[room]]\nname = \"Hall\"\ncorners = [[0, 0], [4, 0], [4, 3]]\n"
                           "[[start]]\nat = [2, 1.5]\nfacing_deg = 180\n"));
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->name, "Hut");
  EXPECT_NEAR(plan->anchor->lat_deg(), 41.5, 1e-12);
  auto const corner = plan->site_from_floor * Place(1.0, 0.0);
  EXPECT_NEAR(corner.x(), 10.0, 1e-9);
  EXPECT_NEAR(corner.y(), 21.0, 1e-9);
  ASSERT_EQ(plan->walls.size(), 4U);
  EXPECT_EQ(plan->walls[3].to, Place(0.0, 0.0));
  EXPECT_EQ(plan->walls[0].thickness_m, 0.1);
  ASSERT_EQ(plan->doors.size(), 1U);
  EXPECT_NEAR(plan->doors[0].angle_rad, 0.785, 0.001);
  EXPECT_EQ(plan->doors[0].opens_to, Side::right);
  EXPECT_EQ(plan->doors[0].habit->closed_s, 20.0);
  EXPECT_NEAR(plan->door_colour.green, 128.0 / 255.0, 1e-12);
  ASSERT_EQ(plan->people.size(), 1U);
  EXPECT_TRUE(plan->people[0].walks);
  EXPECT_EQ(plan->furniture[0].material, Material::dark);
  EXPECT_EQ(plan->rooms[0].corners.size(), 3U);
  EXPECT_NEAR(plan->starts[0].yaw_rad, 3.1416, 0.001);
}

TEST(BuildingFile, OfTheExampleIsRead) {
  std::ifstream file(LAPWING_SOURCE_DIR "/examples/buildings/office.toml");
  std::string const text{std::istreambuf_iterator<char>(file), {}};
  auto const plan = building_of("office.toml", text);
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->doors.size(), 14U);
  EXPECT_EQ(plan->rooms.size(), 14U);
}

TEST(BuildingFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(complaint(room("opens_to = \"up\"\n")),
            "b.toml:10:12: error: opens_to cannot be up [invalid-value]\n"
            "   10 | opens_to = \"up\"\n"
            "      |            ^~~~ it can be left, right\n");
  EXPECT_EQ(complaint("[[wall]]\nline = [[0, 0], [4, 0]]\n[[door]]\nhinge = [1, 0.2]\nlatch = [2, 0.2]\n"),
            "b.toml:3:1: error: door 1 stands in no wall [misfit]\n"
            "    3 | [[door]]\n"
            "      | ^~~~~~~~ hinge and latch must both lie on one wall's line, to a centimetre\n");
}

TEST(BuildingFile, RefusesWhatDoesNotFit) {
  auto const refuses = [](std::string const& text, std::string_view why) {
    EXPECT_NE(complaint(text).find(why), std::string::npos) << complaint(text);
  };
  refuses("", "the building has no wall");
  refuses("[[wall]]\nline = [[0, 0]]\n", "two places at least");
  refuses("[[wall]]\nline = [[0, 0], [0, 0]]\n", "are one");
  refuses(room("[[door]]\nid = \"7\"\nhinge = [2.5, 0]\nlatch = [3.5, 0]\n"), "another door is called 7");
  refuses(room("[[door]]\nid = \"8\"\nhinge = [1.5, 0]\nlatch = [2.5, 0]\n"), "7 and 8 overlap");
  refuses(room("[[door]]\nhinge = [0.1, 0]\nlatch = [3.9, 0]\n"), "3.80 m wide");
  refuses(room("[[door]]\nhinge = [0.1, 3]\n"), "both jambs");
  refuses(room("open_s = 5\n"), "needs both open_s and closed_s");
  refuses(room("angle_deg = 200\n"), "angle_deg must be from 0 to 120");
  refuses(room("colour = \"brown\"\n"), "must be a colour");
  refuses(room("[[furniture]]\nat = [1, 1]\n"), "size = [length, width, height]");
  refuses(room("[[person]]\nwalks = true\n"), "a person needs a place");
  refuses(room("[[start]]\nat = [1e9, 0]\n"), "every number of at must be from -2000 to 2000");
  refuses("anchor = [95, 0, 0]\n" + room(), "no place on Earth");
  refuses("walls = 3\n" + room(), "there is no setting walls");
  refuses(room() + "x = ", "not-toml");
}

TEST(BuildingFile, RefusesSignsThatItCannotPaint) {
  auto const with_sign = [](std::string const& sign) {
    return complaint("[[wall]]\nline = [[0, 0], [4, 0]]\n[[door]]\nhinge = [1, 0]\nlatch = [2, 0]\nsign = \"" + sign +
                     "\"\n");
  };
  EXPECT_EQ(with_sign("Room 7\\nWC"), "");
  EXPECT_NE(with_sign("K\xc3\xbc"
                      "che")
                .find("letters that the building has not"),
            std::string::npos);
  EXPECT_NE(with_sign("12345678901234567").find("16 letters at most"), std::string::npos);
  EXPECT_NE(with_sign("1\\n2\\n3\\n4").find("3 lines at most"), std::string::npos);
}

TEST(BuildingFile, RefusesTooMuch) {
  EXPECT_NE(complaint(std::string(most_building_bytes + 1, '#')).find("more than 4 MiB"), std::string::npos);
  std::string people = room();
  for (std::size_t i = 0; i <= most_people; ++i) people += "[[person]]\nat = [1, 1]\n";
  EXPECT_NE(complaint(people).find("more than 200 [[person]]"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::sim::building
