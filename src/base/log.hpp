#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"

namespace lapwing::base {

/// error: an operator must act · warn: degraded · info: a state changed · debug: every event.
enum class LogLevel { debug, info, warn, error };
[[nodiscard]] std::string_view to_string(LogLevel level);

struct LogRecord {
  LogLevel level;
  UtcTime utc;
  std::string source;  ///< the part that speaks: "fleet", "vehicle 1", "script"
  std::string text;    ///< one line; details as key=value
};

/// Where a program's log lines go. Made once in `apps`, handed down as `Logger`.
class LogHub {
 public:
  using Sink = std::function<void(LogRecord const&)>;

  /// Keeps the sink for the hub's life.
  void add_sink(Sink sink) { sinks_.push_back(std::move(sink)); }
  void write(LogRecord const& record) const;

 private:
  std::vector<Sink> sinks_;
};

/// Human lines with a time stamp on standard error, coloured on a terminal unless NO_COLOR is set. Control characters
/// of the text are shown as question marks.
[[nodiscard]] LogHub::Sink standard_error_sink(LogLevel lowest);

/// A cheap, copyable way to write to a hub under one name. The default one writes nowhere.
class Logger {
 public:
  Logger() = default;
  Logger(LogHub const& hub, std::string source) : hub_(&hub), source_(std::move(source)) {}

  /// The same hub under another name.
  [[nodiscard]] Logger named(std::string source) const;

  void debug(std::string text) const { write(LogLevel::debug, std::move(text)); }
  void info(std::string text) const { write(LogLevel::info, std::move(text)); }
  void warn(std::string text) const { write(LogLevel::warn, std::move(text)); }
  void error(std::string text) const { write(LogLevel::error, std::move(text)); }

 private:
  void write(LogLevel level, std::string text) const;
  LogHub const* hub_ = nullptr;
  std::string source_;
};

}  // namespace lapwing::base
