#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace lapwing::base {

/// Text for a program that collects metrics, such as Prometheus, in the OpenMetrics format 1.0
/// (https://github.com/prometheus/OpenMetrics/blob/main/specification/OpenMetrics.md).
///
/// Begin a family, add its samples, begin the next: samples of one family stand together, as the format demands.
class OpenMetrics {
 public:
  struct Label {
    std::string_view name;   ///< [a-zA-Z_][a-zA-Z0-9_]*
    std::string_view value;  ///< any UTF-8
  };
  using Labels = std::initializer_list<Label>;

  /// A value that only grows; its samples are called `name` with "_total" behind it.
  void counter(std::string_view name, std::string_view help);
  /// A value that goes up and down.
  void gauge(std::string_view name, std::string_view help);

  /// Of the family begun last. A set of labels comes once in a family.
  void sample(Labels labels, std::uint64_t value);
  void sample(Labels labels, double value);

  /// Everything so far, with the mark of the end.
  [[nodiscard]] std::string text() const { return text_ + "# EOF\n"; }
  static constexpr std::string_view content_type = "application/openmetrics-text; version=1.0.0; charset=utf-8";

 private:
  void begin(std::string_view name, std::string_view type, std::string_view help);
  void begin_sample(Labels labels);

  std::string text_;
  std::string sample_name_;
};

}  // namespace lapwing::base
