#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/time.hpp"

/// The little of SQL that the store needs, the same over SQLite and PostgreSQL.
namespace lapwing::map::sql {

struct Bytes {
  std::string data;
  friend bool operator==(Bytes const&, Bytes const&) = default;
};

/// What lies on the globe, in degrees: WGS 84, longitude before latitude.
struct Shape {
  std::string wkb;  ///< OGC well-known binary, little endian
  double least_lon = 0.0;
  double most_lon = 0.0;
  double least_lat = 0.0;
  double most_lat = 0.0;
  friend bool operator==(Shape const&, Shape const&) = default;
};

/// What goes into a column and comes out of it. Databases have fewer kinds than these: a bool may come back as an
/// integer, a time as text, a shape as bytes. The functions below take either.
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, Bytes, base::UtcTime, Shape>;
using Row = std::vector<Value>;

[[nodiscard]] bool is_null(Value const& value);
/// Each of these is nothing for a value that is no such thing.
[[nodiscard]] std::optional<bool> as_bool(Value const& value);
[[nodiscard]] std::optional<std::int64_t> as_integer(Value const& value);
[[nodiscard]] std::optional<double> as_real(Value const& value);
[[nodiscard]] std::optional<base::UtcTime> as_time(Value const& value);
/// Empty for what is none.
[[nodiscard]] std::string as_text(Value const& value);
[[nodiscard]] std::string as_bytes(Value const& value);

/// As GeoPackage wants them: "2026-03-01T09:30:00.123Z". Milliseconds, rounded down.
[[nodiscard]] std::string iso_time(base::UtcTime time);
[[nodiscard]] std::int64_t nanoseconds(base::UtcTime time);
[[nodiscard]] base::UtcTime time_of_nanoseconds(std::int64_t nanoseconds);

}  // namespace lapwing::map::sql
