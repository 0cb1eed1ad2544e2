#include "station/map/site_routes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/map/site_json.hpp"
#include "station/map/sites_feed.hpp"
#include "station/testing/feed_viewer.hpp"
#include "station/testing/map_demo.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;

struct SiteRoutes : ::testing::Test, testing::MapDemo {
  SiteRoutes() { add_site_routes(router, live); }
  HttpResponse put_site(std::string_view id, std::string body) {
    return testing::ask(loop, router, "PUT", fmt::format("/api/v1/sites/{}", id), std::move(body));
  }
  Router router;
};

TEST_F(SiteRoutes, PlaceASiteWithItsFloors) {
  auto const body = R"({"anchor":{"lat_deg":41.5,"lon_deg":2.1,"alt_m":90},
                        "floors":[{"id":"1","name":"First floor","up_m":3.5,"x_m":4,"y_m":5,"yaw_rad":0.5},{"id":"0"}]})";
  auto const placed = put_site("office", body);
  EXPECT_EQ(placed.status, 201);
  auto const shown = json::parse(testing::ask(loop, router, "GET", "/api/v1/sites/office").body);
  EXPECT_EQ(shown, json::parse(placed.body));
  EXPECT_EQ(shown["id"], "office");
  EXPECT_EQ(shown["anchor"], json({{"lat_deg", 41.5}, {"lon_deg", 2.1}, {"alt_m", 90.0}}));
  EXPECT_EQ(shown["floors"][0]["id"], "0") << "from the lowest up";
  EXPECT_EQ(shown["floors"][1],
            json({{"id", "1"}, {"name", "First floor"}, {"up_m", 3.5}, {"x_m", 4.0}, {"y_m", 5.0}, {"yaw_rad", 0.5}}));
  EXPECT_EQ(put_site("office", R"({"anchor":{"lat_deg":41.6,"lon_deg":2.1}})").status, 200) << "it is moved";
  EXPECT_NEAR(live.site("office")->anchor().lat_deg(), 41.6, 1e-9);
  EXPECT_EQ(json::parse(testing::ask(loop, router, "GET", "/api/v1/sites").body)["sites"].size(), 2U);
}

TEST_F(SiteRoutes, SayWhatIsWrong) {
  for (auto const* body :
       {"", "[]", "{}", R"({"anchor":5})", R"({"anchor":{"lat_deg":1}})", R"({"anchor":{"lat_deg":"1","lon_deg":2}})",
        R"({"anchor":{"lat_deg":91,"lon_deg":2}})", R"({"anchor":{"lat_deg":1,"lon_deg":2},"floors":{}})",
        R"({"anchor":{"lat_deg":1,"lon_deg":2},"floors":[5]})", R"({"anchor":{"lat_deg":1,"lon_deg":2},"floors":[{}]})",
        R"({"anchor":{"lat_deg":1,"lon_deg":2},"floors":[{"id":"0"},{"id":"0","up_m":1}]})",
        R"({"anchor":{"lat_deg":1,"lon_deg":2},"floors":[{"id":"0","up_m":1e999}]})",
        R"({"anchor":{"lat_deg":1,"lon_deg":2},"floors":[{"id":"0","name":7}]})"})
    EXPECT_EQ(put_site("office", body).status, 400) << body;
  EXPECT_EQ(put_site("a%00b", R"({"anchor":{"lat_deg":1,"lon_deg":2}})").status, 400);
  EXPECT_EQ(live.sites().size(), 1U);
  EXPECT_EQ(testing::ask(loop, router, "GET", "/api/v1/sites/office").status, 404);
}

TEST_F(SiteRoutes, HoldTheLimit) {
  for (std::size_t i = live.sites().size(); i < most_sites; ++i)
    live.put_site(geo::Site::make(fmt::format("{}", i), testing::yard_anchor).value());
  EXPECT_EQ(put_site("one more", R"({"anchor":{"lat_deg":1,"lon_deg":2}})").status, 409);
  EXPECT_EQ(put_site("yard", R"({"anchor":{"lat_deg":1,"lon_deg":2}})").status, 200);
}

TEST_F(SiteRoutes, AreFollowedByTheFeed) {
  SitesFeed feed(live);
  json last;
  testing::FeedViewer viewer(feed, [&](json const& message, bool is_whole) {
    EXPECT_TRUE(is_whole);
    last = message;
  });
  viewer.catch_up();
  EXPECT_EQ(last["sites"][0]["floors"].size(), 2U);
  EXPECT_FALSE(viewer.take_one(1000));
  ASSERT_EQ(put_site("office", R"({"anchor":{"lat_deg":1,"lon_deg":2}})").status, 201);
  viewer.catch_up();
  EXPECT_EQ(last["sites"].size(), 2U);
}

}  // namespace
}  // namespace lapwing::station
