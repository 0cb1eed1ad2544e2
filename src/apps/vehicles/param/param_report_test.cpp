#include "apps/vehicles/param/param_report.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lapwing::apps {
namespace {

using enum mavlink::MavParamType;
using nlohmann::json;
using parameters::Parameter;

TEST(ParamReport, ListsNamesValuesAndTypes) {
  ParamListing const one{.vehicle = {"", 3}, .parameters = {{"RTL_ALT", 1500, int32}, {"A", 0.5, real32}}};
  EXPECT_EQ(listing_text({one}),
            "RTL_ALT                     1500  int32\n"
            "A                            0.5  real32\n");
  auto old = one;
  old.confirmed = parameters::Confirmed::not_at_all;
  EXPECT_NE(listing_text({old, one}).find("# as of 1970-01-01T00:00:00Z; not confirmed"), std::string::npos);
}

TEST(ParamReport, WritesNumbersAsTheVehicleHoldsThem) {
  ParamListing const one{.vehicle = {"", 3},
                         .firmware = "4.6.0",
                         .parameters = {{"A", static_cast<double>(0.1F), real32},
                                        {"B", 4294967295.0, uint32},
                                        {"C", std::numeric_limits<double>::quiet_NaN(), real32}}};
  auto const text = listing_json({one});
  EXPECT_NE(text.find("\"value\": 0.1,"), std::string::npos) << text;
  auto const all = json::parse(text)["vehicles"][0];
  EXPECT_EQ(all["id"], 3);
  EXPECT_EQ(all["confirmed"], "vehicle");
  EXPECT_EQ(all["parameters"][1]["value"], 4294967295.0);
  EXPECT_TRUE(all["parameters"][2]["value"].is_null());
}

TEST(ParamReport, WritesNamesThatAreNoText) {
  ParamListing const one{.vehicle = {"", 3}, .parameters = {{"\xFF", 1, int32}}};
  EXPECT_EQ(json::parse(listing_json({one}))["vehicles"][0]["parameters"][0]["name"], "\uFFFD");
}

TEST(ParamReport, NamesTheNetworkOfAVehicle) {
  ParamListing const here{.vehicle = {"", 7}};
  ParamListing const there{.vehicle = {"north", 7}};
  auto const text = listing_text({here, there});
  EXPECT_NE(text.find("# vehicle 7\n"), std::string::npos) << text;
  EXPECT_NE(text.find("# vehicle north/7\n"), std::string::npos) << text;
  auto const vehicles = json::parse(listing_json({here, there}))["vehicles"];
  EXPECT_FALSE(vehicles[0].contains("network"));
  EXPECT_EQ(vehicles[1]["id"], 7);
  EXPECT_EQ(vehicles[1]["network"], "north");
}

TEST(ParamReport, TellsWhatWasSetAndWhatNot) {
  ParamChanges const changes{.vehicle = {"", 1},
                             .changed = {{.before = {"A", 1, int8}, .after = {"A", 2, int8}}},
                             .unchanged = 4,
                             .skipped = {"SYSID_THISMAV"},
                             .failed = {{"B", "no"}}};
  EXPECT_EQ(changes_text({changes}),
            "vehicle 1: A = 2 (was 1)\n"
            "vehicle 1: B NOT set: no\n"
            "vehicle 1: left out, they belong to one vehicle: SYSID_THISMAV\n"
            "vehicle 1: 1 set, 4 as they were, 1 left out, 1 failed\n");
  auto const read = json::parse(changes_json({changes}))["vehicles"][0];
  EXPECT_EQ(read["changed"][0]["after"], 2);
  EXPECT_EQ(read["failed"][0]["name"], "B");
  EXPECT_EQ(read["skipped"][0], "SYSID_THISMAV");
}

TEST(ParamReport, ShowsDifferencesSideBySide) {
  EXPECT_EQ(differences_text("vehicle 1", "a.params", {}), "vehicle 1 and a.params have the same parameters\n");
  auto const text = differences_text("vehicle 1", "a.params", {{"A", Parameter{"A", 1, int8}, std::nullopt}});
  EXPECT_NE(text.find("A                                1                 -\n"), std::string::npos) << text;
  EXPECT_TRUE(json::parse(differences_json("a", "b",
                                           {{"A", Parameter{"A", 1, int8}, std::nullopt}}))["differences"][0]["second"]
                  .is_null());
}

}  // namespace
}  // namespace lapwing::apps
