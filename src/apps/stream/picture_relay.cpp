#include "apps/stream/picture_relay.hpp"

#include <utility>

#include <fmt/format.h>

#include "base/async/pool.hpp"

namespace lapwing::apps {

using namespace std::chrono_literals;
using link::pictures::PictureClient;

namespace {

constexpr base::Duration patience = 2s;
constexpr base::Duration try_again_after = 1s;

}  // namespace

std::vector<std::string> relayed_paths() {
  std::vector<std::string> paths;
  for (auto const view : relayed_views) {
    std::string_view const mjpeg = link::pictures::path_of(view);
    paths.emplace_back(mjpeg.substr(0, mjpeg.find('.')));
  }
  return paths;
}

PictureRelay::PictureRelay(base::Loop& loop, video::RtspServer& server, link::pictures::Source source, base::Logger log)
    : loop_(loop), server_(server), source_(std::move(source)), log_(std::move(log)), scope_(loop) {
  for (std::size_t path = 0; path < relayed_views.size(); ++path) scope_.spawn(serve(path));
}

base::Task<> PictureRelay::serve(std::size_t path) {
  for (;;) {
    while (!server_.is_watched(path)) co_await server_.watching_changed().wait();
    auto const pictures = PictureClient::open(loop_, source_, relayed_views.at(path));
    if (!pictures) {
      note(path, pictures.error().message);
      co_await loop_.sleep(try_again_after);
      continue;
    }
    auto handing = hand_on(path, **pictures);
    co_await handing;
  }
}

base::Task<> PictureRelay::hand_on(std::size_t path, PictureClient& pictures) {
  for (std::uint64_t last = 0; server_.is_watched(path);) {
    auto asking = pictures.next(last, patience);
    auto const next = co_await asking;
    if (!next) {
      note(path, next.error().message);
      continue;
    }
    last = next->number;
    auto picture = co_await loop_.on_pool(
        [](std::shared_ptr<std::string const> const& jpeg) { return video::read_jpeg(*jpeg); }, next->picture.jpeg);
    note(path, picture ? std::string() : picture.error().message);
    if (picture) server_.offer(path, *std::move(picture));
  }
}

void PictureRelay::note(std::size_t path, std::string const& fault) {
  auto& told = faults_.at(path);
  if (fault == told) return;
  auto const view = relayed_paths().at(path);
  if (fault.empty())
    log_.info(fmt::format("{}: pictures come again", view));
  else
    log_.warn(fmt::format("{}: {}", view, fault));
  told = fault;
}

}  // namespace lapwing::apps
