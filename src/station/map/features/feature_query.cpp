#include "station/map/features/feature_query.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"

namespace lapwing::station {

namespace {

std::unexpected<base::Error> wrong(std::string message, std::string hint = {}) {
  return base::fail(base::ErrorKind::invalid_input, std::move(message), std::move(hint));
}

base::Result<std::size_t> whole_number(std::string_view name, std::string_view text, std::size_t least) {
  std::size_t value = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < least)
    return wrong(fmt::format("\"{}\" must be a whole number from {} on", name, least));
  return value;
}

std::unexpected<base::Error> unknown_parameter(map::LayerKind layer, std::string_view name) {
  std::string known = "site, floor, bbox, datetime, writer, limit, offset";
  for (auto const& property : map::properties_of(layer)) known += fmt::format(", {}", property.name);
  return wrong(fmt::format("there is no parameter \"{}\"", name), fmt::format("there are {}", known));
}

/// One parameter into the query.
base::Result<> take(FeatureQuery& query, HttpRequest::Parameter const& parameter) {
  auto const& [name, value] = parameter;
  if (name == "site") {
    query.site = value;
  } else if (name == "floor") {
    query.floor = value;
  } else if (name == "writer") {
    query.writer = value;
  } else if (name == "bbox") {
    auto box = lon_lat_box(value);
    if (!box) return std::unexpected(box.error());
    query.box = *box;
  } else if (name == "datetime") {
    auto times = period(value);
    if (!times) return std::unexpected(times.error());
    query.period = *times;
  } else if (name == "limit" || name == "offset") {
    auto const number = whole_number(name, value, name == "limit" ? 1 : 0);
    if (!number) return std::unexpected(number.error());
    (name == "limit" ? query.limit : query.offset) = *number;
  } else if (name == "f") {
    if (value != "json") return wrong(fmt::format("there is no format \"{}\"", value), "there is json");
  } else {
    auto const* const property = map::property_named(query.layer, name);
    if (!property) return unknown_parameter(query.layer, name);
    query.properties.emplace_back(property, value);
  }
  return {};
}

bool is_wanted(FeatureQuery const& query, map::FeatureRecord const& record, geo::Site const& site) {
  auto const& feature = record.feature;
  if (!query.floor.empty() && feature.floor != query.floor) return false;
  if (query.writer && feature.account.writer != *query.writer) return false;
  if (!query.period.contains(feature.account.at)) return false;
  for (auto const& [property, wanted] : query.properties)
    if (!is_value(property->get(feature.content), wanted)) return false;
  return !query.box || query.box->meets(lon_lat_bounds(map::geometry_of(feature.content), site));
}

}  // namespace

bool is_value(map::PropertyValue const& value, std::string_view wanted) {
  struct Same {
    std::string_view wanted;
    bool operator()(std::monostate) const { return false; }
    bool operator()(bool is) const { return wanted == (is ? "true" : "false"); }
    bool operator()(std::int64_t number) const { return wanted == fmt::format("{}", number); }
    bool operator()(double number) const {
      double other = 0.0;
      auto const [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), other);
      return error == std::errc{} && end == wanted.data() + wanted.size() && other == number;
    }
    bool operator()(std::string const& text) const { return wanted == text; }
    bool operator()(base::UtcTime time) const { return base::utc_from_text(wanted) == time; }
  };
  return std::visit(Same{wanted}, value);
}

base::Result<FeatureQuery> feature_query(map::LayerKind layer, HttpRequest const& request) {
  FeatureQuery query{.layer = layer, .limit = FeatureQuery::usual_limit};
  auto const parameters = request.parameters();
  if (!parameters) return wrong("the address is badly encoded");
  for (std::size_t i = 0; i < parameters->size(); ++i) {
    auto const& name = (*parameters)[i].name;
    auto const same = [&](auto const& other) { return other.name == name; };
    if (std::any_of(parameters->begin(), parameters->begin() + static_cast<std::ptrdiff_t>(i), same))
      return wrong(fmt::format("\"{}\" stands twice in the address", name));
    if (auto taken = take(query, (*parameters)[i]); !taken) return std::unexpected(taken.error());
  }
  query.limit = std::min(query.limit, FeatureQuery::most);
  return query;
}

FeaturePage find_features(map::LiveMap const& map, FeatureQuery const& query) {
  FeaturePage page;
  for (auto const& [id, site] : map.sites()) {
    if (!query.site.empty() && id != query.site) continue;
    auto const reach = query.box ? reach_of(*query.box, site) : SiteReach{};
    if (reach.is_empty) continue;
    for (auto const* record : map.within(query.layer, id, reach.box, std::numeric_limits<std::size_t>::max())) {
      if (!is_wanted(query, *record, site)) continue;
      if (page.matched >= query.offset && page.records.size() < query.limit) page.records.push_back(record);
      ++page.matched;
    }
  }
  return page;
}

}  // namespace lapwing::station
