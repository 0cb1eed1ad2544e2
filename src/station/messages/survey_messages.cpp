#include "station/messages/survey_messages.hpp"

#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "geo/position_json.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

Json to_json(vehicle::SurveyDroneView const& drone) {
  Json json{{"name", drone.name}, {"connected", drone.is_connected}};
  if (!drone.trouble.empty()) json["trouble"] = drone.trouble;
  json["words"] = Json::array();
  for (auto const& [at, text] : drone.words) json["words"].push_back({{"at", base::to_iso8601(at)}, {"text", text}});
  if (drone.state.empty()) return json;
  json["state"] = drone.state;
  if (!drone.mode.empty()) json["mode"] = drone.mode;
  json["armed"] = drone.is_armed;
  json["healthy"] = drone.is_healthy;
  if (!drone.health_reason.empty()) json["health_reason"] = drone.health_reason;
  if (!drone.user_error.empty()) json["user_error"] = drone.user_error;
  if (drone.height_m) json["height_m"] = rounded(*drone.height_m, 2);
  if (drone.battery) json["battery"] = rounded(*drone.battery, 3);
  if (drone.position)
    json["position"] = {{"lat_deg", rounded(drone.position->lat_deg(), 8)},
                        {"lon_deg", rounded(drone.position->lon_deg(), 8)}};
  if (drone.coverage) json["coverage"] = rounded(*drone.coverage, 3);
  if (auto const& slots = drone.slots)
    json["slots"] = {{"free", slots->free}, {"taken", slots->taken}, {"unknown", slots->unknown}};
  return json;
}

}  // namespace

std::string survey_message(std::vector<vehicle::SurveyDroneView> const& drones) {
  Json list = Json::array();
  for (auto const& drone : drones) list.push_back(to_json(drone));
  return dump({{"type", "survey"}, {"drones", std::move(list)}});
}

namespace {

HttpResponse no_drones() {
  return problem(404, "this station has no survey drones", "start it with --survey HOST:PORT");
}

/// The delay is told by whoever's clocks there are: the drone's when the light fell in, the station's when it answers.
HttpResponse answer_with(vehicle::DronePicture const& picture, base::UtcTime now) {
  auto const age = std::chrono::round<std::chrono::milliseconds>(now - picture.taken);
  return {.content_type = "image/jpeg",
          .body = *picture.jpeg,
          .headers = {{"Lapwing-Taken", base::to_iso8601(picture.taken)},
                      {"Lapwing-Age-Ms", std::to_string(age.count())},
                      {"Lapwing-Number", std::to_string(picture.number)}}};
}

base::Task<HttpResponse> picture_of(vehicle::SurveyDrones& drones, std::string drone, vehicle::PictureView view,
                                    std::uint64_t after, std::function<base::UtcTime()> now) {
  auto asking = drones.picture(std::move(drone), view, after);
  auto const picture = co_await asking;
  co_return picture ? answer_with(*picture, now()) : problem(picture.error());
}

std::optional<vehicle::PictureView> view_of(HttpRequest const& request) {
  auto const view = request.parameter("view").value_or("annotated");
  if (view == "raw") return vehicle::PictureView::raw;
  return view == "annotated" ? std::optional(vehicle::PictureView::annotated) : std::nullopt;
}

HttpResponse no_view() {
  return problem(400, "there is no such view", "view=raw or view=annotated");
}

Reply give_picture(vehicle::SurveyDrones& drones, HttpRequest const& request, std::string const& drone,
                   std::function<base::UtcTime()> const& now) {
  auto const view = view_of(request);
  if (!view) return no_view();
  auto const text = request.parameter("after").value_or("0");
  std::uint64_t after = 0;
  auto const [end, fault] = std::from_chars(text.data(), text.data() + text.size(), after);
  if (fault != std::errc{} || end != text.data() + text.size())
    return problem(400, "after is the Lapwing-Number of the picture that you have");
  return picture_of(drones, drone, *view, after, now);
}

constexpr std::string_view sdp = "application/sdp";
/// A browser's offer has some 10 kB.
constexpr std::size_t largest_offer = std::size_t{64} * 1024;

/// Where the drone's video goes from here on is between it and the viewer; the delay is told by the station's clock, as
/// that of single pictures is.
base::Task<HttpResponse> video_of(vehicle::SurveyDrones& drones, std::string drone, vehicle::PictureView view,
                                  std::string offer, std::function<base::UtcTime()> now) {
  auto asking = drones.video(drone, view, std::move(offer));
  auto const video = co_await asking;
  if (!video) co_return problem(video.error());
  auto const now_ms = std::chrono::round<std::chrono::milliseconds>(now()).time_since_epoch().count();
  auto const session = fmt::format("/api/v1/survey/{}/video/{}", percent_encoded(drone), video->session);
  co_return HttpResponse{.status = 201,
                         .content_type = std::string(sdp),
                         .body = video->answer,
                         .headers = {{"Location", session}, {"Lapwing-Now-Ms", std::to_string(now_ms)}}};
}

Reply give_video(vehicle::SurveyDrones& drones, HttpRequest const& request, std::string const& drone,
                 std::function<base::UtcTime()> const& now) {
  auto const view = view_of(request);
  if (!view) return no_view();
  if (!equal_ignoring_case(media_type(request.header("Content-Type")), sdp))
    return problem(415, "an offer is SDP", "Content-Type: application/sdp");
  return video_of(drones, drone, *view, request.body, now);
}

base::Task<HttpResponse> end_video(vehicle::SurveyDrones& drones, std::string drone, std::string session) {
  auto asking = drones.end_video(std::move(drone), std::move(session));
  auto const ended = co_await asking;
  co_return ended ? HttpResponse{.body = "{}"} : problem(ended.error());
}

}  // namespace

void add_survey_routes(Router& router, vehicle::SurveyDrones* drones, base::Logger const& log,
                       std::function<base::UtcTime()> now) {
  router.add("GET", "/api/v1/survey", [drones](HttpRequest const&) {
    return HttpResponse{.body = survey_message(drones ? drones->drones() : std::vector<vehicle::SurveyDroneView>())};
  });
  router.add(
      "POST", "/api/v1/survey/{drone}/video",
      [drones, now](HttpRequest const& request, PathArguments const& path) -> Reply {
        return drones ? give_video(*drones, request, path["drone"], now) : Reply(no_drones());
      },
      largest_offer);
  router.add("DELETE", "/api/v1/survey/{drone}/video/{session}",
             [drones](HttpRequest const&, PathArguments const& path) -> Reply {
               return drones ? end_video(*drones, path["drone"], path["session"]) : Reply(no_drones());
             });
  router.add("GET", "/api/v1/survey/{drone}/picture",
             [drones, now = std::move(now)](HttpRequest const& request, PathArguments const& path) -> Reply {
               return drones ? give_picture(*drones, request, path["drone"], now) : Reply(no_drones());
             });
  router.add("POST", "/api/v1/survey/{drone}/commands",
             [drones, &log](HttpRequest const& request, PathArguments const& path) -> Reply {
               auto const& drone = path["drone"];
               if (!drones) return no_drones();
               if (auto const sent = drones->command(drone, request.body); !sent) return problem(sent.error());
               log.info(fmt::format("a command for {} asked for over HTTP", drone));
               return HttpResponse{.status = 202, .body = "{}"};
             });
}

}  // namespace lapwing::station
