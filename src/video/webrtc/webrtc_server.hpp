#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "base/async/loop.hpp"
#include "base/async/notifier.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "base/time.hpp"
#include "video/rtsp/jpeg.hpp"
#include "video/webrtc/offer.hpp"

namespace lapwing::video {

struct WebRtcSettings {
  std::string address = "127.0.0.1";  ///< where viewers reach this machine; 0.0.0.0: at all addresses but loopback
  unsigned most_viewers = 4;          ///< of all views together
  unsigned kbit_a_s = 2000;           ///< of each view, about
  double pictures_a_s = 10.0;         ///< at most, about
  base::Duration connect_patience = std::chrono::seconds(10);  ///< from its answer until a viewer is connected
  base::Duration silence = std::chrono::seconds(15);  ///< after which it is gone; viewers report each second or two
};

/// Pictures as H.264 over WebRTC, as browsers show it: each view is encoded once for all who look at it this way, and
/// only while somebody does. A viewer that is slow misses pictures; who has lost one asks for one that stands alone.
/// Nothing outside of this machine is asked for anything. Thread-bound to its loop, which outlives it.
class WebRtcServer {
 public:
  /// Errors: invalid_input, the address is none; io, GStreamer's parts are not installed.
  [[nodiscard]] static base::Result<std::unique_ptr<WebRtcServer>> open(base::Loop& loop,
                                                                        WebRtcSettings const& settings,
                                                                        std::size_t views);
  ~WebRtcServer();
  WebRtcServer(WebRtcServer const&) = delete;
  WebRtcServer& operator=(WebRtcServer const&) = delete;

  struct Session {
    std::string id;      ///< nobody guesses it
    std::string answer;  ///< SDP with all of this end's addresses
  };
  /// Lets a viewer in. Errors: refused, all places are taken; io and timed_out, GStreamer does not answer.
  [[nodiscard]] base::Task<base::Result<Session>> begin(std::size_t view, Offer offer);
  /// False where there is no such session.
  bool end(std::string_view session);
  [[nodiscard]] bool is_full() const;

  /// Whether somebody looks at the view of that number.
  [[nodiscard]] bool is_watched(std::size_t view) const;
  [[nodiscard]] base::Notifier& watching_changed();
  /// The newest picture of that view; where one waits to be encoded, it takes its place. When the clock by which
  /// pictures are taken was set, those who look are let go: they come again.
  void show(std::size_t view, RawPicture picture, base::UtcTime taken);

 private:
  class Core;
  explicit WebRtcServer(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

}  // namespace lapwing::video
