#include "station/http/http.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/testing/temporary_folder.hpp"
#include "station/http/router.hpp"
#include "station/http/static_files.hpp"

namespace lapwing::station {
namespace {

namespace fs = std::filesystem;

TEST(Http, DecodesPercentEscapes) {
  EXPECT_EQ(percent_decoded("/a%20b%C3%A4"), "/a b\xC3\xA4");
  EXPECT_EQ(percent_decoded("plain"), "plain");
  for (auto const* bad : {"%", "%4", "%zz", "a%2", "%-1", "%+1"}) EXPECT_FALSE(percent_decoded(bad)) << bad;
}

TEST(Http, FindsHeadersInAnyCase) {
  HttpRequest const request{.method = "GET", .path = "/", .query = {}, .headers = {{"Content-TYPE", "a"}}, .body = {}};
  EXPECT_EQ(request.header("content-type"), "a");
  EXPECT_EQ(request.header("content"), "");
}

TEST(Http, FindsQueryParameters) {
  HttpRequest const request{
      .method = "GET", .path = "/", .query = "x=1&after=12&empty&bad=%z", .headers = {}, .body = {}};
  EXPECT_EQ(request.parameter("after"), "12");
  EXPECT_EQ(request.parameter("empty"), "");
  EXPECT_FALSE(request.parameter("bad"));
  EXPECT_FALSE(request.parameter("fter"));
}

TEST(Http, DescribesProblems) {
  auto const response = problem(404, "bytes \xff and \"quotes\"", "look elsewhere");
  EXPECT_EQ(response.status, 404);
  EXPECT_EQ(response.content_type, "application/problem+json");
  auto const body = nlohmann::json::parse(response.body);
  EXPECT_EQ(body["title"], "Not Found");
  EXPECT_EQ(body["detail"], "bytes \xEF\xBF\xBD and \"quotes\"");
  EXPECT_EQ(body["hint"], "look elsewhere");
}

TEST(Router, AnswersByMethodAndPath) {
  Router router;
  auto const answer = [&router](HttpRequest const& request) { return std::get<HttpResponse>(router.answer(request)); };
  router.add("GET", "/a", [](auto const&) { return HttpResponse{.body = "got"}; });
  router.add("POST", "/a", [](auto const& request) { return HttpResponse{.body = request.body}; });
  EXPECT_EQ(answer({.method = "GET", .path = "/a"}).body, "got");
  EXPECT_EQ(answer({.method = "HEAD", .path = "/a"}).body, "got");
  EXPECT_EQ(answer({.method = "POST", .path = "/a", .query = {}, .headers = {}, .body = "x"}).body, "x");
  EXPECT_EQ(answer({.method = "GET", .path = "/b"}).status, 404);
  auto const wrong_method = answer({.method = "DELETE", .path = "/a"});
  EXPECT_EQ(wrong_method.status, 405);
  EXPECT_EQ(wrong_method.headers.at(0).value, "GET, HEAD, POST");
}

TEST(Router, FindsWhatPathsName) {
  Router router;
  router.add("GET", "/layers/{layer}/features/{id}", [](HttpRequest const&, PathArguments const& arguments) {
    return HttpResponse{.body = arguments["layer"] + "|" + arguments["id"]};
  });
  router.add("GET", "/tiles/{z}/{y}.png",
             [](HttpRequest const&, PathArguments const& arguments) { return HttpResponse{.body = arguments["y"]}; });
  auto const get = [&](std::string_view target) {
    return std::get<HttpResponse>(router.answer(request_for("GET", target).value()));
  };
  EXPECT_EQ(get("/layers/slots/features/7?x=/y").body, "slots|7");
  EXPECT_EQ(get("/layers/slots/features/north%2F1").body, "slots|north/1") << "an id with a slash is one part";
  EXPECT_EQ(get("/layers/slots/features/north/1").status, 404);
  EXPECT_EQ(get("/layers/slots/features/").status, 404) << "a name is never empty";
  EXPECT_EQ(get("/layers/slots/features").status, 404);
  EXPECT_EQ(get("/layers%2Fslots/features/7").status, 404);
  EXPECT_EQ(get("/tiles/3/17.png").body, "17");
  EXPECT_EQ(get("/tiles/3/.png").status, 404);
  EXPECT_EQ(get("/tiles/3/17.jpg").status, 404);
  EXPECT_TRUE(router.knows(*request_for("POST", "/tiles/3/17.png")));
  EXPECT_EQ(std::get<HttpResponse>(router.answer(*request_for("PUT", "/tiles/3/17.png"))).status, 405);
}

struct StaticFiles : ::testing::Test {
  StaticFiles() {
    fs::create_directories(root / "assets");
    write(root / "index.html", "<html>");
    write(root / "assets/app-1a2b.js", "script");
    write(root / ".hidden", "secret");
    write(parent / "outside.txt", "secret");
    fs::create_symlink(parent / "outside.txt", root / "link.txt");
  }
  static void write(fs::path const& file, std::string_view text) { std::ofstream(file) << text; }
  [[nodiscard]] HttpResponse get(std::string path, std::vector<HttpHeader> headers = {}) const {
    return static_file(
        root, {.method = "GET", .path = std::move(path), .query = {}, .headers = std::move(headers), .body = {}});
  }

  base::testing::TemporaryFolder temporary;
  fs::path const parent = temporary.path();
  fs::path const root = parent / "dist";
};

TEST_F(StaticFiles, ServesTheIndexToBeAskedForAnew) {
  auto const response = get("/");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.body, "<html>");
  EXPECT_EQ(response.content_type, "text/html; charset=utf-8");
  EXPECT_EQ(response.headers.at(1).value, "no-cache");
}

TEST_F(StaticFiles, LetsBrowsersKeepHashedAssets) {
  auto const response = get("/assets/app-1a2b.js");
  EXPECT_EQ(response.content_type, "text/javascript; charset=utf-8");
  EXPECT_EQ(response.headers.at(1).value, "public, max-age=31536000, immutable");
}

TEST_F(StaticFiles, SendsNothingThatTheBrowserHas) {
  auto const tag = get("/").headers.at(0).value;
  auto const again = get("/", {{"If-None-Match", tag}});
  EXPECT_EQ(again.status, 304);
  EXPECT_EQ(again.body, "");
  write(root / "index.html", "<html>longer");
  EXPECT_EQ(get("/", {{"If-None-Match", tag}}).status, 200);
}

TEST_F(StaticFiles, NeverLeavesItsFolder) {
  using namespace std::string_literals;
  for (auto const& path : {"/../outside.txt"s, "/assets/../../outside.txt"s, "//etc/passwd"s, "/.hidden"s, "/link.txt"s,
                           "/assets"s, "/..\\outside.txt"s, "/index.html\0.js"s, "/none"s, "/./index.html"s}) {
    auto const response = get(path);
    EXPECT_EQ(response.status, 404) << path;
    EXPECT_EQ(response.body.find("secret"), std::string::npos);
  }
}

TEST_F(StaticFiles, AnswersWithoutAFolder) {
  EXPECT_EQ(static_file("/no/such/folder", {.method = "GET", .path = "/"}).status, 404);
}

}  // namespace
}  // namespace lapwing::station
