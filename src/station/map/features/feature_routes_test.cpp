#include "station/map/features/feature_routes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text/utc_text.hpp"
#include "station/testing/map_demo.hpp"

namespace lapwing::station {
namespace {

using map::LayerKind;
using nlohmann::json;
using namespace std::chrono_literals;
using testing::door;
using testing::header;
using testing::slot;

struct FeatureRoutes : ::testing::Test, testing::MapDemo {
  FeatureRoutes() { add_feature_routes(router, loop, live); }
  HttpResponse ask(std::string_view method, std::string_view path, std::string body = {},
                   std::vector<HttpHeader> headers = {}) {
    return testing::ask(loop, router, method, fmt::format("/api/v1/layers/{}", path), std::move(body),
                        std::move(headers));
  }
  json list(std::string_view query) {
    auto const response = ask("GET", fmt::format("slots/features{}", query));
    EXPECT_EQ(response.status, 200) << response.body;
    return json::parse(response.body);
  }
  std::vector<std::string> ids(std::string_view query) {
    std::vector<std::string> all;
    auto const page = list(query);
    for (auto const& feature : page["features"]) all.push_back(feature["id"]);
    return all;
  }
  static std::string point(std::string_view properties = R"("name":"221")") {
    return fmt::format(
        R"({{"type":"Feature","geometry":{{"type":"Point","coordinates":[8.0001,47.0001]}},"properties":{{{}}}}})",
        properties);
  }
  Router router;
};

using Ids = std::vector<std::string>;

TEST_F(FeatureRoutes, ListTheLayers) {
  put(slot("a", 0, 0, now()));
  auto const layers = json::parse(testing::ask(loop, router, "GET", "/api/v1/layers").body)["layers"];
  ASSERT_EQ(layers.size(), 6U);
  EXPECT_EQ(layers[0], json({{"name", "slots"}, {"features", 1}, {"feed", "map.slots"}}));
  EXPECT_EQ(ask("GET", "cars/features").status, 404);
}

TEST_F(FeatureRoutes, FindFeaturesByWhatIsAskedFor) {
  put(slot("a", 0, 0, now() - 1h));
  put(slot("b", 100, 0, now(), map::SlotState::taken));
  auto upstairs = slot("c", 0, 100, now());
  upstairs.floor = "1";
  upstairs.account.writer = "drone 2";
  put(upstairs);
  EXPECT_EQ(ids(""), (Ids{"a", "b", "c"}));
  EXPECT_EQ(ids("?state=taken"), Ids{"b"});
  EXPECT_EQ(ids("?floor=1"), Ids{"c"});
  EXPECT_EQ(ids("?writer=drone%201"), (Ids{"a", "b"}));
  EXPECT_EQ(ids("?site=office"), Ids{});
  EXPECT_EQ(ids(fmt::format("?datetime={}/..", base::utc_text(now() - 1min))), (Ids{"b", "c"}));
  EXPECT_EQ(ids("?bbox=7.999,46.999,8.0001,47.0001"), Ids{"a"}) << "20 m round the anchor";
  EXPECT_EQ(ids("?bbox=-180,-90,180,90"), (Ids{"a", "b", "c"}));
  EXPECT_EQ(ids("?bbox=20,20,21,21"), Ids{});
  EXPECT_EQ(ids("?f=json&limit=1&state=free"), Ids{"a"});
}

TEST_F(FeatureRoutes, GoFromPageToPage) {
  for (int i = 0; i < 25; ++i) put(slot(fmt::format("{:02}", i), i, 0, now()));
  auto const first = list("?limit=10&state=free");
  EXPECT_EQ(first["numberMatched"], 25);
  EXPECT_EQ(first["numberReturned"], 10);
  std::size_t seen = 0;
  std::string target = "/api/v1/layers/slots/features?limit=10&state=free";
  for (int pages = 0; !target.empty() && pages < 10; ++pages) {
    auto const page = json::parse(testing::ask(loop, router, "GET", target).body);
    EXPECT_EQ(page["features"][0]["id"], fmt::format("{:02}", seen));
    seen += page["features"].size();
    target.clear();
    for (auto const& link : page["links"]) {
      auto const href = link["href"].get<std::string>();
      ASSERT_TRUE(href.starts_with("http://station:8080/api/")) << href;
      if (link["rel"] == "next") target = href.substr(std::string_view("http://station:8080").size());
    }
  }
  EXPECT_EQ(seen, 25U);
}

TEST_F(FeatureRoutes, SayWhatIsWrongWithAQuestion) {
  for (auto const* query : {"?colour=red", "?limit=0", "?limit=x", "?limit=-1", "?bbox=1,2,3", "?datetime=now",
                            "?offset=1.5", "?f=html", "?state=%zz", "?limit=1&limit=2"})
    EXPECT_EQ(ask("GET", fmt::format("slots/features{}", query)).status, 400) << query;
  auto const unknown = json::parse(ask("GET", "slots/features?colour=red").body);
  EXPECT_NE(unknown["hint"].get<std::string>().find("taken_probability"), std::string::npos);
}

TEST_F(FeatureRoutes, PutAndShowAndDeleteOne) {
  auto const put = ask("PUT", "points_of_interest/features/door%2F221?floor=1&writer=anna", point());
  ASSERT_EQ(put.status, 201) << put.body;
  EXPECT_EQ(put.content_type, "application/geo+json");
  auto const shown = ask("GET", "points_of_interest/features/door%2F221");
  EXPECT_EQ(shown.body, put.body);
  auto const feature = json::parse(shown.body);
  EXPECT_EQ(feature["id"], "door/221");
  EXPECT_EQ(feature["properties"]["writer"], "anna");
  EXPECT_EQ(feature["properties"]["floor"], "1");
  EXPECT_EQ(feature["properties"]["name"], "221");
  EXPECT_EQ(ask("PUT", "points_of_interest/features/door%2F221", point(R"("name":"222")")).status, 200);
  EXPECT_EQ(ask("DELETE", "points_of_interest/features/door%2F221").status, 204);
  EXPECT_EQ(ask("GET", "points_of_interest/features/door%2F221").status, 404);
  EXPECT_EQ(ask("DELETE", "points_of_interest/features/door%2F221").status, 404);
}

TEST_F(FeatureRoutes, AreRefusedWhatIsOlder) {
  auto const body = point(fmt::format(R"("name":"221","at":"{}")", base::utc_text(now())));
  EXPECT_EQ(ask("PUT", "points_of_interest/features/d", body).status, 201);
  EXPECT_EQ(ask("PUT", "points_of_interest/features/d", body).status, 200) << "the same once more is no mistake";
  auto const older = point(fmt::format(R"("name":"0","at":"{}")", base::utc_text(now() - 1h)));
  EXPECT_EQ(ask("PUT", "points_of_interest/features/d", older).status, 409);
  auto const ahead = point(fmt::format(R"("name":"0","at":"{}")", base::utc_text(now() + 24h)));
  EXPECT_EQ(ask("PUT", "points_of_interest/features/d", ahead).status, 409);
}

TEST_F(FeatureRoutes, HoldToConditions) {
  auto const path = "points_of_interest/features/d";
  auto const first = ask("PUT", path, point(), {{"If-None-Match", "*"}});
  ASSERT_EQ(first.status, 201);
  EXPECT_EQ(ask("PUT", path, point(), {{"If-None-Match", "*"}}).status, 412);
  auto const tag = header(first, "ETag");
  EXPECT_EQ(ask("GET", path, "", {{"If-None-Match", tag}}).status, 304);
  EXPECT_EQ(ask("PUT", path, point(R"("name":"222")"), {{"If-Match", tag}}).status, 200);
  EXPECT_EQ(ask("GET", path, "", {{"If-None-Match", tag}}).status, 200);
  EXPECT_EQ(ask("PUT", path, point(), {{"If-Match", tag}}).status, 412) << "somebody else was there before";
  EXPECT_EQ(ask("DELETE", path, "", {{"If-Match", tag}}).status, 412);
  EXPECT_EQ(ask("PUT", "points_of_interest/features/e", point(), {{"If-Match", "*"}}).status, 412);
  auto const known = header(ask("GET", path), "ETag");
  live.put_site(testing::yard(geo::Wgs84::from_degrees(47.001, 8.0)));
  EXPECT_EQ(ask("GET", path, "", {{"If-None-Match", known}}).status, 200) << "it lies elsewhere now";
}

TEST_F(FeatureRoutes, TakeACollectionOrNothingOfIt) {
  auto const collection = [](std::string_view second) {
    return fmt::format(R"({{"type":"FeatureCollection","features":[
      {{"type":"Feature","id":"a","geometry":{{"type":"Point","coordinates":[8.0001,47.0001]}},"properties":{{}}}},
      {{"type":"Feature","id":"b","geometry":{{"type":"Point","coordinates":{}}},"properties":{{}}}}]}})",
                       second);
  };
  auto const wrong = ask("POST", "points_of_interest/features", collection("[8.0002,95]"));
  EXPECT_EQ(wrong.status, 400);
  EXPECT_NE(wrong.body.find("features[1].geometry.coordinates[1]"), std::string::npos) << wrong.body;
  EXPECT_EQ(live.size(LayerKind::points_of_interest), 0U);
  auto const right = ask("POST", "points_of_interest/features?floor=1", collection("[8.0002,47]"));
  EXPECT_EQ(right.status, 200) << right.body;
  EXPECT_EQ(json::parse(right.body), json({{"given", 2}, {"changed", 2}}));
  EXPECT_EQ(live.size(LayerKind::points_of_interest), 2U);
}

TEST_F(FeatureRoutes, SayWhatIsWrongWithABody) {
  auto const put = [&](std::string body) {
    return ask("PUT", "points_of_interest/features/d", std::move(body)).status;
  };
  EXPECT_EQ(put(""), 400);
  EXPECT_EQ(put("[]"), 400);
  EXPECT_EQ(put(point(R"("colour":"red")")), 400);
  EXPECT_EQ(put(point(R"("site":"office")")), 422);
  EXPECT_EQ(put(point(R"("floor":"7")")), 422);
  EXPECT_EQ(put(R"({"type":"FeatureCollection","features":[]})"), 400);
  EXPECT_EQ(ask("PUT", "slots/features/d", point()).status, 400) << "a slot is no point";
  auto other = json::parse(point());
  other["id"] = "e";
  EXPECT_EQ(put(other.dump()), 400);
  live.put_site(geo::Site::make("office", testing::yard_anchor).value());
  EXPECT_EQ(put(point()), 422) << "of two sites it must say which";
  EXPECT_EQ(ask("PUT", "points_of_interest/features/d?site=office", point()).status, 201);
}

}  // namespace
}  // namespace lapwing::station
