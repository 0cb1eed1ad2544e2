#include "plan/files/internal/json_node.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::plan::internal {

using base::Result;

Result<Node> Node::member(char const* key) const {
  if (!value_->is_object()) return wrong(path_, "an object { ... } was expected");
  auto const found = value_->find(key);
  if (found == value_->end()) return wrong(path_, fmt::format("\"{}\" is missing", key));
  return Node(*found, join(key));
}

Result<Node> Node::list(char const* key) const {
  auto found = member(key);
  if (found && !found->value_->is_array()) return wrong(found->path_, "a list [ ... ] was expected");
  return found;
}

Result<Node> Node::list_or_none(char const* key) const {
  static Json const none = Json::array();
  if (!has(key)) return Node(none, join(key));
  return list(key);
}

Result<double> Node::number(char const* key) const {
  auto const found = member(key);
  if (!found) return std::unexpected(found.error());
  if (!found->value_->is_number()) return wrong(found->path_, "a number was expected");
  return found->value_->get<double>();
}

double Node::number_or(char const* key, double otherwise) const {
  return has(key) && (*value_)[key].is_number() ? (*value_)[key].get<double>() : otherwise;
}

bool Node::flag_or(char const* key, bool otherwise) const {
  return has(key) && (*value_)[key].is_boolean() ? (*value_)[key].get<bool>() : otherwise;
}

std::string Node::text_or(char const* key, std::string otherwise) const {
  return has(key) && (*value_)[key].is_string() ? (*value_)[key].get<std::string>() : std::move(otherwise);
}

Result<std::vector<double>> Node::numbers(std::size_t most) const {
  if (!value_->is_array()) return wrong(path_, "a list [ ... ] was expected");
  if (size() > most) return wrong(path_, fmt::format("at most {} numbers were expected", most));
  std::vector<double> values;
  for (std::size_t i = 0; i < size(); ++i) {
    auto const& value = (*value_)[i];
    if (!value.is_number() && !value.is_null()) return wrong(item(i).path_, "a number was expected");
    values.push_back(value.is_null() ? unset : value.get<double>());
  }
  return values;
}

Result<std::vector<double>> Node::numbers(char const* key, std::size_t most) const {
  auto const found = list(key);
  if (!found) return std::unexpected(found.error());
  return found->numbers(most);
}

Result<geo::Wgs84> Node::place() const {
  auto const values = numbers(3);
  if (!values) return std::unexpected(values.error());
  if (values->size() < 2) return wrong(path_, "latitude, longitude and height were expected");
  double const alt_m = values->size() == 3 && !std::isnan((*values)[2]) ? (*values)[2] : 0.0;
  auto const place = to_place((*values)[0], (*values)[1], alt_m);
  if (!place) return wrong(path_, place.error().message);
  return place;
}

Result<geo::Wgs84> Node::place(char const* key) const {
  auto const found = list(key);
  if (!found) return std::unexpected(found.error());
  return found->place();
}

namespace {

/// "a.plan:3:7", from the number of bytes read.
std::string position_in(std::string_view text, std::size_t bytes) {
  auto const read = text.substr(0, bytes > 0 ? bytes - 1 : 0);
  auto const line_begin = read.rfind('\n');
  return fmt::format("{}:{}", 1 + std::ranges::count(read, '\n'),
                     read.size() - (line_begin == std::string_view::npos ? 0 : line_begin + 1) + 1);
}

Result<Json> parse(std::string_view file, std::string_view text) {
  // Who writes a value calls itself for each level of it.
  constexpr int deepest = 64;
  bool is_too_deep = false;
  auto const look = [&](int depth, Json::parse_event_t, Json&) {
    is_too_deep = is_too_deep || depth > deepest;
    return !is_too_deep;
  };
  // The library reports errors by exceptions; they end here.
  try {
    auto json = Json::parse(text, look);
    if (is_too_deep) return wrong(file, fmt::format("values are nested deeper than {}", deepest));
    return json;
  } catch (Json::parse_error const& error) {
    return wrong(fmt::format("{}:{}", file, position_in(text, error.byte)), "this is no JSON",
                 "a plan is a file of QGroundControl (.plan), GeoJSON, KML, or way points beginning with QGC WPL 110");
  } catch (Json::exception const&) {
    return wrong(file, "a number in it is too large");
  }
}

}  // namespace

Result<PlanFile> read_json_plan(std::string_view file, std::string_view text, PlanReadOptions const& options) {
  auto const parsed = parse(file, text);
  if (!parsed) return std::unexpected(parsed.error());
  Node const root(*parsed, std::string(file), true);
  if (root.text_or("fileType", "") == "Plan") return read_qgc_plan(file, *parsed);
  if (root.has("type")) return read_geojson(file, *parsed, options);
  return wrong(file, "this is no plan: neither \"fileType\" is \"Plan\" nor is there a GeoJSON \"type\"",
               "save it with QGroundControl's plan view, or as GeoJSON");
}

}  // namespace lapwing::plan::internal
