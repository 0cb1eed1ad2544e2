#include "station/past/history_routes.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/time.hpp"
#include "station/messages/feed_json.hpp"
#include "station/past/moment_words.hpp"

namespace lapwing::station {

namespace {

using map::Store;

constexpr std::size_t most_frames = 5000;
/// Of an answer: beyond it a slow page would wait for long before it can show anything.
constexpr std::size_t most_bytes = std::size_t{8} * 1024 * 1024;
/// A message is JSON text already: parsing it to write it again would cost more than all the rest.
std::string frame_text(Store::Shown const& shown) {
  return fmt::format(R"({{"at_ms":{},"feed":{},"whole":{},"message":{}}})", milliseconds_of(shown.at), dump(shown.feed),
                     shown.is_whole, shown.content);
}

/// Some frames as JSON, those of one time together, and the time before which none is missing.
struct Part {
  std::string text;
  base::UtcTime complete_to;
};

/// As many moments as fit into an answer, but one at least: a page that asks again must get on.
Part part_of(std::vector<Store::Shown> const& frames, base::UtcTime complete_to) {
  Part part{.text = {}, .complete_to = complete_to};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    bool const begins_moment = i == 0 || frames[i].at != frames[i - 1].at;
    if (begins_moment && part.text.size() > most_bytes) {
      part.complete_to = frames[i].at;
      break;
    }
    if (frames[i].is_binary) continue;
    if (!part.text.empty()) part.text += ',';
    part.text += frame_text(frames[i]);
  }
  return part;
}

base::Task<HttpResponse> list_sessions(Store& store) {
  auto sessions = co_await store.sessions();
  if (!sessions) co_return problem(sessions.error());
  std::ranges::sort(*sessions, std::greater{}, &Store::Session::began);
  Json list = Json::array();
  for (auto const& session : *sessions) {
    list.push_back({{"id", session.id},
                    {"name", session.name},
                    {"began_ms", milliseconds_of(session.began)},
                    {"ended_ms", milliseconds_of(session.ended)}});
  }
  co_return HttpResponse{.body = dump({{"sessions", std::move(list)}})};
}

base::Task<HttpResponse> state(Store& store, std::string session, base::UtcTime at) {
  auto frames = co_await store.state_at(std::move(session), at);
  if (!frames) co_return problem(frames.error());
  std::string text;
  for (auto const& shown : *frames) {
    if (shown.is_binary) continue;
    if (!text.empty()) text += ',';
    text += frame_text(shown);
  }
  co_return HttpResponse{.body = fmt::format(R"({{"at_ms":{},"frames":[{}]}})", milliseconds_of(at), text)};
}

base::Task<HttpResponse> frames(Store& store, std::string session, base::UtcTime from, base::UtcTime to) {
  auto const found = co_await store.shown(std::move(session), from, to, most_frames);
  if (!found) co_return problem(found.error());
  bool const is_all = found->size() < most_frames;
  auto const part = part_of(*found, is_all ? to : found->back().at + std::chrono::milliseconds(1));
  co_return HttpResponse{
      .body = fmt::format(R"({{"complete_to_ms":{},"frames":[{}]}})", milliseconds_of(part.complete_to), part.text)};
}

}  // namespace

void add_history_routes(Router& router, Store* store) {
  router.add("GET", "/api/v1/history", [store](HttpRequest const&) -> Reply {
    if (!store) return no_history();
    return list_sessions(*store);
  });
  router.add("GET", "/api/v1/history/{session}/state",
             [store](HttpRequest const& request, PathArguments const& path) -> Reply {
               if (!store) return no_history();
               auto const at = time_parameter(request, "at_ms");
               if (!at) return problem(at.error());
               return state(*store, path["session"], *at);
             });
  router.add("GET", "/api/v1/history/{session}/frames",
             [store](HttpRequest const& request, PathArguments const& path) -> Reply {
               if (!store) return no_history();
               auto const from = time_parameter(request, "from_ms");
               if (!from) return problem(from.error());
               auto const to = time_parameter(request, "to_ms");
               if (!to) return problem(to.error());
               if (*to <= *from) return problem(400, "\"to_ms\" is not later than \"from_ms\".");
               return frames(*store, path["session"], *from, *to);
             });
}

}  // namespace lapwing::station
