#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "plan/files/plan_file.hpp"

namespace lapwing::plan {
namespace {

using mavlink::MavFrame;

std::string kml(std::string_view inside) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document>\n{}\n</Document></kml>",
      inside);
}
std::string placemark(std::string_view geometry, std::string_view more = "") {
  return fmt::format("<Placemark><name>here</name>{}{}</Placemark>", more, geometry);
}
constexpr auto path =
    "<LineString><altitudeMode>absolute</altitudeMode><coordinates>\n -8,41,120\n -8,41.1,130 "
    "</coordinates></LineString>";
constexpr auto field =
    "<Polygon><outerBoundaryIs><LinearRing><coordinates>-8,41 -7,41 -7,42 "
    "-8,41</coordinates></LinearRing></outerBoundaryIs>"
    "<innerBoundaryIs><LinearRing><coordinates>-7.5,41.1 -7.4,41.1 "
    "-7.4,41.2</coordinates></LinearRing></innerBoundaryIs>"
    "</Polygon>";
constexpr auto on_the_ground = "<Point><coordinates>-8,41</coordinates></Point>";

PlanFile read(std::string const& text, PlanReadOptions const& options = {}) {
  auto read = read_plan("a.kml", text, options);
  EXPECT_TRUE(read) << (read ? "" : read.error().message);
  return read ? *std::move(read) : PlanFile{.plan = {}};
}
std::string refusal(std::string const& text) {
  auto const read = read_plan("a.kml", text);
  return read ? "none" : read.error().message;
}

TEST(Kml, OfAPathIsAMission) {
  auto const plan = read(kml("<Folder><name>flight</name>" + placemark(path) + "</Folder>")).plan;
  ASSERT_EQ(plan.mission.items.size(), 2u);
  EXPECT_EQ(plan.mission.items[1].command, mavlink::MavCmd::nav_waypoint);
  EXPECT_EQ(plan.mission.items[1].frame, MavFrame::global);
  EXPECT_EQ(plan.mission.items[1].place.z_m, 130.0);
  EXPECT_NEAR(position_of(plan.mission.items[1]).lat_deg(), 41.1, 1e-12);
}

TEST(Kml, KeepsWhatHeightsCountFrom) {
  auto const plan = read(kml(placemark("<Point><altitudeMode>relativeToGround</altitudeMode>"
                                       "<coordinates>-8,41,35</coordinates></Point>")))
                        .plan;
  EXPECT_EQ(plan.mission.items.at(0).frame, MavFrame::global_terrain_alt);
}

TEST(Kml, OnTheGroundNeedsAHeight) {
  EXPECT_EQ(refusal(kml(placemark(on_the_ground))), "a.kml:3: this lies on the ground (altitudeMode clampToGround)");
  auto const plan = read(kml(placemark(on_the_ground)), {.altitude_m = 25.0}).plan;
  EXPECT_EQ(plan.mission.items.at(0).frame, MavFrame::global_relative_alt);
  EXPECT_EQ(plan.mission.items.at(0).place.z_m, 25.0);
}

TEST(Kml, OfAPolygonIsAFenceToStayIn) {
  auto const file = read(kml(placemark(field)));
  ASSERT_EQ(file.plan.fence.zones.size(), 1u);
  auto const& zone = file.plan.fence.zones[0];
  EXPECT_EQ(zone.name, "here");
  EXPECT_EQ(zone.kind, Zone::Kind::inclusion);
  auto const& rings = std::get<std::vector<GeoPolygon>>(zone.area).at(0).rings;
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_EQ(rings[0].size(), 3u);
  EXPECT_EQ(file.notes, std::vector<std::string>{"line 3: the area 'here' is taken as one to stay in"});
}

TEST(Kml, SaysWhichAreasToStayOutOf) {
  auto const data = "<ExtendedData><Data name=\"fence\"><value>exclusion</value></Data></ExtendedData>";
  auto const file = read(kml(placemark(fmt::format("<MultiGeometry>{}{}</MultiGeometry>", field, field), data)));
  ASSERT_EQ(file.plan.fence.zones.size(), 1u);
  EXPECT_EQ(file.plan.fence.zones[0].kind, Zone::Kind::exclusion);
  EXPECT_EQ(std::get<std::vector<GeoPolygon>>(file.plan.fence.zones[0].area).size(), 2u);
  EXPECT_TRUE(file.notes.empty());
}

TEST(Kml, TakesPointsInARallyFolderAsRallyPoints) {
  auto const plan =
      read(kml("<Folder><name>Rally points</name>" + placemark(on_the_ground) + "</Folder>"), {.altitude_m = 20.0})
          .plan;
  ASSERT_EQ(plan.rally.size(), 1u);
  EXPECT_EQ(plan.rally[0].place.alt_m, 20.0);
}

TEST(Kml, IsReadWithAnyPrefixAndWithoutEntities) {
  auto const text =
      "<!DOCTYPE kml [<!ENTITY a \"boom\"><!ENTITY b \"&a;&a;&a;&a;\">]>\n<k:kml "
      "xmlns:k=\"http://www.opengis.net/kml/2.2\">"
      "<k:Placemark><k:name>&b;</k:name><k:Polygon><k:outerBoundaryIs><k:LinearRing><k:coordinates>-8,41 -7,41 "
      "-7,42</k:coordinates></k:LinearRing></k:outerBoundaryIs></k:Polygon></k:Placemark></k:kml>";
  EXPECT_EQ(read(text).plan.fence.zones.at(0).name, "&b;");
}

TEST(Kml, NotesWhatItLeavesOut) {
  EXPECT_EQ(read(kml("<GroundOverlay/>\n<NetworkLink/>" + placemark(path))).notes,
            (std::vector<std::string>{"line 3: a GroundOverlay is not read", "line 4: a NetworkLink is not read"}));
}

TEST(Kml, ThatIsWrongNamesTheLine) {
  EXPECT_EQ(refusal("<kml>\n<Placemark></kml>"), "a.kml:2: this is no XML: Start-end tags mismatch");
  EXPECT_EQ(refusal("<gpx/>"), "a.kml:1: <gpx> is no KML");
  auto const line = [](std::string_view coordinates) {
    return refusal(kml(placemark(fmt::format(
        "<LineString><altitudeMode>absolute</altitudeMode><coordinates>{}</coordinates></LineString>", coordinates))));
  };
  EXPECT_EQ(line("-8,41,1 -8,x,1"), "a.kml:3: '-8,x,1' is no coordinate");
  EXPECT_EQ(line("-8,41,1,2"), "a.kml:3: '-8,41,1,2' is no coordinate");
  EXPECT_EQ(line("-8, 41"), "a.kml:3: '-8,' is no coordinate");
  EXPECT_EQ(line(""), "a.kml:3: there are no coordinates in it");
  EXPECT_EQ(line("-8,95,1"), "a.kml:3: latitude 95 is beyond 90 degrees");
  EXPECT_EQ(refusal(kml(placemark("<Polygon/>"))), "a.kml:3: a Polygon needs its outerBoundaryIs with a LinearRing");
  EXPECT_EQ(refusal(kml(placemark("<Polygon><outerBoundaryIs><LinearRing><coordinates>-8,41 -7,41</coordinates>"
                                  "</LinearRing></outerBoundaryIs></Polygon>"))),
            "a.kml:3: a ring needs at least three corners");
}

TEST(Kml, HasLimits) {
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "<Folder>";
  for (int i = 0; i < 100; ++i) deep += "</Folder>";
  EXPECT_EQ(refusal(kml(deep)), "a.kml:3: folders are nested deeper than 64");
  std::string many = "<LineString><altitudeMode>absolute</altitudeMode><coordinates>";
  for (std::size_t i = 0; i <= max_mission_items; ++i) many += "-8,41,1 ";
  EXPECT_EQ(refusal(kml(placemark(many + "</coordinates></LineString>"))),
            "a.kml:3: more coordinates than a mission can hold");
}

TEST(Kml, RefusesARallyPointWhoseHeightCountsFromNothing) {
  auto const rally = [](std::string_view frame) {
    return refusal(kml(placemark("<Point><coordinates>-8,41,30</coordinates></Point>",
                                 fmt::format("<ExtendedData><Data name=\"role\"><value>rally</value></Data>"
                                             "<Data name=\"frame\"><value>{}</value></Data></ExtendedData>",
                                             frame))));
  };
  EXPECT_EQ(rally("3"), "none");
  for (auto const* const frame : {"nan", "-1", "1", "1e99"})
    EXPECT_EQ(rally(frame), "a.kml:3: frame: heights count from the sea (0), home (3) or the terrain (10)") << frame;
}

TEST(Kml, IsReadInAMomentWhateverItLeavesOut) {
  std::string many;
  for (int i = 0; i < 200'000; ++i) many += "<NetworkLink/>\n";
  EXPECT_EQ(read(kml(many + placemark(path))).notes.size(), 100u);
  std::string rally_points = "<Folder><name>Rally</name>";
  for (std::size_t i = 0; i <= max_mission_items; ++i)
    rally_points +=
        "<Placemark><Point><altitudeMode>absolute</altitudeMode><coordinates>1,2,3</coordinates></Point></Placemark>";
  EXPECT_EQ(refusal(kml(rally_points + "</Folder>")), "a.kml:3: more rally points than a vehicle can hold");
}

TEST(Kmz, IsKmlInAnArchive) {
  auto const plan = read(kml(placemark(path) + placemark(field))).plan;
  auto const zipped = write_plan(plan, PlanFormat::kmz);
  ASSERT_TRUE(zipped) << zipped.error().message;
  EXPECT_TRUE(zipped->text.starts_with("PK"));
  auto const back = read_plan("a.kmz", zipped->text);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->plan.mission.items.size(), 2u);
  EXPECT_EQ(back->plan.fence.zones.size(), 1u);
}

TEST(Kmz, ThatIsWrongSaysSo) {
  EXPECT_EQ(read_plan("a.kmz", "PK\x03\x04 and nothing else").error().message, "a.kmz: this is no ZIP archive");
  auto const zipped = write_plan(read(kml(placemark(path))).plan, PlanFormat::kmz);
  auto damaged = zipped->text;
  damaged[60] = static_cast<char>(damaged[60] ^ 0x55);
  auto const read = read_plan("a.kmz", damaged);
  EXPECT_FALSE(read);
}

}  // namespace
}  // namespace lapwing::plan
