#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/notifier.hpp"
#include "base/error.hpp"
#include "video/rtsp/jpeg.hpp"

namespace lapwing::video {

struct RtspSettings {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8554;   ///< 0 picks a free one
  unsigned most_viewers = 8;   ///< of all streams together
  unsigned kbit_a_s = 2000;    ///< of each stream, about
  double pictures_a_s = 10.0;  ///< at most, about; one in two seconds stands alone, so that who has lost one sees again
  std::string token = {};      ///< what viewers give as the password of the user "viewer"; empty: nothing is asked
};

/// Pictures as H.264 over RTSP (RFC 2326), one stream a path: each is encoded once for all who look at it, and only
/// while somebody does. Nobody waits for a player that is slow: over UDP it misses pictures, over TCP it is let go when
/// too many wait for it. GStreamer serves on threads of its own; this end is bound to its loop, which outlives it.
class RtspServer {
 public:
  /// `paths` with their slash: "/annotated". Errors: invalid_input, other machines reach the address and there is no
  /// token; io, the port is taken, the address is not this machine's, or the encoder is not installed.
  [[nodiscard]] static base::Result<std::unique_ptr<RtspServer>> open(base::Loop& loop, RtspSettings const& settings,
                                                                      std::vector<std::string> const& paths);
  ~RtspServer();
  RtspServer(RtspServer const&) = delete;
  RtspServer& operator=(RtspServer const&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// Whether somebody looks at the path of that number.
  [[nodiscard]] bool is_watched(std::size_t path) const;
  /// Somebody has begun to look at a stream, or nobody does any more.
  [[nodiscard]] base::Notifier& watching_changed();
  /// The newest picture of that path; where one waits to be encoded, it takes its place.
  void offer(std::size_t path, RawPicture picture);

 private:
  class Core;
  explicit RtspServer(std::unique_ptr<Core> core);
  std::unique_ptr<Core> core_;
};

}  // namespace lapwing::video
