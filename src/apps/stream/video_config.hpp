#pragma once

#include <filesystem>

#include "base/text/diagnostic.hpp"
#include "base/text/source.hpp"
#include "link/pictures/picture_client.hpp"
#include "video/rtsp/rtsp_server.hpp"

namespace lapwing::apps {

/// What `lapwing stream` reads of a vehicle's file: docs/reference/onboard.md.
struct RtspConfig {
  video::RtspSettings rtsp = {};
  link::pictures::Source pictures = {};   ///< where they come from
  std::filesystem::path token_file = {};  ///< of both; empty: who looks needs no token
};

/// The tables `[stream]` and `[rtsp]`; the others are those of other programs. Everything wrong is reported; the result
/// is to be used only when nothing was.
[[nodiscard]] RtspConfig read_rtsp_config(base::SourceFile const& source, base::Diagnostics& diagnostics);

}  // namespace lapwing::apps
