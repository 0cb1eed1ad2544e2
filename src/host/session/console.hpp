#pragma once

#include <memory>

#include "base/async/loop.hpp"
#include "base/log.hpp"
#include "dolphin/value/output.hpp"

namespace lapwing::host {

/// A script's words on standard output, its questions answered on standard input; also kept in the log, which the map
/// shows.
[[nodiscard]] std::unique_ptr<dolphin::Output> make_console(base::Loop& loop, base::Logger log);

/// Source name of script words in the log: a terminal has them on standard output already.
inline constexpr std::string_view script_source = "script";

}  // namespace lapwing::host
