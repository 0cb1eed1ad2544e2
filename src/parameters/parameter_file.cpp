#include "parameters/parameter_file.hpp"

#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace lapwing::parameters {

namespace {

using mavlink::MavParamType;

/// Fields of one line, at most one more than any format has.
std::vector<std::string_view> split(std::string_view line, std::string_view separators) {
  constexpr std::size_t most = 6;
  std::vector<std::string_view> fields;
  while (fields.size() < most) {
    auto const begin = line.find_first_not_of(separators);
    if (begin == std::string_view::npos) break;
    auto const end = std::min(line.find_first_of(separators, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
  return fields;
}

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_name(std::string_view text) {
  if (text.empty() || text.size() > mavlink::longest_param_name) return false;
  for (char const c : text)
    if (static_cast<unsigned char>(c) <= ' ' || static_cast<unsigned char>(c) > '~') return false;
  return true;
}

/// What is wrong with one line.
using Complaint = std::string;

class Reader {
 public:
  std::optional<Complaint> take(std::string_view line);
  ParameterFile file;

 private:
  std::optional<Complaint> take_typed(std::vector<std::string_view> const& fields);
  std::optional<Complaint> add(std::string_view name, std::string_view value, MavParamType type);

  std::map<std::string, std::size_t, std::less<>> places_;
};

std::optional<Complaint> Reader::add(std::string_view name, std::string_view value, MavParamType type) {
  if (!is_name(name))
    return fmt::format("'{}' is no parameter's name (1 to {} characters)", name.substr(0, 40),
                       mavlink::longest_param_name);
  auto const parsed = number<double>(value);
  if (!parsed) return fmt::format("'{}' is no number", value.substr(0, 40));
  Parameter const parameter{.name = std::string(name), .value = *parsed, .type = type};
  auto const [place, is_new] = places_.try_emplace(parameter.name, file.parameters.size());
  if (is_new) {
    if (file.parameters.size() == max_file_parameters)
      return fmt::format("more than {} parameters", max_file_parameters);
    file.parameters.push_back(parameter);
  } else if (!mavlink::same_value(file.parameters[place->second], parameter)) {
    return fmt::format("{} was {} before: which is right?", name, value_text(file.parameters[place->second]));
  }
  return std::nullopt;
}

std::optional<Complaint> Reader::take_typed(std::vector<std::string_view> const& fields) {
  auto const component = number<std::uint8_t>(fields[1]);
  auto const type = number<std::uint8_t>(fields[4]);
  if (!number<std::uint8_t>(fields[0]) || !component || !type)
    return "expected vehicle id, component id, name, value, type";
  if (*type < 1 || *type > 10) return fmt::format("{} is no type of parameters (1 to 10)", *type);
  if (*component != mavlink::autopilot_component) {
    ++file.of_other_components;
    return std::nullopt;
  }
  file.has_types = true;
  return add(fields[2], fields[3], MavParamType{*type});
}

std::optional<Complaint> Reader::take(std::string_view line) {
  line = line.substr(0, line.find('#'));
  auto const fields = split(line, " \t\r,");
  if (fields.empty()) return std::nullopt;
  if (fields.size() == 5) return take_typed(fields);
  // Mission Planner marks some with a third word: NAME,VALUE @READONLY
  bool const is_pair = fields.size() == 2 || (fields.size() == 3 && fields[2].starts_with('@'));
  if (is_pair) return add(fields[0], fields[1], MavParamType::real32);
  return "expected NAME,VALUE, or vehicle id, component id, name, value, type";
}

}  // namespace

base::Result<ParameterFile> read_parameter_file(std::string_view file, std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  Reader reader;
  for (int line = 1; !text.empty(); ++line) {
    auto const end = std::min(text.find('\n'), text.size());
    if (auto const complaint = reader.take(text.substr(0, end)))
      return base::fail(base::ErrorKind::invalid_input, fmt::format("{}:{}: {}", file, line, *complaint));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (reader.file.parameters.empty())
    return base::fail(base::ErrorKind::invalid_input, fmt::format("{}: there are no parameters in it", file),
                      "lines are NAME,VALUE (Mission Planner) or five columns with tabs between them (QGroundControl)");
  return std::move(reader.file);
}

std::string qgroundcontrol_text(std::span<Parameter const> parameters, FileHeader const& header) {
  std::string text = fmt::format("# Onboard parameters for Vehicle {}\n#\n", header.system_id);
  if (!header.stack.empty()) text += fmt::format("# Stack: {}\n", header.stack);
  if (!header.vehicle.empty()) text += fmt::format("# Vehicle: {}\n", header.vehicle);
  if (!header.version.empty()) text += fmt::format("# Version: {}\n", header.version);
  text += "#\n# Vehicle-Id Component-Id Name Value Type\n";
  for (auto const& parameter : parameters)
    text += fmt::format("{}\t{}\t{}\t{}\t{}\n", header.system_id, mavlink::autopilot_component, parameter.name,
                        value_text(parameter), static_cast<int>(parameter.type));
  return text;
}

std::string mission_planner_text(std::span<Parameter const> parameters) {
  std::string text;
  for (auto const& parameter : parameters) text += fmt::format("{},{}\n", parameter.name, value_text(parameter));
  return text;
}

}  // namespace lapwing::parameters
