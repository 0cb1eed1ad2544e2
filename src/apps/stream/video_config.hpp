#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "base/text/diagnostic.hpp"
#include "base/text/source.hpp"
#include "link/pictures/picture_client.hpp"
#include "video/rtsp/rtsp_server.hpp"
#include "video/webrtc/webrtc_server.hpp"

namespace lapwing::apps {

/// Video for browsers, and the port at which they offer themselves.
struct WebRtcConfig {
  video::WebRtcSettings settings = {};
  std::uint16_t port = link::pictures::default_whep_port;
};

/// What `lapwing stream` reads of a vehicle's file: docs/reference/onboard.md. One of both at least is to be served.
struct VideoConfig {
  std::optional<video::RtspSettings> rtsp = {};
  std::optional<WebRtcConfig> webrtc = {};
  link::pictures::Source pictures = {};   ///< where they come from
  std::filesystem::path token_file = {};  ///< of all; empty: who looks needs no token
};

/// The tables `[stream]`, `[rtsp]` and `[webrtc]`; the others are those of other programs. Everything wrong is
/// reported; the result is to be used only when nothing was.
[[nodiscard]] VideoConfig read_video_config(base::SourceFile const& source, base::Diagnostics& diagnostics);

}  // namespace lapwing::apps
