#include "sim/mavlink/packed_parameters.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <span>

namespace lapwing::sim {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::string_view file_name = "@PARAM/param.pck";
constexpr std::uint16_t plain_magic = 0x671b;
constexpr std::uint16_t magic_with_defaults = 0x671c;

/// ArduPilot's numbers of the types, not MAVLink's.
struct PackedType {
  std::uint8_t number;
  std::size_t size;
};
PackedType packed_type(mavlink::MavParamType type) {
  switch (type) {
    case mavlink::MavParamType::int8: return {1, 1};
    case mavlink::MavParamType::int16: return {2, 2};
    case mavlink::MavParamType::int32: return {3, 4};
    default: return {4, 4};
  }
}

void append(Bytes& file, auto number) {
  std::array<std::uint8_t, sizeof number> bytes{};
  std::memcpy(bytes.data(), &number, sizeof number);
  file.insert(file.end(), bytes.begin(), bytes.end());
}

void append_value(Bytes& file, float value, PackedType type) {
  if (type.number == 4) return append(file, value);
  auto const whole = static_cast<std::int32_t>(value);
  if (type.size == 1) return append(file, static_cast<std::int8_t>(whole));
  if (type.size == 2) return append(file, static_cast<std::int16_t>(whole));
  append(file, whole);
}

/// One entry: type and flags, how much of the name is the last one's, the rest of it, the value.
Bytes entry_of(Parameter const& parameter, std::string_view last_name, bool with_default) {
  auto const type = packed_type(parameter.type);
  auto const name = std::string_view(parameter.name);
  auto const common = static_cast<std::size_t>(std::ranges::mismatch(name, last_name).in1 - name.begin());
  auto const own = name.substr(common);
  Bytes entry{static_cast<std::uint8_t>(type.number | (with_default ? 0x10U : 0U)),
              static_cast<std::uint8_t>(common | (own.size() - 1) << 4U)};
  entry.insert(entry.end(), own.begin(), own.end());
  append_value(entry, parameter.value, type);
  if (with_default) append_value(entry, parameter.standard, type);
  return entry;
}

}  // namespace

std::optional<PackedSelection> packed_parameters_named(std::string_view path) {
  if (path.starts_with('/')) path.remove_prefix(1);
  if (!path.starts_with(file_name)) return std::nullopt;
  path.remove_prefix(file_name.size());
  PackedSelection selection;
  if (path.empty()) return selection;
  if (path.front() != '?') return std::nullopt;
  while (!path.empty()) {
    path.remove_prefix(1);
    auto const part = path.substr(0, path.find('&'));
    path.remove_prefix(part.size());
    auto const equals = std::min(part.find('='), part.size());
    std::size_t number = 0;
    auto const digits = part.substr(std::min(equals + 1, part.size()));
    auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    auto const key = part.substr(0, equals);
    if (key == "start") selection.start = number;
    if (key == "count") selection.count = number;
    if (key == "withdefaults") selection.with_defaults = number == 1;
  }
  return selection;
}

std::vector<std::uint8_t> pack(ParameterTable const& parameters, PackedSelection const& selection,
                               std::size_t read_size) {
  auto const all = std::span(parameters.all());
  if (selection.start >= all.size()) return {};
  auto const left = all.size() - selection.start;
  auto const chosen = all.subspan(selection.start, selection.count == 0 ? left : std::min(selection.count, left));
  Bytes file;
  append(file, selection.with_defaults ? magic_with_defaults : plain_magic);
  append(file, static_cast<std::uint16_t>(chosen.size()));
  append(file, static_cast<std::uint16_t>(all.size()));
  std::string_view last_name;
  for (auto const& parameter : chosen) {
    bool const differs = selection.with_defaults && parameter.value != parameter.standard;
    auto const entry = entry_of(parameter, last_name, differs);
    auto const value_size = packed_type(parameter.type).size;
    auto const beyond = (file.size() + entry.size()) % read_size;
    if (beyond > 0 && beyond < value_size) file.insert(file.end(), value_size - beyond, 0);
    file.insert(file.end(), entry.begin(), entry.end());
    last_name = parameter.name;
  }
  return file;
}

}  // namespace lapwing::sim
