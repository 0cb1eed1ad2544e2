// Exports over HTTP: what can be asked for, how far it is, the file, and that there are never many.
#include "station/exports/export_routes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <variant>

#include "base/async/notifier.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

/// Writes when it is told to.
struct FakeExporter : MapExporter {
  explicit FakeExporter(base::Loop& loop) : go(loop) {}
  base::Task<base::Result<std::vector<ExportFormat>>> formats() override {
    if (is_missing) co_return base::fail(base::ErrorKind::not_found, "lapwing-map is not there", "build it");
    co_return std::vector<ExportFormat>{{.name = "kml", .extension = ".kml", .holds_features = true, .note = "n"}};
  }
  base::Task<base::Result<>> write(ExportWish wish, std::filesystem::path file,
                                   std::function<void(double)> progress) override {
    wishes.push_back(std::move(wish));
    progress(0.5);
    while (!may_end) co_await go.wait();
    if (!fault.empty()) co_return base::fail(base::ErrorKind::invalid_input, fault, "choose more");
    std::ofstream(file) << content;
    co_return base::Result<>();
  }
  base::Notifier go;
  bool may_end = true;
  bool is_missing = false;
  std::string fault;
  std::string content = "<kml/>";
  std::vector<ExportWish> wishes;
};

struct ExportRoutes : ::testing::Test {
  base::Loop loop{{.unpaced = true}};
  map::LiveMap map{[this] { return loop.utc_now(); }};
  FakeExporter exporter{loop};
  ExportJobs jobs{loop, exporter, {.kept_for = 60s, .most_bytes = 1000}};

  void SetUp() override {
    map.put_site(geo::Site::make("yard", geo::Wgs84::from_degrees(41.0, -8.0), {{.id = "1"}}).value());
  }
  HttpResponse ask(std::string const& method, std::string const& path, std::string body = {}, bool has_jobs = true) {
    Router router;
    add_export_routes(router, loop, map, has_jobs ? &jobs : nullptr);
    auto request = request_for(method, "/api/v1/exports" + path).value();
    request.body = std::move(body);
    auto reply = router.answer(request);
    if (auto* const response = std::get_if<HttpResponse>(&reply)) return *response;
    return loop.run_until_done(std::get<base::Task<HttpResponse>>(std::move(reply)));
  }
  json post(std::string body = R"({"format":"kml"})") { return json::parse(ask("POST", "", std::move(body)).body); }
  json state_of(json const& job) { return json::parse(ask("GET", "/" + job["id"].get<std::string>()).body); }
  HttpResponse file_of(json const& job) { return ask("GET", "/" + job["id"].get<std::string>() + "/file"); }
  void wait(base::Duration duration) {
    loop.run_until_done(
        [](base::Loop& on, base::Duration time) -> base::Task<> { co_await on.sleep(time); }(loop, duration));
  }
};

TEST_F(ExportRoutes, TellWhatCanBeWritten) {
  auto const told = json::parse(ask("GET", "").body);
  EXPECT_EQ(told["available"], true);
  EXPECT_EQ(told["formats"][0]["name"], "kml");
  exporter.is_missing = true;
  auto const missing = json::parse(ask("GET", "").body);
  EXPECT_EQ(missing["available"], false);
  EXPECT_EQ(missing["reason"], "lapwing-map is not there");
  EXPECT_EQ(missing["hint"], "build it");
  EXPECT_EQ(ask("POST", "", R"({"format":"kml"})").status, 503);
  EXPECT_EQ(json::parse(ask("GET", "", {}, false).body)["available"], false);
  EXPECT_EQ(ask("POST", "", R"({"format":"kml"})", false).status, 503);
}

TEST_F(ExportRoutes, WriteAFileThatCanBeFetched) {
  exporter.may_end = false;
  auto const accepted = ask("POST", "", R"({"format":"kml","layers":["slots"],"site":"yard","floor":"1",
                                            "within_deg":[-9,40,-7,42],"scale":50})");
  ASSERT_EQ(accepted.status, 202) << accepted.body;
  auto const job = json::parse(accepted.body);
  EXPECT_EQ(accepted.headers[0].value, "/api/v1/exports/" + job["id"].get<std::string>());
  EXPECT_EQ(state_of(job)["state"], "running");
  EXPECT_EQ(state_of(job)["progress"], 0.5);
  EXPECT_EQ(file_of(job).status, 409);
  exporter.may_end = true;
  exporter.go.notify_all();
  wait(1s);
  EXPECT_EQ(state_of(job)["state"], "done");
  EXPECT_EQ(state_of(job)["bytes"], 6);
  auto const file = file_of(job);
  EXPECT_EQ(file.status, 200);
  EXPECT_EQ(file.body, "<kml/>");
  EXPECT_EQ(file.content_type, "application/vnd.google-earth.kml+xml");
  EXPECT_NE(file.headers[0].value.find("attachment; filename=\"lapwing-kml-"), std::string::npos);
  auto const& wish = exporter.wishes.at(0);
  EXPECT_EQ(wish.layers, std::vector<std::string>({"slots"}));
  EXPECT_EQ(wish.floor, "1");
  EXPECT_EQ(wish.within_deg->at(2), -7.0);
  EXPECT_EQ(wish.scale, 50.0);
}

TEST_F(ExportRoutes, MistakesAreTold) {
  for (auto const* body :
       {"{", R"({})", R"({"format":"dwg"})", R"({"format":"kml","layers":["trees"]})", R"({"format":"kml","layers":7})",
        R"({"format":"kml","site":"else"})", R"({"format":"kml","site":"yard","floor":"9"})",
        R"({"format":"kml","floor":"1"})", R"({"format":"kml","within_deg":[1,2,3]})",
        R"({"format":"kml","within_deg":[1,2,3,"4"]})", R"({"format":"kml","within_deg":[1,50,2,40]})",
        R"({"format":"kml","within_deg":[1,50,2,1e400]})", R"({"format":"kml","scale":0})"})
    EXPECT_EQ(ask("POST", "", body).status, 400) << body;
  EXPECT_TRUE(exporter.wishes.empty());
  for (auto const* path : {"/none", "/none/file"}) EXPECT_EQ(ask("GET", path).status, 404);
  EXPECT_EQ(ask("DELETE", "/none").status, 404);
  exporter.fault = "there is nothing in the map that kml holds";
  auto const job = post();
  EXPECT_EQ(state_of(job)["state"], "failed");
  EXPECT_EQ(state_of(job)["reason"], exporter.fault);
  EXPECT_EQ(state_of(job)["hint"], "choose more");
  EXPECT_EQ(file_of(job).status, 400);
}

TEST_F(ExportRoutes, AreNeverMany) {
  exporter.may_end = false;
  auto const first = post();
  auto const second = post();
  auto const refused = ask("POST", "", R"({"format":"kml"})");
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(ask("DELETE", "/" + first["id"].get<std::string>()).status, 204);
  EXPECT_EQ(ask("GET", "/" + first["id"].get<std::string>()).status, 404);
  EXPECT_EQ(ask("POST", "", R"({"format":"kml"})").status, 202) << "one was stopped";
  exporter.may_end = true;
  exporter.go.notify_all();
  wait(1s);
  EXPECT_EQ(state_of(second)["state"], "done");
  json newest;
  for (int i = 0; i < 10; ++i) {
    newest = post();
    wait(1s);
  }
  EXPECT_EQ(ask("GET", "/" + second["id"].get<std::string>()).status, 404) << "the oldest went";
  auto const file = jobs.file_of(*jobs.find(newest["id"]));
  EXPECT_TRUE(std::filesystem::exists(file));
  wait(61s);
  EXPECT_EQ(state_of(newest)["status"], 404) << "nobody has fetched it";
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(ExportRoutes, FilesThatAreTooLargeGo) {
  exporter.content = std::string(1001, 'x');
  auto const job = post();
  EXPECT_EQ(state_of(job)["state"], "failed");
  EXPECT_NE(state_of(job)["hint"].get<std::string>().find("lapwing store export"), std::string::npos);
}

TEST_F(ExportRoutes, NothingStaysWhenTheStationEnds) {
  std::filesystem::path file;
  {
    ExportJobs own(loop, exporter);
    auto const job = own.start({.format = "kml"}, ".kml").value();
    file = own.file_of(*own.find(job.id));
    EXPECT_TRUE(std::filesystem::exists(file));
  }
  EXPECT_FALSE(std::filesystem::exists(file.parent_path()));
}

}  // namespace
}  // namespace lapwing::station
