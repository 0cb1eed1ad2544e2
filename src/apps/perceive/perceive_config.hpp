#pragma once

#include <filesystem>

#include "base/text/diagnostic.hpp"
#include "base/text/source.hpp"
#include "bus/participant/bus.hpp"
#include "perceive/perceive.hpp"

namespace lapwing::apps {

/// What `lapwing perceive` reads of a vehicle's file: docs/reference/onboard.md.
struct PerceiveConfig {
  bus::BusOptions bus = {};
  perceive::PerceiveSettings perceive = {};
  std::filesystem::path stream_token_file = {};  ///< empty: who looks at the pictures needs no token
};

/// The tables `[bus]`, `[camera]`, `[survey]` and `[stream]`; the others are those of other programs. Paths count from
/// the file's folder. Everything wrong is reported; the result is to be used only when nothing was.
[[nodiscard]] PerceiveConfig read_perceive_config(base::SourceFile const& source, base::Diagnostics& diagnostics);

}  // namespace lapwing::apps
