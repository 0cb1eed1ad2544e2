#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <gst/gst.h>

#include "base/error.hpp"
#include "video/rtsp/owned.hpp"
#include "video/webrtc/offer.hpp"
#include "video/webrtc/video_encoder.hpp"

namespace lapwing::video {

/// What becomes of a viewer, from threads of GStreamer's.
struct PeerNews {
  enum class Kind : std::uint8_t {
    answered,    ///< `text` answers its offer
    connected,   ///< it can be sent to
    heard,       ///< something came from it: told once a second
    asks_whole,  ///< it has lost something and needs a picture that stands alone
    over,        ///< it has left, or cannot be reached
  };
  Kind kind = Kind::over;
  std::string text = {};
};

/// One viewer's end of WebRTC (GStreamer's webrtcbin): is sent H.264 over SRTP. Its RTP time is the time of exposure:
/// seconds since 1970 by the drone's clock, in 1/90000 s, of which RTP carries the lower 32 bits. Made, asked and ended
/// on any one thread at a time; making and ending it takes some tenths of a second.
class WebRtcPeer {
 public:
  struct Settings {
    std::string address = {};  ///< of this machine, to be named to the viewer; empty: all but loopback
    base::UtcTime epoch{};     ///< whole seconds; pictures are younger
  };
  /// `tell` may be called until the peer has been destroyed. Error: io, GStreamer says no.
  [[nodiscard]] static base::Result<std::unique_ptr<WebRtcPeer>> answer(Offer const& offer, Settings const& settings,
                                                                        std::function<void(PeerNews)> tell);
  ~WebRtcPeer();
  WebRtcPeer(WebRtcPeer const&) = delete;
  WebRtcPeer& operator=(WebRtcPeer const&) = delete;

  /// False when so many wait for it that this one was left out.
  [[nodiscard]] bool send(CodedPicture const& picture);

 private:
  WebRtcPeer(Offer const& offer, Settings const& settings, std::function<void(PeerNews)> tell);
  [[nodiscard]] base::Result<> negotiate();
  void name_addresses(std::string const& address) const;
  void describe_video() const;
  void listen();

  Offer offer_;
  base::UtcTime epoch_;
  std::function<void(PeerNews)> tell_;
  std::chrono::steady_clock::time_point heard_{};  // only the thread that receives knows it
  Owned<GstElement> pipeline_;
  Owned<GstElement> source_;
  Owned<GstElement> peer_;
};

}  // namespace lapwing::video
