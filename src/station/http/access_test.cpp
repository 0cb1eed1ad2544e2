#include "station/http/access.hpp"

#include <gtest/gtest.h>

namespace lapwing::station {
namespace {

HttpRequest get(std::string path, std::vector<HttpHeader> headers) {
  return {.method = "GET", .path = std::move(path), .query = {}, .headers = std::move(headers), .body = {}};
}

HttpRequest post(std::vector<HttpHeader> headers) {
  return {.method = "POST", .path = "/api/v1/stop", .query = {}, .headers = std::move(headers), .body = "{}"};
}

int status(AccessPolicy const& policy, HttpRequest const& request) {
  auto const refused = refusal(policy, request);
  return refused ? refused->status : 200;
}

TEST(Access, LetsLoopbackNamesIn) {
  for (auto const* host : {"127.0.0.1:8080", "localhost:8080", "LOCALHOST", "[::1]:8080", "127.0.0.2"}) {
    EXPECT_EQ(status({}, get("/", {{"Host", host}})), 200) << host;
  }
}

TEST(Access, RefusesForeignNamesAgainstDnsRebinding) {
  for (auto const* host :
       {"evil.example:8080", "127.0.0.1.evil.example", "localhost.evil.example", "", "192.168.1.5", "[::1"}) {
    EXPECT_EQ(status({}, get("/", {{"Host", host}})), 403) << host;
  }
}

TEST(Access, LetsConfiguredNamesAndAddressesIn) {
  AccessPolicy const policy{.loopback_only = false, .host_names = {"station.local"}, .token = {}};
  EXPECT_EQ(status(policy, get("/", {{"Host", "Station.local:8080"}})), 200);
  EXPECT_EQ(status(policy, get("/", {{"Host", "192.168.1.5:8080"}})), 200);
  EXPECT_EQ(status(policy, get("/", {{"Host", "[fd00::5]:8080"}})), 200);
  EXPECT_EQ(status(policy, get("/", {{"Host", "other.local"}})), 403);
}

TEST(Access, RefusesAnotherSitesPage) {
  HttpHeader const host{"Host", "127.0.0.1:8080"};
  HttpHeader const json{"Content-Type", "application/json"};
  EXPECT_EQ(status({}, post({host, json, {"Origin", "http://127.0.0.1:8080"}})), 200);
  EXPECT_EQ(status({}, post({host, json})), 200) << "programs send no origin";
  for (auto const* origin : {"http://evil.example", "http://127.0.0.1:9090", "null", "file://127.0.0.1:8080"}) {
    EXPECT_EQ(status({}, post({host, json, {"Origin", origin}})), 403) << origin;
    EXPECT_EQ(status({}, get("/api/v1/ws", {host, {"Upgrade", "WebSocket"}, {"Origin", origin}})), 403) << origin;
  }
}

TEST(Access, TakesOnlyJsonForWhatChangesState) {
  HttpHeader const host{"Host", "localhost"};
  EXPECT_EQ(status({}, post({host})), 415);
  EXPECT_EQ(status({}, post({host, {"Content-Type", "text/plain"}})), 415);
  EXPECT_EQ(status({}, post({host, {"Content-Type", "application/x-www-form-urlencoded"}})), 415);
  EXPECT_EQ(status({}, post({host, {"Content-Type", "application/JSON ; charset=utf-8"}})), 200);
}

TEST(Access, TakesPicturesAndDeletionsThatBrowsersAskAboutFirst) {
  HttpHeader const host{"Host", "localhost"};
  EXPECT_EQ(status({}, post({host, {"Content-Type", "application/geo+json"}})), 200);
  EXPECT_EQ(status({}, post({host, {"Content-Type", "image/jpeg"}})), 200);
  EXPECT_EQ(status({}, post({host, {"Content-Type", "image/svg+xml"}})), 415) << "it can hold scripts";
  auto request = post({host});
  request.method = "DELETE";
  EXPECT_EQ(status({}, request), 200);
  request.headers.push_back({"Content-Type", "text/plain"});
  EXPECT_EQ(status({}, request), 415);
}

TEST(Access, AsksForTheTokenOnTheApiOnly) {
  AccessPolicy const policy{.loopback_only = true, .host_names = {}, .token = "secret"};
  HttpHeader const host{"Host", "localhost"};
  EXPECT_EQ(status(policy, get("/index.html", {host})), 200);
  auto const refused = refusal(policy, get("/api/v1/status", {host}));
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 401);
  EXPECT_EQ(refused->headers.at(0).value, "Bearer");
  EXPECT_EQ(status(policy, get("/metrics", {host})), 401);
  EXPECT_EQ(status(policy, get("/ogc", {host})), 401);
  EXPECT_EQ(status(policy, get("/ogc/collections", {host})), 401);
  EXPECT_EQ(status(policy, get("/metrics", {host, {"Authorization", "Bearer secret"}})), 200);
  EXPECT_EQ(status(policy, get("/api/v1/status", {host, {"Authorization", "Bearer wrong!"}})), 401);
  EXPECT_EQ(status(policy, get("/api/v1/status", {host, {"Authorization", "Bearer secret"}})), 200);
}

TEST(Access, RefusesARequestForTwoHosts) {
  EXPECT_EQ(status({}, get("/", {{"Host", "localhost"}, {"host", "localhost"}})), 400);
}

TEST(Access, TrustsWhoCarriesTheTokenAndEverybodyWhereNoneIsSet) {
  HttpHeader const host{"Host", "localhost"};
  EXPECT_TRUE(is_trusted({}, get("/", {host})));
  AccessPolicy const policy{.loopback_only = true, .host_names = {}, .token = "secret"};
  EXPECT_FALSE(is_trusted(policy, get("/", {host})));
  EXPECT_TRUE(is_trusted(policy, get("/", {host, {"Authorization", "Bearer secret"}})));
}

TEST(Access, TakesTheTokenFromTheQueryOnlyForWebSockets) {
  AccessPolicy const policy{.loopback_only = true, .host_names = {}, .token = "se cret"};
  auto request = get("/api/v1/ws", {{"Host", "localhost"}, {"Upgrade", "websocket"}});
  request.query = "token=se%20cret";
  EXPECT_EQ(status(policy, request), 401) << "a header alone opens no WebSocket";
  request.opens_websocket = true;
  EXPECT_EQ(status(policy, request), 200);
  request.query = "token=se%2";
  EXPECT_EQ(status(policy, request), 401);
  auto plain = get("/api/v1/status", {{"Host", "localhost"}});
  plain.query = "token=se%20cret";
  EXPECT_EQ(status(policy, plain), 401) << "addresses end up in histories";
}

}  // namespace
}  // namespace lapwing::station
