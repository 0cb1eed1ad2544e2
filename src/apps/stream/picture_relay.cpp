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

std::vector<std::string> view_names() {
  auto names = relayed_paths();
  for (auto& name : names) name.erase(0, 1);
  return names;
}

PictureRelay::PictureRelay(base::Loop& loop, Outlets outlets, link::pictures::Source source, base::Logger log)
    : loop_(loop), outlets_(outlets), changed_(loop), source_(std::move(source)), log_(std::move(log)), scope_(loop) {
  if (outlets_.rtsp != nullptr) scope_.spawn(pass_on_changes(*outlets_.rtsp));
  if (outlets_.webrtc != nullptr) scope_.spawn(pass_on_changes(*outlets_.webrtc));
  for (std::size_t path = 0; path < relayed_views.size(); ++path) scope_.spawn(serve(path));
}

template <class Server>
base::Task<> PictureRelay::pass_on_changes(Server& server) {
  for (;;) {
    co_await server.watching_changed().wait();
    changed_.notify_all();
  }
}

bool PictureRelay::is_watched(std::size_t path) const {
  return (outlets_.rtsp != nullptr && outlets_.rtsp->is_watched(path)) ||
         (outlets_.webrtc != nullptr && outlets_.webrtc->is_watched(path));
}

void PictureRelay::show(std::size_t path, video::RawPicture const& picture, base::UtcTime taken) {
  if (outlets_.rtsp != nullptr) outlets_.rtsp->offer(path, picture);
  if (outlets_.webrtc != nullptr) outlets_.webrtc->show(path, picture, taken);
}

base::Task<> PictureRelay::serve(std::size_t path) {
  for (;;) {
    while (!is_watched(path)) co_await changed_.wait();
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
  for (std::uint64_t last = 0; is_watched(path);) {
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
    if (picture) show(path, *picture, next->picture.taken);
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
