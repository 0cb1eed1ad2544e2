#include "base/text/json.hpp"

#include <charconv>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lapwing::base {

namespace {

using Json = nlohmann::ordered_json;

void write(std::string& line, Json const& json) {
  if (json.is_number_float()) {
    auto const value = json.get<double>();
    line += std::isfinite(value) ? fmt::format("{}", value) : "null";
  } else if (json.is_structured()) {
    bool const is_object = json.is_object();
    line += is_object ? '{' : '[';
    std::string_view separator;
    for (auto const& [key, value] : json.items()) {
      line += separator;
      separator = ",";
      if (is_object) line += to_text(Json(key)) + ':';
      write(line, value);
    }
    line += is_object ? '}' : ']';
  } else {
    line += to_text(json);
  }
}

}  // namespace

std::string to_plain_line(Json const& json) {
  std::string line;
  write(line, json);
  return line;
}

double shortest(float value) {
  auto const text = fmt::format("{}", value);
  double near = static_cast<double>(value);  // stays for what is no number
  if (std::isfinite(value)) std::from_chars(text.data(), text.data() + text.size(), near);
  return near;
}

}  // namespace lapwing::base
