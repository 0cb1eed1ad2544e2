#include "host/station/station_config.hpp"

#include "host/links/ground.hpp"

#include <gtest/gtest.h>

#include "host/files/files.hpp"

namespace lapwing::host {
namespace {

struct Read {
  explicit Read(std::string text, std::string name = "/etc/lapwing/station.toml")
      : source(std::move(name), std::move(text)),
        diagnostics(source),
        config(read_station_config(source, diagnostics)) {}
  std::string complaints() const { return render(diagnostics); }

  base::SourceFile source;
  base::Diagnostics diagnostics;
  StationConfig config;
};

/// The first complaint's place, message and hint.
std::string first_complaint(std::string text) {
  Read const read(std::move(text));
  auto const records = to_records(read.diagnostics);
  if (records.empty()) return "";
  return std::to_string(records[0].begin.line) + ":" + std::to_string(records[0].begin.column) + " " +
         records[0].message + " | " + records[0].hint;
}

TEST(StationConfig, HasSurveyDrones) {
  Read const read(
      "[[survey]]\nname = \"hawk\"\naddress = \"10.0.0.2:3001\"\ntoken_file = \"hawk.token\"\nauthority = "
      "\"ca.pem\"\n");
  ASSERT_EQ(read.config.survey.size(), 1U);
  EXPECT_EQ(read.config.survey[0].name, "hawk");
  EXPECT_EQ(read.config.survey[0].settings.port, 3001);
  EXPECT_TRUE(read.config.survey[0].settings.tls.has_value());
  EXPECT_EQ(read.config.survey[0].token_file.filename(), "hawk.token");
  for (auto const* const text :
       {"[[survey]]\nname = \"hawk\"\n", "[[survey]]\naddress = \"a:1\"\n",
        "[[survey]]\nname = \"a b\"\naddress = \"a:1\"\n", "[[survey]]\nname = \"a\"\naddress = \"a:x\"\n",
        "[[survey]]\nname = \"a\"\naddress = \"a:1\"\nkey = \"k.pem\"\n",
        "[[survey]]\nname = \"a\"\naddress = \"a:1\"\ntoken = \"secret\"\n"})
    EXPECT_NE(first_complaint(text), "") << text;
}

TEST(StationConfig, SetsFromWhereOnABatteryCountsAsLow) {
  Read const read("[alarms]\nbattery_low_percent = 40\nbattery_critical_percent = 25.5\n");
  EXPECT_EQ(read.complaints(), "");
  EXPECT_DOUBLE_EQ(read.config.battery_limits.low, 0.4);
  EXPECT_DOUBLE_EQ(read.config.battery_limits.critical, 0.255);
  EXPECT_EQ(first_complaint("[alarms]\nbattery_critical_percent = 40\n"),
            "2:28 a battery is low before it is critical | battery_low_percent is 30, battery_critical_percent 40");
}

TEST(StationConfig, OfAnEmptyFileIsLoopbackAlone) {
  Read const read("");
  EXPECT_EQ(read.complaints(), "");
  EXPECT_TRUE(read.config.links.empty());
  EXPECT_EQ(read.config.web.bind, "127.0.0.1");
  EXPECT_EQ(read.config.web.port, 8080);
  EXPECT_FALSE(read.config.web.generate_token);
  EXPECT_FALSE(read.config.map.home);
}

TEST(StationConfig, NamesRobotsAsTheCommandLineDoes) {
  Read const read("robots = [\"sim:office.toml:2\", \"serial:///dev/ttyUSB0:115200@1,2,90\"]\n");
  EXPECT_EQ(read.complaints(), "");
  EXPECT_EQ(read.config.robots.size(), 2U);
  EXPECT_TRUE(first_complaint("robots = [\"tractor\"]\n").starts_with("1:11 "))
      << first_complaint("robots = [\"tractor\"]\n");
}

TEST(StationConfig, ReadsLimitsOfPlausibilityAndWhatIsAllowed) {
  Read const read("[plausibility]\nceiling = 300\n[plausibility.allow]\nshared_pad = \"one pad, in turn\"\n");
  EXPECT_EQ(read.complaints(), "");
  EXPECT_EQ(read.config.plausibility.limits.ceiling_m, 300.0);
  EXPECT_EQ(read.config.plausibility.allowed.at(plan::plausibility::Rule::shared_pad), "one pad, in turn");
  EXPECT_EQ(first_complaint("[plausibility]\nceilng = 300\n"),
            "2:1 there is no setting ceilng | did you mean ceiling?");
  EXPECT_NE(first_complaint("[plausibility]\nceiling = -5\n"), "");
  EXPECT_NE(first_complaint("[plausibility.allow]\ntoo_far = \" \"\n"), "");
  EXPECT_NE(first_complaint("[plausibility.allow]\ntoo_fr = \"x\"\n"), "");
}

TEST(StationConfig, ReadsWhoRidesAlong) {
  Read const read(R"([[forward]]
name = "qgc"
url = "udpout://127.0.0.1:14551"
[[forward]]
url = "tcpin://127.0.0.1:5760"
read_only = true
messages_per_s = 10
)");
  EXPECT_EQ(read.complaints(), "");
  ASSERT_EQ(read.config.forward.size(), 2U);
  EXPECT_EQ(read.config.forward[0].endpoint.name, "qgc");
  EXPECT_FALSE(read.config.forward[0].endpoint.is_read_only);
  EXPECT_TRUE(read.config.forward[1].endpoint.is_read_only);
  EXPECT_TRUE(read.config.forward[1].endpoint.limits.any());
  EXPECT_EQ(first_complaint("[[forward]]\nread_only = true\n"),
            "1:1 an endpoint needs a url | url = \"udpin://0.0.0.0:14550\"");
}

TEST(StationConfig, ReadsEverySetting) {
  Read const read(R"(links = ["udpin://0.0.0.0:14550", "serial:///dev/ttyUSB0:57600"]
on_stop = "rtl"
emergency_stop = "land"
[web]
bind = "0.0.0.0"
port = 0
token_file = "secret"
host_names = ["station.local"]
[map]
site = "Field"
home = "41.5,-8.5,90"
tiles = "https://tiles.example/{z}/{x}/{y}.png"
scripts = "."
)",
                  LAPWING_SOURCE_DIR "/examples/station.toml");
  EXPECT_EQ(read.complaints(), "");
  EXPECT_EQ(read.config.links.size(), 2U);
  EXPECT_EQ(read.config.on_stop, fleet::OnStop::rtl);
  EXPECT_EQ(read.config.emergency_action, vehicle::StopAction::land);
  EXPECT_EQ(read.config.web.bind, "0.0.0.0");
  EXPECT_EQ(read.config.web.port, 0);
  EXPECT_EQ(read.config.web.token_file, LAPWING_SOURCE_DIR "/examples/secret") << "beside the file";
  EXPECT_EQ(read.config.web.host_names, (std::vector<std::string>{"station.local"}));
  EXPECT_EQ(read.config.map.site_name, "Field");
  EXPECT_NEAR(read.config.map.home->lat_deg(), 41.5, 1e-9);
  EXPECT_EQ(read.config.map.tiles, "https://tiles.example/{z}/{x}/{y}.png");
  EXPECT_EQ(read.config.map.scripts, LAPWING_SOURCE_DIR "/examples/.");
}

TEST(StationConfig, ReadsWhatVehiclesCarry) {
  Read const read("payload = [\"3=Sidescan,Multibeam\", \"4=Camera\", \"3=Lamp\", \"north/3=Sonar\"]");
  EXPECT_EQ(read.complaints(), "");
  EXPECT_EQ(
      read.config.payload,
      (Equipment{{{"", 3}, {"Sidescan", "Multibeam", "Lamp"}}, {{"", 4}, {"Camera"}}, {{"north", 3}, {"Sonar"}}}));
  for (auto const* wrong : {"Camera", "=Camera", "0=Camera", "256=Camera", "3=", "x3=Camera", "/3=Camera"}) {
    auto const complaint = first_complaint("payload = [\"" + std::string(wrong) + "\"]");
    EXPECT_NE(complaint.find("is no payload of a vehicle"), std::string::npos) << wrong << ": " << complaint;
  }
}

TEST(StationConfig, TakesTheExample) {
  std::string const path = LAPWING_SOURCE_DIR "/examples/station.toml";
  Read const read(read_script(path).value(), path);
  EXPECT_EQ(read.complaints(), "");
  EXPECT_EQ(read.config.map.site_name, "Car park");
}

TEST(StationConfig, SuggestsForUnknownSettings) {
  EXPECT_EQ(first_complaint("link = []\n"), "1:1 there is no setting link | did you mean links?");
  EXPECT_EQ(first_complaint("[web]\nprot = 1\n"), "2:1 there is no setting prot | did you mean port?");
  EXPECT_EQ(first_complaint("[mpa]\n"), "1:2 there is no setting mpa | did you mean map?");
}

TEST(StationConfig, RefusesWrongTypes) {
  EXPECT_EQ(first_complaint("links = \"udpin://127.0.0.1:1\""), "1:9 links must be an array of texts, not text | ");
  EXPECT_EQ(first_complaint("[web]\nport = \"80\""), "2:8 port must be a whole number, not text | ");
  EXPECT_EQ(first_complaint("web = 1"), "1:7 web must be a table: [web], not a whole number | ");
}

TEST(StationConfig, RefusesBadValuesWithTheirPlace) {
  EXPECT_EQ(first_complaint("emergency_stop = \"holt\""),
            "1:18 emergency_stop cannot be \"holt\" | did you mean hold?");
  EXPECT_EQ(first_complaint("on_stop = \"lioter\""), "1:11 on_stop cannot be \"lioter\" | did you mean loiter?");
  EXPECT_EQ(first_complaint("[web]\nport = 65536").substr(0, 4), "2:8 ");
  EXPECT_EQ(first_complaint("links = [\n  \"udpin://127.0.0.1:1\",\n  \"udp:14550\",\n]").substr(0, 4), "3:3 ");
  EXPECT_EQ(first_complaint("[map]\nhome = \"41\"").substr(0, 4), "2:8 ");
  EXPECT_EQ(first_complaint("[map]\nscripts = \"absent\""),
            "2:11 there is no folder /etc/lapwing/absent | a relative path counts from this file's folder");
  EXPECT_EQ(first_complaint("[map]\ntiles = \"https://tiles.example/{z}/{x}\""),
            "2:9 the address of map tiles must contain {y} | https://tiles.example/{z}/{x}/{y}.png");
  EXPECT_EQ(first_complaint("[map]\ntiles = \"http://tiles.example/{z}/{x}/{y}\"").substr(0, 13), "2:9 map tiles");
}

TEST(StationConfig, WantsTheTokenInAFileOfItsOwn) {
  Read const read("[web]\ntoken = \"0123456789abcdef\"\n");
  EXPECT_EQ(read.diagnostics.error_count(), 1U);
  EXPECT_NE(read.complaints().find("token_file = "), std::string::npos);
}

TEST(StationConfig, WantsOneTokenOnly) {
  EXPECT_EQ(first_complaint("[web]\ntoken_file = \"t\"\ngenerate_token = true"),
            "3:18 a token comes from token_file or is generated, not both | remove one of them");
}

TEST(StationConfig, ShowsAllMistakesAtOnce) {
  Read const read("on_stop = 1\nlinks = [2]\nx = 3\n[web]\nport = -1\n[map]\nsite = true\n");
  EXPECT_EQ(read.diagnostics.error_count(), 5U);
}

TEST(StationConfig, RefusesWhatIsNoToml) {
  EXPECT_EQ(first_complaint("links = [\n").substr(0, 2), "1:") << first_complaint("links = [\n");
}

TEST(StationConfig, TakesLinksOfSeveralNetworks) {
  Read const read("links = [\"udpin://0.0.0.0:14550\", \"north=udpin://0.0.0.0:14551\"]\n");
  EXPECT_EQ(read.config.links.size(), 2U);
  auto const north = parse_network_link(read.config.links.at(1));
  ASSERT_TRUE(north);
  EXPECT_EQ(north->network, "north");
  EXPECT_EQ(link::to_string(north->url), "udpin://0.0.0.0:14551");
  EXPECT_EQ(parse_network_link("serial:///dev/ttyUSB0:57600?flow=on")->network, "");
  EXPECT_EQ(first_complaint("links = [\"no/rth=udpin://0.0.0.0:14551\"]\n").substr(0, 4), "1:10");
  EXPECT_NE(first_complaint("links = [\"n rth=udpin://0.0.0.0:14551\"]\n").find("no name of a network"),
            std::string::npos);
}

TEST(StationConfig, BaseMapsAreReadInTheirOrder) {
  Read const read(
      "[map]\n[[map.base]]\ntiles = \"https://tiles.example/{z}/{x}/{y}.png\"\nname = \"Streets\"\nmax_zoom = 17\n"
      "[[map.base]]\ntiles = \"https://other.example/{z}/{x}/{y}.png\"\nattribution = \"others\"\n");
  ASSERT_EQ(read.config.map.base_maps.size(), 2U);
  auto const& streets = read.config.map.base_maps[0];
  EXPECT_EQ(streets.name, "Streets");
  EXPECT_EQ(std::get<station::TileAddressTemplate>(streets.source).greatest_zoom, 17U);
  auto const& other = read.config.map.base_maps[1];
  EXPECT_EQ(other.name, "other.example");
  EXPECT_EQ(other.attribution, "others");
  EXPECT_NE(other.id, streets.id);
}

TEST(StationConfig, BaseMapsThatCannotBeShownAreRefusedWithTheWayOut) {
  EXPECT_NE(first_complaint("[[map.base]]\nname = \"x\"").find("a `file` or an address"), std::string::npos);
  EXPECT_NE(first_complaint("[[map.base]]\nfile = \"a.tif\"").find("lapwing basemap"), std::string::npos);
  EXPECT_NE(first_complaint("[[map.base]]\nfile = \"none.mbtiles\"").find("2:8"), std::string::npos);
  EXPECT_NE(first_complaint("[[map.base]]\nfile = \"none.geojson\"").find("there is no file"), std::string::npos);
  EXPECT_NE(first_complaint("[[map.base]]\ntiles = \"http://far.example/{z}/{x}/{y}\"").find("https://"),
            std::string::npos);
}

TEST(StationConfig, SaysWhereTheMapIsKeptAndForHowLong) {
  Read const read("[store]\nplace = \"maps\"\nmost_mb = 100\ndays = 7\n");
  EXPECT_EQ(read.complaints(), "");
  auto const& store = read.config.map.store;
  EXPECT_EQ(store.place, StoreSettings::Place::named);
  EXPECT_EQ(store.address, "/etc/lapwing/maps") << "beside the file";
  EXPECT_EQ(store.most_bytes, 100U * 1024 * 1024);
  EXPECT_EQ(store.longest, std::chrono::hours(168));
  EXPECT_EQ(Read("[store]\nplace = \"postgresql://map@db/lapwing\"").config.map.store.address,
            "postgresql://map@db/lapwing");
  EXPECT_NE(first_complaint("[store]\nmost_mb = 1"), "");
  EXPECT_NE(first_complaint("[store]\npalce = \"x\""), "");
}

}  // namespace
}  // namespace lapwing::host
