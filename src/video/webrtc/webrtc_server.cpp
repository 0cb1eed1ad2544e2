#include "video/webrtc/webrtc_server.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <boost/asio/ip/address.hpp>

#include "base/async/inbox.hpp"
#include "base/async/scope.hpp"
#include "base/async/side_thread.hpp"
#include "base/text/random_name.hpp"
#include "base/wall_clock.hpp"
#include "video/webrtc/video_encoder.hpp"
#include "video/webrtc/webrtc_peer.hpp"

namespace lapwing::video {

using base::ErrorKind;
using base::fail;
using namespace std::chrono_literals;

namespace {

/// GStreamer finds its own addresses at once: nobody else is asked.
constexpr base::Duration answer_patience = 5s;
constexpr base::Duration look_after_viewers = 1s;
/// The encoder makes one in milliseconds; what waits for a loop that hangs is old.
constexpr std::size_t most_coded = 8;
constexpr std::size_t most_news = 256;
/// Pictures of before the server's start may be shown, and a clock be set back by a little.
constexpr auto before_start = 1h;
/// What the clock of pictures may gain on the loop's between two of them, or lose.
constexpr auto clock_was_set = 2s;

std::string no_fingerprint() {
  constexpr int bytes = 32;
  std::string text = "00";
  for (int i = 1; i < bytes; ++i) text += ":00";
  return text;
}

/// GStreamer loads its parts and makes the certificate of this process for the first viewer, which takes a second and
/// more on a busy machine: for one that is none, so that nobody waits for it.
void warm_up() {
  Offer const nobody{.sections = {{.kind = "video", .mid = "0"}},
                     .ice_user = "nobody",
                     .ice_password = std::string(24, 'x'),
                     .fingerprint = "sha-256 " + no_fingerprint(),
                     .payload_type = 96};
  (void)WebRtcPeer::answer(nobody, {.address = "127.0.0.1"}, [](PeerNews const&) {});
}

}  // namespace

class WebRtcServer::Core {
 public:
  Core(base::Loop& loop, WebRtcSettings settings, std::string address, std::size_t views)
      : loop_(loop),
        settings_(std::move(settings)),
        address_(std::move(address)),
        changed_(loop),
        news_(loop, most_news, base::Overflow::drop_newest),
        side_(std::in_place, loop, std::make_unique<Hand>()),
        scope_(loop) {
    side_->give([](Hand&) { warm_up(); });
    for (std::size_t i = 0; i < views; ++i) views_.push_back(std::make_unique<View>(loop));
    for (auto const& view : views_) scope_.spawn(hand_on(*view));
    scope_.spawn(hear());
    scope_.spawn(look_after());
  }
  ~Core() {
    for (auto const& viewer : viewers_) let_go_of(*viewer);
    side_.reset();  // when all are gone
  }
  Core(Core const&) = delete;
  Core& operator=(Core const&) = delete;

  base::Task<base::Result<Session>> begin(std::size_t view, Offer offer);
  bool end(std::string_view session);
  [[nodiscard]] bool is_full() const { return viewers_.size() >= settings_.most_viewers; }
  [[nodiscard]] bool is_watched(std::size_t view) const {
    return std::ranges::any_of(viewers_, [view](auto const& one) { return one->view == view; });
  }
  [[nodiscard]] base::Notifier& changed() { return changed_; }
  void show(std::size_t view, RawPicture picture, base::UtcTime taken);

 private:
  struct Hand {};
  struct Viewer {
    Viewer(base::Loop& loop, std::uint64_t its_number, std::size_t its_view)
        : number(its_number), view(its_view), since(loop.now()), told(loop) {}
    std::uint64_t number;
    std::size_t view;
    base::TimePoint since;  ///< it was heard last, or began
    base::Notifier told;
    std::string id = base::random_name(32);
    std::shared_ptr<WebRtcPeer> peer = {};
    std::string answer = {};
    bool is_connected = false;
    bool needs_whole = true;  ///< what comes before a picture that stands alone means nothing to it
    bool is_over = false;
  };
  struct View {
    explicit View(base::Loop& loop) : coded(loop, most_coded, base::Overflow::drop_oldest) {}
    base::Inbox<CodedPicture> coded;
    std::unique_ptr<VideoEncoder> encoder = {};  ///< null: nobody looks
    std::uint64_t dropped = 0;
    base::UtcTime taken{};  ///< of the last picture
    base::TimePoint shown{};
  };
  struct News {
    std::uint64_t viewer = 0;
    PeerNews what = {};
  };

  base::Task<> hear();
  base::Task<> look_after();
  base::Task<> hand_on(View& view);
  void take(Viewer& viewer, PeerNews news);
  void send(View& view, CodedPicture const& picture);
  void forget(Viewer const& viewer);
  void let_go_of(Viewer& viewer);
  bool is_clock_set(View const& view, base::UtcTime taken) const;

  base::Loop& loop_;
  WebRtcSettings settings_;
  std::string address_;  ///< to be named; empty: all but loopback
  base::UtcTime epoch_ = std::chrono::floor<std::chrono::seconds>(base::wall_now() - before_start);
  base::Notifier changed_;
  base::Inbox<News> news_;
  std::uint64_t last_number_ = 0;
  std::vector<std::unique_ptr<View>> views_;
  std::vector<std::shared_ptr<Viewer>> viewers_;
  std::optional<base::SideThread<Hand>> side_;  ///< makes and ends viewers, which takes its time
  base::Scope scope_;
};

base::Task<base::Result<WebRtcServer::Session>> WebRtcServer::Core::begin(std::size_t view, Offer offer) {
  if (is_full()) co_return fail(ErrorKind::refused, "as many look at the camera as it allows");
  auto const viewer = std::make_shared<Viewer>(loop_, ++last_number_, view);
  viewers_.push_back(viewer);
  changed_.notify_all();
  auto tell = [post = news_.post(), number = viewer->number](PeerNews news) {
    (void)post({.viewer = number, .what = std::move(news)});
  };
  auto making =
      side_->run([offer = std::move(offer), address = address_, epoch = epoch_, tell = std::move(tell)](Hand&) {
        return WebRtcPeer::answer(offer, {.address = address, .epoch = epoch}, tell);
      });
  auto made = co_await making;
  if (!made) {
    forget(*viewer);
    co_return std::unexpected(made.error());
  }
  viewer->peer = *std::move(made);
  for (auto const deadline = loop_.now() + answer_patience; viewer->answer.empty() && !viewer->is_over;)
    if (!co_await viewer->told.wait_until(deadline)) break;
  if (viewer->answer.empty()) {
    forget(*viewer);
    co_return fail(ErrorKind::timed_out, "this end's addresses for WebRTC were not found in time");
  }
  viewer->since = loop_.now();
  co_return Session{.id = viewer->id, .answer = viewer->answer};
}

bool WebRtcServer::Core::end(std::string_view session) {
  auto const found = std::ranges::find_if(viewers_, [session](auto const& one) { return one->id == session; });
  if (found == viewers_.end()) return false;
  forget(*std::shared_ptr<Viewer>(*found));
  return true;
}

void WebRtcServer::Core::let_go_of(Viewer& viewer) {
  viewer.is_over = true;
  viewer.told.notify_all();
  if (viewer.peer) side_->give([peer = std::move(viewer.peer)](Hand&) mutable { peer.reset(); });
}

void WebRtcServer::Core::forget(Viewer const& viewer) {
  auto const found = std::ranges::find_if(viewers_, [&viewer](auto const& one) { return one.get() == &viewer; });
  if (found == viewers_.end()) return;
  auto const held = std::move(*found);
  viewers_.erase(found);
  let_go_of(*held);
  if (!is_watched(held->view)) views_.at(held->view)->encoder.reset();
  changed_.notify_all();
}

base::Task<> WebRtcServer::Core::hear() {
  for (;;) {
    auto receiving = news_.receive(1h);
    auto news = co_await receiving;
    if (!news) continue;
    auto const found = std::ranges::find_if(viewers_, [&](auto const& one) { return one->number == news->viewer; });
    if (found != viewers_.end()) take(*std::shared_ptr<Viewer>(*found), std::move(news->what));
  }
}

void WebRtcServer::Core::take(Viewer& viewer, PeerNews news) {
  auto const& view = *views_.at(viewer.view);
  switch (news.kind) {
    case PeerNews::Kind::answered: viewer.answer = std::move(news.text); return viewer.told.notify_all();
    case PeerNews::Kind::heard: viewer.since = loop_.now(); return;
    case PeerNews::Kind::over: return forget(viewer);
    case PeerNews::Kind::connected:
      viewer.is_connected = true;
      viewer.since = loop_.now();
      break;
    case PeerNews::Kind::asks_whole: break;
  }
  if (view.encoder) view.encoder->ask_for_whole_picture();
}

/// Who has not come, or has gone without a word, keeps nobody out.
base::Task<> WebRtcServer::Core::look_after() {
  for (;;) {
    co_await loop_.sleep(std::min(look_after_viewers, settings_.connect_patience));
    for (auto const& viewer : std::vector(viewers_)) {
      auto const patience = viewer->is_connected ? settings_.silence : settings_.connect_patience;
      if (viewer->peer && loop_.now() > viewer->since + patience) forget(*viewer);
    }
  }
}

bool WebRtcServer::Core::is_clock_set(View const& view, base::UtcTime taken) const {
  auto const gained = (taken - view.taken) - (loop_.now() - view.shown);
  return std::chrono::abs(gained) > clock_was_set;
}

void WebRtcServer::Core::show(std::size_t view, RawPicture picture, base::UtcTime taken) {
  if (!is_watched(view)) return;
  auto& one = *views_.at(view);
  if (one.encoder && is_clock_set(one, taken)) {
    for (auto const& viewer : std::vector(viewers_))
      if (viewer->view == view) forget(*viewer);
    return;
  }
  bool const is_next = taken > epoch_ && (!one.encoder || taken > one.taken);
  if (!is_next) return;
  if (!one.encoder)
    one.encoder = std::make_unique<VideoEncoder>(
        EncodingSettings{
            .kbit_a_s = settings_.kbit_a_s, .pictures_a_s = settings_.pictures_a_s, .is_stamped_on_entry = false},
        epoch_, [post = one.coded.post()](CodedPicture coded) { (void)post(std::move(coded)); });
  one.taken = taken;
  one.shown = loop_.now();
  one.encoder->show(std::move(picture), taken);
}

base::Task<> WebRtcServer::Core::hand_on(View& view) {
  for (;;) {
    auto receiving = view.coded.receive(1h);
    auto const coded = co_await receiving;
    if (coded) send(view, *coded);
  }
}

void WebRtcServer::Core::send(View& view, CodedPicture const& picture) {
  bool const misses_some = view.coded.dropped() != std::exchange(view.dropped, view.coded.dropped());
  bool asks = false;
  for (auto const& viewer : viewers_) {
    if (views_.at(viewer->view).get() != &view || !viewer->peer || !viewer->is_connected) continue;
    viewer->needs_whole = (viewer->needs_whole || misses_some) && !picture.stands_alone;
    if (!viewer->needs_whole) viewer->needs_whole = !viewer->peer->send(picture);
    asks = asks || viewer->needs_whole;
  }
  if (asks && view.encoder) view.encoder->ask_for_whole_picture();
}

base::Result<std::unique_ptr<WebRtcServer>> WebRtcServer::open(base::Loop& loop, WebRtcSettings const& settings,
                                                               std::size_t views) {
  boost::system::error_code fault;
  auto const address = boost::asio::ip::make_address(settings.address, fault);
  if (fault)
    return fail(ErrorKind::invalid_input, fmt::format("'{}' is no address", settings.address),
                "[webrtc] address = \"127.0.0.1\", or another one of this machine");
  if (auto const found = find_encoder(); !found) return std::unexpected(found.error());
  for (auto const* const part : {"webrtcbin", "nicesrc", "dtlssrtpenc", "srtpenc"}) {
    Owned<GstElementFactory> const found(gst_element_factory_find(part));
    if (!found)
      return fail(ErrorKind::io, fmt::format("GStreamer's {} is not installed", part),
                  "apt install gstreamer1.0-plugins-bad gstreamer1.0-nice (setup/packages-stream.txt)");
  }
  auto named = address.is_unspecified() ? std::string() : address.to_string();
  return std::unique_ptr<WebRtcServer>(
      new WebRtcServer(std::make_unique<Core>(loop, settings, std::move(named), views)));
}

WebRtcServer::WebRtcServer(std::unique_ptr<Core> core) : core_(std::move(core)) {}
WebRtcServer::~WebRtcServer() = default;

base::Task<base::Result<WebRtcServer::Session>> WebRtcServer::begin(std::size_t view, Offer offer) {
  return core_->begin(view, std::move(offer));
}
bool WebRtcServer::end(std::string_view session) {
  return core_->end(session);
}
bool WebRtcServer::is_full() const {
  return core_->is_full();
}
bool WebRtcServer::is_watched(std::size_t view) const {
  return core_->is_watched(view);
}
base::Notifier& WebRtcServer::watching_changed() {
  return core_->changed();
}
void WebRtcServer::show(std::size_t view, RawPicture picture, base::UtcTime taken) {
  core_->show(view, std::move(picture), taken);
}

}  // namespace lapwing::video
