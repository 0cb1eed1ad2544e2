#include "base/text/utc_text.hpp"

#include <cstdint>

#include <fmt/format.h>

namespace lapwing::base {

namespace {

using std::chrono::days;
using std::chrono::nanoseconds;
using std::chrono::seconds;

/// Takes pieces of a text off its front; what does not fit is remembered.
class Cutter {
 public:
  explicit Cutter(std::string_view text) : rest_(text) {}

  int number(std::size_t digits) {
    int value = 0;
    if (rest_.size() < digits || rest_.substr(0, digits).find_first_not_of("0123456789") != std::string_view::npos) {
      fits_ = false;
      return 0;
    }
    for (char const digit : rest_.substr(0, digits)) value = value * 10 + (digit - '0');
    rest_.remove_prefix(digits);
    return value;
  }
  /// Of several characters, which one it was.
  char one_of(std::string_view any) {
    if (rest_.empty() || !any.contains(rest_.front())) {
      fits_ = false;
      return 0;
    }
    char const found = rest_.front();
    rest_.remove_prefix(1);
    return found;
  }
  nanoseconds decimals() {
    if (rest_.empty() || rest_.front() != '.') return nanoseconds(0);
    rest_.remove_prefix(1);
    std::int64_t value = 0;
    int digits = 0;
    for (; !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; ++digits, rest_.remove_prefix(1))
      if (digits < 9) value = value * 10 + (rest_.front() - '0');
    fits_ = fits_ && digits > 0;
    for (; digits < 9; ++digits) value *= 10;
    return nanoseconds(value);
  }
  [[nodiscard]] bool has_fit() const { return fits_ && rest_.empty(); }

 private:
  std::string_view rest_;
  bool fits_ = true;
};

struct Fields {
  int year = 0;
  int month = 0;
  int day = 0;
  int hour = 0;
  int minute = 0;
  int second = 0;
  nanoseconds decimals = {};
  seconds offset = {};
};

std::optional<Fields> fields_of(std::string_view text) {
  Cutter cutter(text);
  Fields fields;
  fields.year = cutter.number(4);
  cutter.one_of("-");
  fields.month = cutter.number(2);
  cutter.one_of("-");
  fields.day = cutter.number(2);
  cutter.one_of("Tt ");
  fields.hour = cutter.number(2);
  cutter.one_of(":");
  fields.minute = cutter.number(2);
  cutter.one_of(":");
  fields.second = cutter.number(2);
  fields.decimals = cutter.decimals();
  if (char const zone = cutter.one_of("Zz+-"); zone == '+' || zone == '-') {
    auto const hours = cutter.number(2);
    cutter.one_of(":");
    auto const minutes = cutter.number(2);
    fields.offset = (zone == '-' ? -1 : 1) * (std::chrono::hours(hours) + std::chrono::minutes(minutes));
  }
  return cutter.has_fit() ? std::optional(fields) : std::nullopt;
}

}  // namespace

std::string utc_text(UtcTime time) {
  auto const day = std::chrono::floor<days>(time);
  std::chrono::year_month_day const date(day);
  std::chrono::hh_mm_ss const clock(std::chrono::duration_cast<nanoseconds>(time - day));
  auto decimals = fmt::format("{:09}", clock.subseconds().count());
  while (decimals.size() > 3 && decimals.ends_with("000")) decimals.resize(decimals.size() - 3);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count(), decimals);
}

std::string to_iso8601(UtcTime time) {
  return utc_text(std::chrono::floor<std::chrono::milliseconds>(time));
}

std::optional<UtcTime> utc_from_text(std::string_view text) {
  auto const fields = fields_of(text);
  if (!fields) return std::nullopt;
  std::chrono::year_month_day const date(std::chrono::year(fields->year),
                                         std::chrono::month(static_cast<unsigned>(fields->month)),
                                         std::chrono::day(static_cast<unsigned>(fields->day)));
  constexpr int first_year = 1678;  // nanoseconds in 64 bits end in the years 1677 and 2262
  constexpr int last_year = 2261;
  bool const is_time = fields->hour < 24 && fields->minute < 60 && fields->second <= 60;  // 60: a leap second
  if (!date.ok() || !is_time || fields->year < first_year || fields->year > last_year) return std::nullopt;
  return std::chrono::sys_days(date) + std::chrono::hours(fields->hour) + std::chrono::minutes(fields->minute) +
         seconds(fields->second) - fields->offset + fields->decimals;
}

}  // namespace lapwing::base
