#include "station/map/blob_routes.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

using namespace std::string_view_literals;

/// What a picture of that kind begins with, so that nothing else is served under its name.
struct PictureKind {
  std::string_view media_type;
  std::string_view begins;
  std::string_view further;  ///< what stands at `at`; empty: anything
  std::size_t at = 0;
};
constexpr std::array picture_kinds = {
    PictureKind{"image/jpeg", "\xFF\xD8\xFF"sv, ""},
    PictureKind{"image/png", "\x89PNG\r\n\x1A\n"sv, ""},
    PictureKind{"image/webp", "RIFF"sv, "WEBP", 8},
};

PictureKind const* kind_named(std::string_view type) {
  auto const* const found =
      std::ranges::find_if(picture_kinds, [&](auto const& kind) { return equal_ignoring_case(kind.media_type, type); });
  return found == picture_kinds.end() ? nullptr : found;
}

bool is_of_kind(std::string_view bytes, PictureKind const& kind) {
  return bytes.starts_with(kind.begins) &&
         (kind.further.empty() || (bytes.size() > kind.at && bytes.substr(kind.at).starts_with(kind.further)));
}

bool is_hash(std::string_view text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

HttpResponse no_pictures() {
  return problem(409, "This station keeps no pictures.", "Start it with --store FOLDER.");
}

base::Task<HttpResponse> keep(map::PictureStore& blobs, std::string bytes, std::string media_type) {
  auto const hash = co_await blobs.keep(std::move(bytes), std::move(media_type));
  if (!hash && hash.error().kind == base::ErrorKind::refused)
    co_return problem(507, hash.error().message, hash.error().hint);
  if (!hash) co_return problem(hash.error());
  Json const body{{"sha256", *hash}};
  HttpResponse response{.status = 201, .body = dump(body)};
  response.headers.push_back({"Location", fmt::format("/api/v1/blobs/{}", *hash)});
  co_return response;
}

base::Task<HttpResponse> show(map::PictureStore& blobs, std::string hash) {
  auto tag = fmt::format("\"{}\"", hash);
  auto blob = co_await blobs.blob(std::move(hash));
  if (!blob) co_return problem(blob.error());
  // Whatever else has come to lie in the store, a browser shall take for nothing that it could run.
  auto const* const kind = kind_named(media_type(blob->media_type));
  HttpResponse response{.content_type = std::string(kind ? kind->media_type : "application/octet-stream"),
                        .body = std::move(blob->bytes)};
  response.headers.push_back({"ETag", std::move(tag)});
  response.headers.push_back({"Cache-Control", "private, max-age=31536000, immutable"});
  if (!kind) response.headers.push_back({"Content-Disposition", "attachment"});
  co_return response;
}

}  // namespace

void add_blob_routes(Router& router, map::PictureStore* blobs) {
  router.add("GET", "/api/v1/blobs/{sha256}",
             [blobs](HttpRequest const& request, PathArguments const& arguments) -> Reply {
               if (!blobs) return no_pictures();
               auto const& hash = arguments["sha256"];
               if (!is_hash(hash)) return problem(404, "This is no hash: 64 digits of SHA-256, in small letters.");
               // By its hash it never changes: who has it need not be sent it.
               if (request.header("If-None-Match") == fmt::format("\"{}\"", hash)) return HttpResponse{304, "", "", {}};
               return show(*blobs, hash);
             });
  router.add(
      "POST", "/api/v1/blobs",
      [blobs](HttpRequest const& request, PathArguments const&) -> Reply {
        if (!blobs) return no_pictures();
        auto const* const kind = kind_named(media_type(request.header("Content-Type")));
        if (!kind)
          return problem(415, "A picture is image/jpeg, image/png or image/webp.", "Say which as Content-Type.");
        if (!is_of_kind(request.body, *kind))
          return problem(422, fmt::format("These bytes are no picture of type {}.", kind->media_type));
        return keep(*blobs, request.body, std::string(kind->media_type));
      },
      max_picture_bytes);
}

}  // namespace lapwing::station
