#include "host/files/plans.hpp"

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::host {
namespace {

constexpr auto way_points = "QGC WPL 110\n0 1 0 16 0 0 0 0 41 -8 90 1\n1 0 3 16 0 0 0 0 41.1 -8 30 1\n";

using base::testing::TemporaryFolder;

struct Plans : ::testing::Test {
  void write(std::string const& name, std::string_view text) const { (void)folder.write(name, text); }
  [[nodiscard]] base::Result<LoadedPlans> load() const { return load_plans(folder.path().string()); }

  TemporaryFolder folder;
};

TEST_F(Plans, AreTheFilesThatEndSo) {
  write("north.waypoints", way_points);
  write("notes.txt", "not read");
  auto const plans = load();
  ASSERT_TRUE(plans) << plans.error().message;
  EXPECT_EQ(missions::names_of(plans->library), std::vector<std::string>{"north"});
  EXPECT_TRUE(plans->mistakes.empty());
}

TEST_F(Plans, ThatAreWrongAreKeptAsTheirErrors) {
  write("bad.plan", "{");
  auto const plans = load();
  ASSERT_TRUE(plans);
  ASSERT_EQ(plans->mistakes.size(), 1u);
  EXPECT_NE(plans->mistakes[0].message.find("bad.plan:1:2: this is no JSON"), std::string::npos);
  EXPECT_FALSE(missions::find_plan(plans->library, "bad"));
}

TEST_F(Plans, NoteWhatIsNotFlown) {
  write("a.plan", R"({"fileType": "Plan", "mission": {"items": [{"type": "SimpleItem", "command": 16, "frame": 3,
    "params": [0, 0, 0, 0, 41, -8, 30]}]}, "geoFence": {"circles": [{"circle": {"center": [41, -8], "radius": 9}}]},
    "rallyPoints": {"points": [[1, 2, 3]]}})");
  auto const plans = load();
  ASSERT_TRUE(plans);
  ASSERT_EQ(plans->notes.size(), 2u);
  EXPECT_TRUE(plans->notes[0].ends_with("a.plan: its geofence (1 polygons and circles) is not uploaded"));
  EXPECT_TRUE(plans->notes[1].ends_with("a.plan: its 1 rally points are not uploaded"));
}

TEST_F(Plans, OfOneNameAreRefused) {
  write("north.waypoints", way_points);
  write("north.plan", "{}");
  auto const plans = load();
  ASSERT_FALSE(plans);
  EXPECT_NE(plans.error().message.find("another plan is called 'north' too"), std::string::npos);
}

TEST_F(Plans, WithoutADirectoryAreNone) {
  EXPECT_TRUE(load_plans("")->library.empty());
  EXPECT_EQ(load_plans((folder.path() / "nowhere").string()).error().kind, base::ErrorKind::not_found);
}

}  // namespace
}  // namespace lapwing::host
