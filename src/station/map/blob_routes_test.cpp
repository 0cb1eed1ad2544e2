#include "station/map/blob_routes.hpp"

#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/async/loop.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;

/// Keeps them in memory, under hashes that it is told.
class FakeBlobs : public map::PictureStore {
 public:
  base::Task<base::Result<std::string>> keep(std::string bytes, std::string media_type) override {
    if (is_full) co_return base::fail(base::ErrorKind::refused, "the disk is full", "make room");
    blobs[next] = {std::move(bytes), std::move(media_type)};
    co_return next;
  }
  base::Task<base::Result<Blob>> blob(std::string hash) override {
    if (!blobs.contains(hash)) co_return base::fail(base::ErrorKind::not_found, "no such picture");
    co_return blobs[hash];
  }
  std::map<std::string, Blob> blobs;
  std::string next = std::string(64, 'a');
  bool is_full = false;
};

struct BlobRoutes : ::testing::Test {
  BlobRoutes() { add_blob_routes(router, &blobs); }
  HttpResponse answer(HttpRequest const& request) {
    auto reply = router.answer(request);
    if (auto* const response = std::get_if<HttpResponse>(&reply)) return *response;
    return loop.run_until_done(std::get<base::Task<HttpResponse>>(std::move(reply)));
  }
  HttpResponse get(std::string const& hash, std::vector<HttpHeader> headers = {}) {
    auto request = request_for("GET", "/api/v1/blobs/" + hash).value();
    request.headers = std::move(headers);
    return answer(request);
  }
  HttpResponse post(std::string type, std::string bytes) {
    auto request = request_for("POST", "/api/v1/blobs").value();
    request.headers = {{"Content-Type", std::move(type)}};
    request.body = std::move(bytes);
    return answer(request);
  }
  static std::string header(HttpResponse const& response, std::string_view name) {
    for (auto const& one : response.headers)
      if (one.name == name) return one.value;
    return "";
  }

  base::Loop loop;
  FakeBlobs blobs;
  Router router;
  std::string const jpeg = "\xFF\xD8\xFF\xE0 a picture";
};

TEST_F(BlobRoutes, KeepAPictureAndShowIt) {
  auto const kept = post("image/jpeg", jpeg);
  EXPECT_EQ(kept.status, 201);
  auto const hash = json::parse(kept.body)["sha256"].get<std::string>();
  EXPECT_EQ(header(kept, "Location"), "/api/v1/blobs/" + hash);
  auto const shown = get(hash);
  EXPECT_EQ(shown.status, 200);
  EXPECT_EQ(shown.body, jpeg);
  EXPECT_EQ(shown.content_type, "image/jpeg");
  EXPECT_EQ(header(shown, "Cache-Control"), "private, max-age=31536000, immutable");
  EXPECT_EQ(get(hash, {{"If-None-Match", header(shown, "ETag")}}).status, 304);
}

TEST_F(BlobRoutes, TakePicturesOnly) {
  EXPECT_EQ(post("text/html", "<script>").status, 415);
  EXPECT_EQ(post("image/svg+xml", "<svg/>").status, 415);
  EXPECT_EQ(post("image/jpeg", "<script>").status, 422) << "what it is called is not enough";
  EXPECT_EQ(post("image/webp", "RIFF").status, 422);
  EXPECT_EQ(post("image/webp", "RIFF\x01\x01\x01\x01WEBPVP8 ").status, 201);
  EXPECT_EQ(blobs.blobs.size(), 1U);
}

TEST_F(BlobRoutes, ServeNothingThatABrowserWouldRun) {
  blobs.blobs[blobs.next] = {"<script>", "text/html"};
  auto const shown = get(blobs.next);
  EXPECT_EQ(shown.content_type, "application/octet-stream");
  EXPECT_EQ(header(shown, "Content-Disposition"), "attachment");
}

TEST_F(BlobRoutes, SayWhatIsWrong) {
  EXPECT_EQ(get(std::string(64, 'b')).status, 404);
  EXPECT_EQ(get("..%2F..%2Fetc%2Fpasswd").status, 404);
  blobs.is_full = true;
  EXPECT_EQ(post("image/jpeg", jpeg).status, 507);
  Router without;
  add_blob_routes(without, nullptr);
  EXPECT_EQ(std::get<HttpResponse>(without.answer(request_for("GET", "/api/v1/blobs/x").value())).status, 409);
}

}  // namespace
}  // namespace lapwing::station
