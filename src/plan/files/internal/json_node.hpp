#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text/json.hpp"
#include "plan/files/internal/plan_reader.hpp"

namespace lapwing::plan::internal {

/// Sorted by key, as QGroundControl writes its files; files of strangers with very many keys are read without delay.
using Json = nlohmann::json;

inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// A value of a file with its path for messages, which JSON's own values do not know: "a.plan: mission.items[3]".
class Node {
 public:
  Node(Json const& value, std::string path, bool is_root = false)
      : value_(&value), path_(std::move(path)), is_root_(is_root) {}

  [[nodiscard]] Json const& json() const { return *value_; }
  [[nodiscard]] std::string const& path() const { return path_; }
  [[nodiscard]] std::size_t size() const { return value_->size(); }
  [[nodiscard]] bool has(char const* key) const { return value_->is_object() && value_->contains(key); }
  [[nodiscard]] Node item(std::size_t index) const { return {(*value_)[index], fmt::format("{}[{}]", path_, index)}; }
  [[nodiscard]] base::Result<Node> member(char const* key) const;
  [[nodiscard]] base::Result<Node> list(char const* key) const;
  /// An empty list where there is none.
  [[nodiscard]] base::Result<Node> list_or_none(char const* key) const;
  [[nodiscard]] base::Result<double> number(char const* key) const;
  [[nodiscard]] double number_or(char const* key, double otherwise) const;
  [[nodiscard]] bool flag_or(char const* key, bool otherwise) const;
  [[nodiscard]] std::string text_or(char const* key, std::string otherwise) const;
  /// Of this list of numbers; null stands for NaN.
  [[nodiscard]] base::Result<std::vector<double>> numbers(std::size_t most) const;
  [[nodiscard]] base::Result<std::vector<double>> numbers(char const* key, std::size_t most) const;
  /// Of this list: latitude, longitude and height, which may be missing.
  [[nodiscard]] base::Result<geo::Wgs84> place() const;
  [[nodiscard]] base::Result<geo::Wgs84> place(char const* key) const;

 private:
  [[nodiscard]] std::string join(char const* key) const {
    return fmt::format("{}{}{}", path_, is_root_ ? ": " : ".", key);
  }
  Json const* value_;
  std::string path_;
  bool is_root_;
};

[[nodiscard]] base::Result<PlanFile> read_qgc_plan(std::string_view file, Json const& json);
/// How many items of a mission an item of a .plan file is. Errors: it is none.
[[nodiscard]] base::Result<std::size_t> count_items(Json const& item, std::string const& path);
[[nodiscard]] base::Result<PlanFile> read_geojson(std::string_view file, Json const& json,
                                                  PlanReadOptions const& options);

/// What the pattern was drawn from, with the mission's items in it.
[[nodiscard]] Json pattern_json(Plan const& plan, Pattern const& pattern);

}  // namespace lapwing::plan::internal
