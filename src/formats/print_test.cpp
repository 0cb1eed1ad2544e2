// Prints have their true size on paper, and every layer on them.
#include "formats/print.hpp"
#include "base/testing/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>

namespace lapwing::formats {
namespace {

namespace files = std::filesystem;

struct PrintTest : ::testing::Test {
  base::testing::TemporaryFolder temporary;
  files::path folder = temporary.path();
  MapContents contents;

  void SetUp() override {
    contents.sites.emplace("office", geo::Site::make("office", geo::Wgs84::from_degrees(41.0, -8.0),
                                                     {{.id = "0"}, {.id = "1", .up_m = 3.0}})
                                         .value());
    put(map::Wall{.line = {{map::SitePoint(0, 0), map::SitePoint(20, 0), map::SitePoint(20, 10)}}, .thickness_m = 0.2});
    put(map::PointOfInterest{.position = map::SitePoint(5, 0), .kind = "door", .name = "221"});
  }

  void put(map::Content content, std::string floor = "1") {
    contents.features.push_back({.id = std::to_string(contents.features.size()),
                                 .site = "office",
                                 .floor = std::move(floor),
                                 .content = std::move(content)});
  }
  static std::string text_of(files::path const& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(PrintTest, ACentimetreIsAMetre) {
  auto const path = folder / "floor.svg";
  auto const written = write_print(contents, {.site = "office", .floor = "1"}, path);
  ASSERT_TRUE(written) << written.error().message;
  auto const svg = text_of(path);
  std::smatch size;
  ASSERT_TRUE(std::regex_search(svg, size, std::regex("width=\"([0-9.]+)pt\" height=\"([0-9.]+)pt\"")));
  constexpr double points_a_cm = 72.0 / 2.54;
  EXPECT_NEAR(std::stod(size[1]) / points_a_cm, 20.0 + 2.4, 0.01) << "20 m, and the margins";
  EXPECT_NEAR(std::stod(size[2]) / points_a_cm, 10.0 + 2.4, 0.01);
}

TEST_F(PrintTest, WritesPdf) {
  auto const path = folder / "floor.pdf";
  ASSERT_TRUE(write_print(contents, {.site = "office", .floor = "1"}, path));
  EXPECT_TRUE(text_of(path).starts_with("%PDF-"));
}

TEST_F(PrintTest, ShowsEveryLayer) {
  auto const blank = [&] {
    auto const path = folder / "layers.svg";
    EXPECT_TRUE(write_print(contents, {.site = "office", .floor = "1"}, path));
    return text_of(path).size();
  };
  map::SitePolygon const square{
      {{map::SitePoint(1, 1), map::SitePoint(3, 1), map::SitePoint(3, 3), map::SitePoint(1, 3)}}};
  auto before = blank();
  for (map::Content const& content : std::initializer_list<map::Content>{
           map::Slot{.outline = square, .state = map::SlotState::taken, .name = "7"}, map::Area{.outline = square},
           map::Picture{.position = map::SitePoint(2, 2), .footprint = square.rings[0]},
           map::Track{.samples = {{.position = map::SitePoint(1, 1)}, {.position = map::SitePoint(4, 4)}}}}) {
    put(content);
    auto const after = blank();
    EXPECT_GT(after, before) << content.index();
    before = after;
  }
  map::OccupancyGrid grid(0.1);
  grid.set({5, 5}, map::Evidence::of_probability(0.9));
  contents.grids.emplace(map::GridKey{"office", "1", "floor"}, grid);
  EXPECT_GT(blank(), before);
}

TEST_F(PrintTest, OtherFloorsStayOff) {
  put(map::Wall{.line = {{map::SitePoint(0, 0), map::SitePoint(400, 0)}}}, "0");
  EXPECT_TRUE(write_print(contents, {.site = "office", .floor = "1"}, folder / "one.svg"));
  auto const large = write_print(contents, {.site = "office", .floor = "0", .scale = 50.0}, folder / "zero.svg");
  ASSERT_FALSE(large) << "8 m of paper";
  EXPECT_NE(large.error().hint.find("--scale"), std::string::npos);
}

TEST_F(PrintTest, MistakesAreTold) {
  EXPECT_EQ(write_print(contents, {.site = "moon"}, folder / "x.svg").error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(write_print(contents, {.site = "office", .floor = "9"}, folder / "x.svg").error().kind,
            base::ErrorKind::not_found);
  EXPECT_FALSE(write_print(contents, {.site = "office", .floor = "0"}, folder / "x.svg")) << "nothing there";
  EXPECT_FALSE(write_print(contents, {.site = "office", .floor = "1", .scale = 0.0}, folder / "x.svg"));
  EXPECT_EQ(write_print(contents, {.site = "office", .floor = "1"}, "/no/such/folder/x.pdf").error().kind,
            base::ErrorKind::io);
}

}  // namespace
}  // namespace lapwing::formats
