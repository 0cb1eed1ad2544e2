// The table of formats, and that the page about them is what it says.
#include "formats/format.hpp"
#include "base/testing/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace lapwing::formats {
namespace {

namespace files = std::filesystem;

std::string row_of(Format const& format) {
  auto const mark = [](bool holds) { return holds ? "yes " : ""; };
  return fmt::format("| `{}` | {} | {}| {}| {}| {}| {} |", format.name,
                     format.extension.empty() ? "folder" : fmt::format("`{}`", format.extension),
                     mark(format.holds_features), mark(format.holds_grids), mark(format.holds_pictures),
                     mark(format.is_read), format.note);
}

TEST(Formats, ThePageAboutThemHasEachWithWhatItHolds) {
  std::ifstream in(LAPWING_SOURCE_DIR "/docs/reference/formats.md");
  std::string const page{std::istreambuf_iterator<char>(in), {}};
  for (auto const& format : formats()) EXPECT_NE(page.find(row_of(format)), std::string::npos) << row_of(format);
}

TEST(Formats, AreKnownByNameAndByFile) {
  for (auto const& format : formats()) {
    EXPECT_EQ(format_named(format.name), &format);
    if (!format.extension.empty()) {
      EXPECT_EQ(format_of(files::path("map").concat(format.extension)), &format);
    }
  }
  EXPECT_EQ(format_named("shapefile"), nullptr);
  EXPECT_EQ(format_of("slots.csv"), format_named("csv"));
  EXPECT_EQ(format_of("map.exe"), nullptr);
}

struct ExportTest : ::testing::Test {
  base::testing::TemporaryFolder temporary;
  files::path folder = temporary.path();
  MapContents contents;
  void SetUp() override {
    contents.sites.emplace("yard", geo::Site::make("yard", geo::Wgs84::from_degrees(41.0, -8.0)).value());
    contents.features.push_back({.id = "w",
                                 .site = "yard",
                                 .account = {.writer = "1", .at = base::UtcTime(std::chrono::hours(500'000))},
                                 .content = map::Wall{.line = {{map::SitePoint(0, 0), map::SitePoint(5, 0)}}}});
  }
};

TEST_F(ExportTest, EveryFormatIsWrittenAndThoseThatAreReadComeBack) {
  map::OccupancyGrid grid(0.1);
  for (int i = 0; i < 50; ++i) grid.set({i, i}, map::Evidence::of_probability(0.9));
  contents.grids.emplace(map::GridKey{"yard", "0", "floor"}, grid);
  auto const site = contents.sites.find("yard")->second;
  for (auto const& format : formats()) {
    bool const is_folder = format.extension.empty() || (format.holds_grids && format.is_read);
    auto const path = folder / std::string(format.name) / (is_folder ? "" : fmt::format("map{}", format.extension));
    files::create_directories(is_folder ? path : path.parent_path());
    auto const written = export_map(contents, format, path);
    ASSERT_TRUE(written) << format.name << ": " << written.error().message;
    if (!format.is_read) continue;
    auto const file = format.holds_grids ? path / fmt::format("0-floor{}", format.extension) : path;
    auto const read = import_map(file, {.site = site});
    ASSERT_TRUE(read) << format.name << ": " << read.error().message;
    EXPECT_EQ(read->features.size(), format.holds_features ? 1U : 0U) << format.name;
    EXPECT_EQ(read->grids.size(), format.holds_grids ? 1U : 0U) << format.name;
  }
}

TEST_F(ExportTest, OneLayerCanBeChosen) {
  contents.features.push_back(contents.features[0]);
  contents.features[1].content = map::PointOfInterest{.position = map::SitePoint(1, 1)};
  ASSERT_TRUE(export_map(contents, *format_named("geojson"), folder, {.choice = {.layers = {map::LayerKind::walls}}}));
  EXPECT_TRUE(files::exists(folder / "walls.geojson"));
  EXPECT_FALSE(files::exists(folder / "points_of_interest.geojson"));
}

TEST_F(ExportTest, SeveralFilesCanBeOneArchive) {
  auto const archive = folder / "map.zip";
  ASSERT_TRUE(export_map(contents, *format_named("geojson"), archive));
  EXPECT_FALSE(files::exists(archive.string() + ".parts"));
  std::ifstream in(archive, std::ios::binary);
  std::string const bytes{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(bytes.starts_with("PK\x03\x04"));
  EXPECT_NE(bytes.find("walls.geojson"), std::string::npos);
  EXPECT_NE(bytes.find("sites.geojson"), std::string::npos);
}

TEST_F(ExportTest, CanBeStopped) {
  for (auto const* format : {"geojson", "geopackage", "geotiff"}) {
    map::OccupancyGrid grid(0.1);
    grid.set({1, 1}, map::Evidence::of_probability(0.9));
    contents.grids.insert_or_assign(map::GridKey{"yard", "0", "floor"}, grid);
    auto const stopped = export_map(contents, *format_named(format), folder / fmt::format("map.{}", format),
                                    {.progress = [](double) { return false; }});
    ASSERT_FALSE(stopped) << format;
    EXPECT_EQ(stopped.error().kind, base::ErrorKind::cancelled) << format << stopped.error().message;
  }
}

TEST_F(ExportTest, MistakesAreTold) {
  EXPECT_NE(export_map(contents, *format_named("ros"), folder).error().message.find("nothing in the map"),
            std::string::npos);
  EXPECT_EQ(import_map(folder / "none.gpkg").error().kind, base::ErrorKind::not_found);
  std::ofstream(folder / "plan.pdf") << "x";
  EXPECT_NE(import_map(folder / "plan.pdf").error().message.find("written only"), std::string::npos);
  std::ofstream(folder / "map.yaml") << "x";
  EXPECT_NE(import_map(folder / "map.yaml").error().hint.find("--site"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::formats
