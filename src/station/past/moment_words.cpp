#include "station/past/moment_words.hpp"

#include <charconv>
#include <chrono>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

namespace lapwing::station {

base::Result<base::UtcTime> time_parameter(HttpRequest const& request, std::string_view name) {
  /// The years 1970 to 2200: what else comes is a mistake, and would not fit into the clock's nanoseconds.
  constexpr std::int64_t latest_ms = 7'258'118'400'000;
  auto const text = request.parameter(name);
  if (!text)
    return base::fail(base::ErrorKind::invalid_input, fmt::format("The parameter \"{}\" is missing.", name),
                      "Give milliseconds since 1970, UTC.");
  std::int64_t value = 0;
  auto const [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc{} || end != text->data() + text->size() || value < 0 || value > latest_ms)
    return base::fail(base::ErrorKind::invalid_input, fmt::format("\"{}\" is no time.", name),
                      "Give milliseconds since 1970, UTC.");
  return base::UtcTime(std::chrono::milliseconds(value));
}

std::int64_t milliseconds_of(base::UtcTime time) {
  return std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

HttpResponse no_history() {
  return problem(404, "This station keeps no history.", "Start it with --store FOLDER.");
}

HttpResponse picture_of_the_past(HttpRequest const& request, PastGrids::Picture picture, bool is_settled) {
  std::vector<HttpHeader> headers{
      {"ETag", picture.tag},
      {"Cache-Control", is_settled ? "private, max-age=31536000, immutable" : "private, no-cache"}};
  if (request.header("If-None-Match") == picture.tag) return {304, "", "", std::move(headers)};
  return {200, "image/png", std::move(picture.png), std::move(headers)};
}

}  // namespace lapwing::station
