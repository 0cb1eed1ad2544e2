#include "map/features/internal/track_text.hpp"

#include <vector>

#include "map/features/internal/property_access.hpp"
#include "map/features/number_list.hpp"

namespace lapwing::map::internal {

namespace {

/// Null for nothing, which takes the numbers away.
base::Result<std::string const*> list_text(PropertyValue const& value) {
  auto const* text = std::get_if<std::string>(&value);
  if (!text && !std::holds_alternative<std::monostate>(value)) return takes("text: numbers with blanks between");
  return text;
}

std::unexpected<base::Error> not_as_many(std::size_t numbers, std::size_t points) {
  return base::fail(base::ErrorKind::invalid_input,
                    fmt::format("has {} numbers, and the track {} points", numbers, points));
}

}  // namespace

PropertyValue get_beginning(Content const& content) {
  auto const& samples = std::get<Track>(content).samples;
  if (samples.empty() || samples.front().at == base::UtcTime()) return {};
  return samples.front().at;
}

base::Result<> set_beginning(Content& content, PropertyValue const& value) {
  auto const time = time_of(value);
  if (!time) return std::unexpected(time.error());
  if (*time && !is_sane(**time)) return takes("a time from 1990 to 2200");
  auto& samples = std::get<Track>(content).samples;
  if (samples.empty()) return {};
  auto const shift = time->value_or(base::UtcTime()) - samples.front().at;
  for (auto& sample : samples) sample.at += shift;
  return {};
}

PropertyValue get_times(Content const& content) {
  auto const& samples = std::get<Track>(content).samples;
  std::vector<base::Duration> since_first;
  since_first.reserve(samples.size());
  for (auto const& sample : samples) since_first.push_back(sample.at - samples.front().at);
  return samples.empty() ? PropertyValue() : PropertyValue(text_of(since_first));
}

base::Result<> set_times(Content& content, PropertyValue const& value) {
  auto const text = list_text(value);
  if (!text) return std::unexpected(text.error());
  auto& samples = std::get<Track>(content).samples;
  if (samples.empty()) return {};
  auto const first = samples.front().at;
  if (!*text) {
    for (auto& sample : samples) sample.at = first;
    return {};
  }
  auto const times = durations_of(**text);
  if (!times) return takes("seconds with blanks between");
  if (times->size() != samples.size()) return not_as_many(times->size(), samples.size());
  if (times->front() != base::Duration::zero()) return takes("times since the first point, the first of which is 0");
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].at = first + (*times)[i];
  return {};
}

PropertyValue get_heights(Content const& content) {
  auto const& samples = std::get<Track>(content).samples;
  std::vector<double> heights_m;
  heights_m.reserve(samples.size());
  for (auto const& sample : samples) heights_m.push_back(sample.up_m);
  return samples.empty() ? PropertyValue() : PropertyValue(text_of(heights_m));
}

base::Result<> set_heights(Content& content, PropertyValue const& value) {
  auto const text = list_text(value);
  if (!text) return std::unexpected(text.error());
  auto& samples = std::get<Track>(content).samples;
  if (!*text) {
    for (auto& sample : samples) sample.up_m = 0.0;
    return {};
  }
  auto const heights_m = numbers_of(**text);
  if (!heights_m) return takes("metres with blanks between");
  if (heights_m->size() != samples.size()) return not_as_many(heights_m->size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i].up_m = (*heights_m)[i];
  return {};
}

}  // namespace lapwing::map::internal
