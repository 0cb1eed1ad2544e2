// Base maps as browsers get them.
#include "station/basemaps/base_map_routes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace lapwing::station {
namespace {

using nlohmann::json;

/// One tile at the top of the world; below it a damaged part.
class ToyArchive final : public map::TileArchive {
 public:
  ToyArchive() {
    info_.name = "Toy";
    info_.attribution = "toymakers";
    info_.media_type = "image/webp";
    info_.greatest_zoom = 5;
  }
  [[nodiscard]] map::TileArchiveInfo const& info() const override { return info_; }
  [[nodiscard]] base::Result<std::optional<std::string>> tile(map::TileAddress const& at) const override {
    if (at.zoom == 0) return std::optional<std::string>("picture");
    if (at.zoom == 1) return std::optional<std::string>();
    return base::fail(base::ErrorKind::invalid_input, "the archive is damaged");
  }

 private:
  map::TileArchiveInfo info_;
};

struct BaseMapRoutesTest : ::testing::Test {
  base::Loop loop{{.unpaced = true}};
  std::filesystem::path drawing = std::filesystem::path(::testing::TempDir()) / "ground.geojson";

  HttpResponse get(std::string const& target) {
    Router router;
    add_base_map_routes(router, loop,
                        {{"far", "Elsewhere", "them", TileAddressTemplate{"https://tiles.example/{z}/{x}/{y}.png"}},
                         {"toy", "Toy", "", std::make_shared<ToyArchive const>()},
                         {"yard", "The yard", "", DrawnGround{drawing}}});
    auto reply = router.answer(request_for("GET", target).value());
    if (auto* response = std::get_if<HttpResponse>(&reply)) return *response;
    HttpResponse answer;
    loop.run_until_done([](base::Task<HttpResponse> work, HttpResponse& into) -> base::Task<> {
      into = co_await std::move(work);
    }(std::get<base::Task<HttpResponse>>(std::move(reply)), answer));
    return answer;
  }
};

TEST_F(BaseMapRoutesTest, ListsEachWithWhatAMapNeeds) {
  auto const maps = json::parse(get("/api/v1/basemaps").body)["basemaps"];
  ASSERT_EQ(maps.size(), 3U);
  EXPECT_EQ(maps[0]["url"], "https://tiles.example/{z}/{x}/{y}.png");
  EXPECT_EQ(maps[1]["url"], "/api/v1/basemaps/toy/tiles/{z}/{x}/{y}");
  EXPECT_EQ(maps[1]["attribution"], "toymakers") << "who made the archive is told";
  EXPECT_EQ(maps[1]["max_zoom"], 5);
  EXPECT_EQ(maps[2]["kind"], "drawing");
}

TEST_F(BaseMapRoutesTest, GivesTilesOfArchives) {
  auto const tile = get("/api/v1/basemaps/toy/tiles/0/0/0");
  EXPECT_EQ(tile.status, 200);
  EXPECT_EQ(tile.content_type, "image/webp");
  EXPECT_EQ(tile.body, "picture");
  EXPECT_EQ(get("/api/v1/basemaps/toy/tiles/1/0/0").status, 204) << "nothing there";
  EXPECT_EQ(get("/api/v1/basemaps/toy/tiles/2/0/0").status, 400);
}

TEST_F(BaseMapRoutesTest, GivesDrawnGroundWhileItIsThere) {
  std::ofstream(drawing) << R"({"type":"FeatureCollection","features":[]})";
  EXPECT_EQ(get("/api/v1/basemaps/yard/drawing").content_type, "application/geo+json");
  std::filesystem::remove(drawing);
  auto const gone = get("/api/v1/basemaps/yard/drawing");
  EXPECT_EQ(gone.status, 404);
  EXPECT_EQ(gone.body.find(::testing::TempDir()), std::string::npos) << "folders of this machine stay here";
}

TEST_F(BaseMapRoutesTest, OtherAddressesAreRefused) {
  EXPECT_EQ(get("/api/v1/basemaps/moon/tiles/0/0/0").status, 404);
  EXPECT_EQ(get("/api/v1/basemaps/far/tiles/0/0/0").status, 404) << "the station is nobody's proxy";
  EXPECT_EQ(get("/api/v1/basemaps/toy/drawing").status, 404);
  EXPECT_EQ(get("/api/v1/basemaps/toy/tiles/1/2/0").status, 400);
  EXPECT_EQ(get("/api/v1/basemaps/toy/tiles/-1/0/0").status, 400);
  EXPECT_EQ(get("/api/v1/basemaps/toy/tiles/4294967296/0/0").status, 400);
}

}  // namespace
}  // namespace lapwing::station
