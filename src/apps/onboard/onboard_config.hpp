#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/text/diagnostic.hpp"
#include "base/text/source.hpp"
#include "bridge/bridge.hpp"
#include "bus/participant/bus.hpp"
#include "onboard/decide/decide.hpp"
#include "onboard/supervisor/child.hpp"

namespace lapwing::apps {

/// The processes that this program has itself.
inline constexpr std::string_view bridge_process = "bridge";
inline constexpr std::string_view decide_process = "decide";
/// Those of lapwing-perceive and lapwing-stream, which are in the same folder.
inline constexpr std::string_view perceive_process = "perceive";
inline constexpr std::string_view stream_process = "stream";

/// A vehicle's programs as its file describes them: docs/reference/onboard.md.
struct OnboardConfig {
  bus::BusOptions bus = {};
  bridge::BridgeOptions bridge = {};
  onboard::DecideSettings decide = {};
  std::filesystem::path token_file = {};             ///< of the operator link; empty: no token
  std::vector<onboard::ProcessSpec> processes = {};  ///< own ones have no command
  std::filesystem::path health_file = {};            ///< empty: none
  bool sees = false;                                 ///< there is a camera, so that perceive is a process
  bool shows = false;                                ///< its pictures go out as video, so that stream is one
};

/// Reads the file's text; paths in it count from the file's folder. Everything wrong is reported; the result is to be
/// used only when nothing was.
[[nodiscard]] OnboardConfig read_onboard_config(base::SourceFile const& source, base::Diagnostics& diagnostics);

}  // namespace lapwing::apps
