#include "station/map/ogc/ogc_routes.hpp"

#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text/utc_text.hpp"
#include "station/map/grids/grid_pictures.hpp"
#include "station/map/grids/grid_routes.hpp"
#include "station/testing/grid_demo.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

struct OgcRoutes : ::testing::Test, testing::MapDemo {
  OgcRoutes() {
    add_ogc_routes(router, loop, live);
    add_grid_routes(router, loop, live, pictures, nullptr, "run");
    put(testing::slot("a", 0, 0, now() - 1h));
    put(testing::slot("b", 100, 0, now(), map::SlotState::taken));
    put(testing::door("north/1", 5, 5, now()));
    testing::put_tiles(*this, {{0, 0}}, now());
  }
  HttpResponse ask(std::string_view target) { return testing::ask(loop, router, "GET", target); }
  json get(std::string_view target) {
    auto const response = ask(target);
    EXPECT_EQ(response.status, 200) << target << ": " << response.body;
    return json::parse(response.body);
  }
  /// The address behind a link of a document, from the root on.
  static std::string link(json const& document, std::string_view rel) {
    for (auto const& one : document["links"]) {
      if (one["rel"] != rel) continue;
      auto const href = one["href"].get<std::string>();
      std::string_view const origin = "http://station:8080";
      EXPECT_TRUE(href.starts_with(origin)) << href;
      return href.substr(origin.size());
    }
    ADD_FAILURE() << "no link " << rel << " in " << document["links"];
    return "";
  }

  GridPictures pictures{loop, live, std::make_shared<GridPlaces>(live)};
  Router router;
};

TEST_F(OgcRoutes, LeadFromTheLandingPageToAFeature) {
  auto const landing = get("/ogc");
  EXPECT_EQ(link(landing, "self"), "/ogc");
  auto const conformance = get(link(landing, "conformance"))["conformsTo"];
  for (auto const* one : {"core", "geojson", "oas30"})
    EXPECT_NE(
        conformance.dump().find(fmt::format("\"http://www.opengis.net/spec/ogcapi-features-1/1.0/conf/{}\"", one)),
        std::string::npos);
  auto const collections = get(link(landing, "data"))["collections"];
  ASSERT_EQ(collections.size(), 7U);
  auto const slots = get(link(collections[0], "self"));
  EXPECT_EQ(slots, collections[0]);
  EXPECT_EQ(slots["id"], "slots");
  EXPECT_NEAR(slots["extent"]["spatial"]["bbox"][0][0].get<double>(), 8.0, 1e-6);
  EXPECT_FALSE(collections[1].contains("extent")) << "there are no walls";
  auto const items = get(link(slots, "items"));
  EXPECT_EQ(items["type"], "FeatureCollection");
  EXPECT_EQ(items["numberMatched"], 2);
  EXPECT_TRUE(items["timeStamp"].get<std::string>().ends_with('Z'));
  EXPECT_EQ(link(items, "collection"), "/ogc/collections/slots");
  auto const item = get("/ogc/collections/slots/items/b");
  EXPECT_EQ(item["properties"], items["features"][1]["properties"]);
  EXPECT_EQ(link(item, "self"), "/ogc/collections/slots/items/b");
}

TEST_F(OgcRoutes, LeadBackToAProxyThatSpeaksTls) {
  auto const landing =
      json::parse(testing::ask(loop, router, "GET", "/ogc", {}, {{"X-Forwarded-Proto", "https"}}).body);
  ASSERT_FALSE(landing["links"].empty());
  for (auto const& one : landing["links"])
    EXPECT_TRUE(one["href"].get<std::string>().starts_with("https://station:8080/")) << one;
}

TEST_F(OgcRoutes, FollowTheIdOfAFeatureThatHoldsASlash) {
  auto const item = get("/ogc/collections/points_of_interest/items/north%2F1");
  EXPECT_EQ(item["id"], "north/1");
  EXPECT_EQ(get(link(item, "self"))["id"], "north/1");
}

TEST_F(OgcRoutes, AnswerFiltersAndPages) {
  auto const count = [&](std::string_view query) {
    return get(fmt::format("/ogc/collections/slots/items?{}", query))["numberMatched"].get<int>();
  };
  EXPECT_EQ(count("bbox=8.001,46.999,8.01,47.01"), 1);
  EXPECT_EQ(count("bbox=8.001,46.999,0,8.01,47.01,10"), 1);
  EXPECT_EQ(count("bbox=-180,-90,180,90"), 2);
  EXPECT_EQ(count(fmt::format("datetime=../{}", base::utc_text(now() - 30min))), 1);
  EXPECT_EQ(count("state=taken"), 1);
  auto const first = get("/ogc/collections/slots/items?limit=1");
  EXPECT_EQ(first["features"][0]["id"], "a");
  auto const second = get(link(first, "next"));
  EXPECT_EQ(second["features"][0]["id"], "b");
  EXPECT_EQ(get(link(second, "prev"))["features"], first["features"]);
  EXPECT_EQ(get("/ogc/collections/slots/items?limit=99999999")["numberReturned"], 2);
}

TEST_F(OgcRoutes, RefuseWhatTheStandardSaysTheyMust) {
  for (auto const* target :
       {"/ogc?x=1", "/ogc/collections?x=1", "/ogc/collections/slots?limit=1", "/ogc/collections/slots/items?x=1",
        "/ogc/collections/slots/items?limit=0", "/ogc/collections/slots/items?bbox=1,2",
        "/ogc/collections/slots/items?datetime=then", "/ogc/collections/slots/items/a?x=1", "/ogc/conformance?f=html"})
    EXPECT_EQ(ask(target).status, 400) << target;
  for (auto const* target : {"/ogc/collections/cars", "/ogc/collections/cars/items", "/ogc/collections/slots/items/z",
                             "/ogc/collections/grid:yard:0:none/map/tiles", "/ogc/collections/slots/map/tiles"})
    EXPECT_EQ(ask(target).status, 404) << target;
  EXPECT_EQ(ask("/ogc?f=json").status, 200);
}

TEST_F(OgcRoutes, DescribeThemselves) {
  auto const response = ask(link(get("/ogc"), "service-desc"));
  EXPECT_EQ(response.content_type, "application/vnd.oai.openapi+json;version=3.0");
  auto const api = json::parse(response.body);
  EXPECT_EQ(api["openapi"], "3.0.3");
  std::set<std::string> names;
  for (auto const& parameter : api["paths"]["/collections/slots/items"]["get"]["parameters"])
    names.insert(parameter["name"]);
  for (auto const* name : {"bbox", "datetime", "limit", "state", "taken_probability"})
    EXPECT_TRUE(names.contains(name)) << name;
  EXPECT_FALSE(names.contains("thickness_m")) << "walls have that";
}

TEST_F(OgcRoutes, LeadFromAGridToItsPictures) {
  auto const grid = get("/ogc/collections/grid:yard:0:floor");
  EXPECT_EQ(grid["layerDataType"], "Raster");
  auto const tilesets = get(link(grid, "http://www.opengis.net/def/rel/ogc/1.0/tilesets-map"));
  auto const tileset = get(link(tilesets["tilesets"][0], "self"));
  auto const scheme = get(link(tileset, "http://www.opengis.net/def/rel/ogc/1.0/tiling-scheme"));
  EXPECT_EQ(scheme["tileMatrices"].size(), 26U);
  EXPECT_NEAR(scheme["tileMatrices"][0]["scaleDenominator"].get<double>(), 559'082'264.0287178, 1e-3);
  EXPECT_EQ(scheme["type"], "TileMatrixSetType") << "by which older programs know it";
  EXPECT_EQ(scheme["tileMatrix"][25]["identifier"], "25");
  EXPECT_EQ(scheme["tileMatrix"][25]["topLeftCorner"], scheme["tileMatrices"][25]["pointOfOrigin"]);
  auto const& limits = tileset["tileMatrixSetLimits"].back();
  auto address = link(tileset, "item");
  auto const fill = [&](std::string_view name, std::string const& value) {
    address.replace(address.find(name), name.size(), value);
  };
  fill("{tileMatrix}", limits["tileMatrix"]);
  fill("{tileRow}", limits["minTileRow"].dump());
  fill("{tileCol}", limits["minTileCol"].dump());
  EXPECT_EQ(ask(address).content_type, "image/png");
}

}  // namespace
}  // namespace lapwing::station
