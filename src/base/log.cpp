#include "base/log.hpp"

#include <cstdlib>

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "base/flood_gate.hpp"
#include "base/text/printable.hpp"

namespace lapwing::base {

std::string_view to_string(LogLevel level) {
  switch (level) {
    case LogLevel::debug: return "debug";
    case LogLevel::info: return "info";
    case LogLevel::warn: return "warn";
    case LogLevel::error: return "error";
  }
  return "error";
}

void LogHub::write(LogRecord const& record) const {
  for (auto const& sink : sinks_) sink(record);
}

namespace {

spdlog::level::level_enum to_spdlog(LogLevel level) {
  switch (level) {
    case LogLevel::debug: return spdlog::level::debug;
    case LogLevel::info: return spdlog::level::info;
    case LogLevel::warn: return spdlog::level::warn;
    case LogLevel::error: return spdlog::level::err;
  }
  return spdlog::level::err;
}

}  // namespace

LogHub::Sink standard_error_sink(LogLevel lowest) {
  bool const plain = std::getenv("NO_COLOR") != nullptr;
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_st>(plain ? spdlog::color_mode::never
                                                                          : spdlog::color_mode::automatic);
  auto logger = std::make_shared<spdlog::logger>("lapwing", std::move(sink));
  logger->set_level(to_spdlog(lowest));
  logger->set_pattern("%H:%M:%S.%e %^%-5l%$ %v");
  return without_floods([logger](LogRecord const& record) {
    logger->log(record.utc, spdlog::source_loc{}, to_spdlog(record.level),
                printable(fmt::format("{}: {}", record.source, record.text)));
  });
}

Logger Logger::named(std::string source) const {
  Logger other = *this;
  other.source_ = std::move(source);
  return other;
}

void Logger::write(LogLevel level, std::string text) const {
  if (hub_) hub_->write(LogRecord{level, std::chrono::system_clock::now(), source_, std::move(text)});
}

}  // namespace lapwing::base
