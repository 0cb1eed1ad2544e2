#include "map/store/sql/value.hpp"

#include <chrono>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"

namespace lapwing::map::sql {

namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

}  // namespace

bool is_null(Value const& value) {
  return std::holds_alternative<std::monostate>(value);
}

std::optional<bool> as_bool(Value const& value) {
  if (auto const* truth = std::get_if<bool>(&value)) return *truth;
  if (auto const* number = std::get_if<std::int64_t>(&value)) return *number != 0;
  return std::nullopt;
}

std::optional<std::int64_t> as_integer(Value const& value) {
  if (auto const* number = std::get_if<std::int64_t>(&value)) return *number;
  if (auto const* truth = std::get_if<bool>(&value)) return *truth ? 1 : 0;
  return std::nullopt;
}

std::optional<double> as_real(Value const& value) {
  if (auto const* number = std::get_if<double>(&value)) return *number;
  if (auto const* number = std::get_if<std::int64_t>(&value)) return static_cast<double>(*number);
  return std::nullopt;
}

std::optional<base::UtcTime> as_time(Value const& value) {
  if (auto const* time = std::get_if<base::UtcTime>(&value)) return *time;
  if (auto const* text = std::get_if<std::string>(&value)) return base::utc_from_text(*text);
  return std::nullopt;
}

std::string as_text(Value const& value) {
  auto const* text = std::get_if<std::string>(&value);
  return text ? *text : std::string();
}

std::string as_bytes(Value const& value) {
  return std::visit(Overloaded{
                        [](Bytes const& bytes) { return bytes.data; },
                        [](std::string const& text) { return text; },
                        [](Shape const& shape) { return shape.wkb; },
                        [](auto const&) { return std::string(); },
                    },
                    value);
}

std::string iso_time(base::UtcTime time) {
  auto const milliseconds = std::chrono::floor<std::chrono::milliseconds>(time);
  auto const day = std::chrono::floor<std::chrono::days>(milliseconds);
  std::chrono::year_month_day const date(day);
  std::chrono::hh_mm_ss const clock(milliseconds - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(), clock.subseconds().count());
}

std::int64_t nanoseconds(base::UtcTime time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

base::UtcTime time_of_nanoseconds(std::int64_t nanoseconds) {
  return base::UtcTime(std::chrono::duration_cast<base::UtcTime::duration>(std::chrono::nanoseconds(nanoseconds)));
}

}  // namespace lapwing::map::sql
