#include "formats/internal/field_values.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ogr_core.h>
#include <ogr_p.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <variant>

namespace lapwing::formats::internal {

namespace {

using base::ErrorKind;
using map::PropertyKind;
using map::PropertyValue;

OGRFieldType type_of(PropertyKind kind, Times times) {
  switch (kind) {
    case PropertyKind::boolean: return OFTInteger;
    case PropertyKind::integer: return OFTInteger64;
    case PropertyKind::real: return OFTReal;
    case PropertyKind::text: return OFTString;
    case PropertyKind::time: return times == Times::as_times ? OFTDateTime : OFTString;
  }
  return OFTString;
}

struct FieldWriter {
  OGRFeature& feature;
  int field;
  Times times;

  void operator()(std::monostate) const { feature.SetFieldNull(field); }
  void operator()(bool value) const { feature.SetField(field, value ? 1 : 0); }
  void operator()(std::int64_t value) const { feature.SetField(field, static_cast<GIntBig>(value)); }
  void operator()(double value) const { feature.SetField(field, value); }
  void operator()(std::string const& value) const { feature.SetField(field, value.c_str()); }
  void operator()(base::UtcTime value) const {
    if (times == Times::as_text) return feature.SetField(field, time_text(value).c_str());
    auto const whole = std::chrono::floor<std::chrono::minutes>(value);
    auto const date = std::chrono::floor<std::chrono::days>(whole);
    std::chrono::year_month_day const day{date};
    std::chrono::hh_mm_ss const clock{whole - date};
    double const seconds = std::chrono::duration<double>(value - whole).count();
    constexpr int utc = 100;
    feature.SetField(field, static_cast<int>(day.year()), static_cast<int>(static_cast<unsigned>(day.month())),
                     static_cast<int>(static_cast<unsigned>(day.day())), static_cast<int>(clock.hours().count()),
                     static_cast<int>(clock.minutes().count()), static_cast<float>(seconds), utc);
  }
};

base::UtcTime utc_of(OGRField const& field) {
  namespace chrono = std::chrono;
  auto const& date = field.Date;
  chrono::sys_days const day = chrono::year(date.Year) / static_cast<int>(date.Month) / static_cast<int>(date.Day);
  // GDAL counts time zones in quarters of an hour from 100, which is UTC; 0 and 1 are unknown and local: taken as UTC.
  int const quarters = date.TZFlag > 1 ? date.TZFlag - 100 : 0;
  auto const milliseconds = chrono::milliseconds(std::llround(static_cast<double>(date.Second) * 1000.0));
  return day + chrono::hours(date.Hour) + chrono::minutes(date.Minute - 15 * quarters) + milliseconds;
}

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number value{};
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

base::Result<PropertyValue> wrong(OGRFeature const& feature, int field, std::string_view wanted) {
  std::string shown = feature.GetFieldAsString(field);
  if (shown.size() > 60) shown = shown.substr(0, 57) + "...";
  return base::fail(ErrorKind::invalid_input,
                    fmt::format("`{}` is \"{}\", not {}", feature.GetFieldDefnRef(field)->GetNameRef(), shown, wanted));
}

base::Result<PropertyValue> real_in(OGRFeature const& feature, int field) {
  if (feature.GetFieldDefnRef(field)->GetType() != OFTString) return PropertyValue(feature.GetFieldAsDouble(field));
  if (auto const value = number_in<double>(feature.GetFieldAsString(field))) return PropertyValue(*value);
  return wrong(feature, field, "a number");
}

base::Result<PropertyValue> integer_in(OGRFeature const& feature, int field) {
  auto const type = feature.GetFieldDefnRef(field)->GetType();
  if (type == OFTInteger || type == OFTInteger64)
    return PropertyValue(std::int64_t{feature.GetFieldAsInteger64(field)});
  if (auto const value = number_in<std::int64_t>(feature.GetFieldAsString(field))) return PropertyValue(*value);
  return wrong(feature, field, "a whole number");
}

base::Result<PropertyValue> boolean_in(OGRFeature const& feature, int field) {
  std::string_view const text = feature.GetFieldAsString(field);
  if (text == "1" || text == "true") return PropertyValue(true);
  if (text == "0" || text == "false") return PropertyValue(false);
  return wrong(feature, field, "true or false");
}

base::Result<PropertyValue> time_in(OGRFeature const& feature, int field) {
  auto const type = feature.GetFieldDefnRef(field)->GetType();
  if (type == OFTDateTime || type == OFTDate) return PropertyValue(utc_of(*feature.GetRawFieldRef(field)));
  auto const time = time_from(feature.GetFieldAsString(field));
  if (!time) return wrong(feature, field, "a time such as 2026-11-22T20:49:57Z");
  return PropertyValue(*time);
}

}  // namespace

void define(OGRFeatureDefn& definition, std::string const& name, PropertyKind kind, Times times) {
  OGRFieldDefn field(name.c_str(), type_of(kind, times));
  if (kind == PropertyKind::boolean) field.SetSubType(OFSTBoolean);
  definition.AddFieldDefn(&field);
}

void write_field(OGRFeature& feature, int field, PropertyValue const& value, Times times) {
  std::visit(FieldWriter{feature, field, times}, value);
}

base::Result<PropertyValue> read_field(OGRFeature const& feature, int field, PropertyKind kind) {
  if (feature.IsFieldSetAndNotNull(field) == 0) return PropertyValue();
  if (kind == PropertyKind::text) return PropertyValue(std::string(feature.GetFieldAsString(field)));
  if (std::string_view(feature.GetFieldAsString(field)).empty()) return PropertyValue();
  switch (kind) {
    case PropertyKind::boolean: return boolean_in(feature, field);
    case PropertyKind::integer: return integer_in(feature, field);
    case PropertyKind::real: return real_in(feature, field);
    default: return time_in(feature, field);
  }
}

std::string time_text(base::UtcTime time) {
  auto const seconds = std::chrono::floor<std::chrono::seconds>(time);
  auto const rest = std::chrono::duration_cast<std::chrono::milliseconds>(time - seconds).count();
  auto text =
      fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}", fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)), rest);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text + "Z";
}

base::Result<base::UtcTime> time_from(std::string const& text) {
  OGRField field;
  if (OGRParseDate(text.c_str(), &field, 0) == 0)
    return base::fail(ErrorKind::invalid_input, fmt::format("\"{}\" is no time such as 2026-11-22T20:49:57Z", text));
  return utc_of(field);
}

}  // namespace lapwing::formats::internal
