#include "apps/stream/whep_routes.hpp"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

namespace lapwing::apps {

using station::HttpRequest;
using station::HttpResponse;
using station::problem;

namespace {

constexpr auto sdp = "application/sdp";
constexpr int created = 201;
constexpr int bad_request = 400;
constexpr int not_found = 404;
constexpr int unprocessable = 422;
constexpr int wrong_type = 415;
constexpr int unavailable = 503;

HttpResponse full() {
  auto response = problem(unavailable, "as many look at the camera as it allows", "[webrtc] most_viewers allows more");
  response.headers.push_back({"Retry-After", "10"});
  return response;
}

base::Task<HttpResponse> begin(video::WebRtcServer& server, std::size_t view, std::string name, video::Offer offer,
                               base::Logger const& log) {
  auto beginning = server.begin(view, std::move(offer));
  auto const session = co_await beginning;
  if (!session) {
    log.warn(fmt::format("{} over WebRTC: {}", name, session.error().message));
    co_return problem(unavailable, session.error().message, session.error().hint);
  }
  co_return HttpResponse{.status = created,
                         .content_type = sdp,
                         .body = session->answer,
                         .headers = {{"Location", "/api/v1/whep/sessions/" + session->id}}};
}

}  // namespace

station::Router whep_routes(video::WebRtcServer& server, std::vector<std::string> const& views,
                            base::Logger const& log) {
  station::Router router;
  for (std::size_t view = 0; view < views.size(); ++view) {
    auto const& name = views.at(view);
    auto const answer = [&server, &log, view, name](HttpRequest const& request,
                                                    station::PathArguments const&) -> station::Reply {
      if (!station::equal_ignoring_case(station::media_type(request.header("Content-Type")), sdp))
        return problem(wrong_type, "an offer is SDP", "Content-Type: application/sdp");
      auto offer = video::read_offer(request.body);
      if (!offer)
        return problem(offer.error().kind == base::ErrorKind::refused ? unprocessable : bad_request,
                       offer.error().message, offer.error().hint);
      if (server.is_full()) return full();
      return begin(server, view, name, *std::move(offer), log);
    };
    router.add("POST", "/api/v1/whep/" + name, answer, video::largest_offer);
  }
  router.add("DELETE", "/api/v1/whep/sessions/{session}",
             [&server](HttpRequest const&, station::PathArguments const& path) -> station::Reply {
               if (server.end(path["session"])) return HttpResponse{.body = "{}"};
               return problem(not_found, "there is no such session: it may be over");
             });
  return router;
}

}  // namespace lapwing::apps
