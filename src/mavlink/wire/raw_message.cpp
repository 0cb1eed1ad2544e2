#include "mavlink/wire/raw_message.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/text/spelling.hpp"
#include "mavlink/wire/dialect_names.hpp"

namespace lapwing::mavlink {

namespace {

using base::ErrorKind;
using base::fail;
using base::Result;

/// The dialect and x86 and ARM agree on little endian.
template <class T>
void put(Frame& frame, FieldName const& field, T value) {
  std::memcpy(frame.payload.data() + field.offset, &value, sizeof value);
}

Result<> misfit(FieldName const& field, auto const& value) {
  return fail(ErrorKind::invalid_input, fmt::format("{} is not what {} holds", value, field.name));
}

template <class T>
Result<> put_whole(Frame& frame, FieldName const& field, RawValue const& value) {
  auto whole = std::get_if<std::int64_t>(&value) ? std::get<std::int64_t>(value) : 0;
  if (auto const* decimal = std::get_if<double>(&value)) {
    constexpr double most = 9e18;
    if (!(std::abs(*decimal) < most) || *decimal != std::floor(*decimal)) return misfit(field, *decimal);
    whole = static_cast<std::int64_t>(*decimal);
  }
  if (!std::in_range<T>(whole)) return misfit(field, whole);
  put(frame, field, static_cast<T>(whole));
  return {};
}

template <class T>
Result<> put_real(Frame& frame, FieldName const& field, RawValue const& value) {
  auto const* whole = std::get_if<std::int64_t>(&value);
  double const real = whole ? static_cast<double>(*whole) : std::get<double>(value);
  if (std::isfinite(real) && std::abs(real) > static_cast<double>(std::numeric_limits<T>::max()))
    return misfit(field, real);
  put(frame, field, static_cast<T>(real));
  return {};
}

Result<> put_number(Frame& frame, FieldName const& field, RawValue const& value) {
  switch (field.type) {
    case WireType::char_:
    case WireType::int8_: return put_whole<std::int8_t>(frame, field, value);
    case WireType::uint8_: return put_whole<std::uint8_t>(frame, field, value);
    case WireType::uint16_: return put_whole<std::uint16_t>(frame, field, value);
    case WireType::int16_: return put_whole<std::int16_t>(frame, field, value);
    case WireType::uint32_: return put_whole<std::uint32_t>(frame, field, value);
    case WireType::int32_: return put_whole<std::int32_t>(frame, field, value);
    case WireType::uint64_: return put_whole<std::uint64_t>(frame, field, value);
    case WireType::int64_: return put_whole<std::int64_t>(frame, field, value);
    case WireType::float_: return put_real<float>(frame, field, value);
    case WireType::double_: return put_real<double>(frame, field, value);
  }
  return {};
}

Result<> put_text(Frame& frame, FieldName const& field, std::string const& text) {
  if (text.size() > std::max<std::size_t>(field.length, 1))
    return fail(ErrorKind::invalid_input,
                fmt::format("'{}' is longer than {} holds ({})", text, field.name, field.length));
  std::memcpy(frame.payload.data() + field.offset, text.data(), text.size());
  return {};
}

Result<> put_field(Frame& frame, FieldName const& field, RawValue const& value) {
  auto const* text = std::get_if<std::string>(&value);
  if (field.type == WireType::char_ && text) return put_text(frame, field, *text);
  if (field.length > 0)
    return fail(ErrorKind::invalid_input,
                fmt::format("{} is a list of {} numbers, which cannot be sent", field.name, field.length));
  if (!text) return put_number(frame, field, value);
  auto const entry = find_enum_entry(*text);
  if (entry) return put_number(frame, field, *entry);
  return fail(ErrorKind::not_found, fmt::format("MAVLink has no {}", *text),
              base::did_you_mean(*text, enum_entry_names()));
}

void address(Frame& frame, MessageName const& message, Address target) {
  for (auto const& field : message.fields) {
    if (field.name == "target_system") put(frame, field, target.system);
    if (field.name == "target_component") put(frame, field, target.component);
  }
}

}  // namespace

Result<Frame> raw_message(std::string_view name, std::span<RawField const> fields, Address self, Address target) {
  auto const message = find_message(name);
  if (!message)
    return fail(ErrorKind::not_found, fmt::format("MAVLink has no message {}", name),
                base::did_you_mean(name, message_names()));
  Frame frame;
  frame.source = self;
  frame.message_id = message->id;
  frame.payload_size = find_traits(message->id)->max_size;  // the tables come from one dialect
  address(frame, *message, target);
  for (auto const& [field, value] : fields) {
    auto const known = std::ranges::find(message->fields, field, &FieldName::name);
    if (known == message->fields.end()) {
      std::vector<std::string_view> names;
      for (auto const& one : message->fields) names.push_back(one.name);
      return fail(ErrorKind::not_found, fmt::format("{} has no field {}", name, field),
                  base::did_you_mean(field, names));
    }
    if (field == "target_system")
      return fail(ErrorKind::invalid_input, "target_system is the vehicle's", "leave it out");
    if (auto put = put_field(frame, *known, value); !put) {
      put.error().message = fmt::format("{}: {}", name, put.error().message);
      return std::unexpected(put.error());
    }
  }
  return frame;
}

}  // namespace lapwing::mavlink
