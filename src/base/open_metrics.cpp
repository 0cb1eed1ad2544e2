#include "base/open_metrics.hpp"

#include <cmath>

#include <fmt/format.h>

namespace lapwing::base {

namespace {

/// Backslash, quote and line feed are the three that a label's value and a help text cannot hold as they are.
void append_escaped(std::string& out, std::string_view text) {
  for (char const c : text) {
    if (c == '\n') {
      out += "\\n";
      continue;
    }
    if (c == '\\' || c == '"') out += '\\';
    out += c;
  }
}

}  // namespace

void OpenMetrics::begin(std::string_view name, std::string_view type, std::string_view help) {
  text_ += fmt::format("# TYPE {} {}\n# HELP {} ", name, type, name);
  append_escaped(text_, help);
  text_ += '\n';
}

void OpenMetrics::counter(std::string_view name, std::string_view help) {
  begin(name, "counter", help);
  sample_name_ = fmt::format("{}_total", name);
}

void OpenMetrics::gauge(std::string_view name, std::string_view help) {
  begin(name, "gauge", help);
  sample_name_ = name;
}

void OpenMetrics::begin_sample(Labels labels) {
  text_ += sample_name_;
  char separator = '{';
  for (auto const& [name, value] : labels) {
    text_ += separator;
    text_ += name;
    text_ += "=\"";
    append_escaped(text_, value);
    text_ += '"';
    separator = ',';
  }
  text_ += labels.size() > 0 ? "} " : " ";
}

void OpenMetrics::sample(Labels labels, std::uint64_t value) {
  begin_sample(labels);
  text_ += fmt::format("{}\n", value);
}

void OpenMetrics::sample(Labels labels, double value) {
  begin_sample(labels);
  if (std::isnan(value))
    text_ += "NaN\n";
  else if (std::isinf(value))
    text_ += value > 0 ? "+Inf\n" : "-Inf\n";
  else
    text_ += fmt::format("{}\n", value);
}

}  // namespace lapwing::base
