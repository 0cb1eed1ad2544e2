#include "station/past/feature_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "map/features/layer_kind.hpp"

namespace lapwing::station {

namespace {

using Json = nlohmann::json;
using Features = std::map<std::string, Json>;

/// When, by whom and how surely it was told.
constexpr std::array<std::string_view, 10> asides = {
    "at",         "writer",           "held_over",        "seen_at",         "seen_by", "taken_probability",
    "confidence", "covariance_xx_m2", "covariance_xy_m2", "covariance_yy_m2"};

/// A centimetre: what is measured again lies a little elsewhere each time.
constexpr double alike_deg = 1e-7;

Features features_of(std::vector<map::Store::Shown> const& frames, std::string const& feed) {
  Features features;
  for (auto const& frame : frames) {
    if (frame.is_binary || frame.feed != feed) continue;
    auto const message = Json::parse(frame.content, nullptr, false);
    if (!message.is_object()) continue;
    if (message.value("full", false)) features.clear();
    for (auto const& feature : message.value("features", Json::array()))
      if (feature.contains("id") && feature["id"].is_string()) features[feature["id"]] = feature;
    for (auto const& id : message.value("removed", Json::array()))
      if (id.is_string()) features.erase(id.get<std::string>());
  }
  return features;
}

bool is_alike(Json const& a, Json const& b) {
  if (a.is_number() && b.is_number()) return std::abs(a.get<double>() - b.get<double>()) <= alike_deg;
  if (a.is_array() && b.is_array())
    return std::ranges::equal(a, b, [](Json const& one, Json const& other) { return is_alike(one, other); });
  if (!a.is_object() || !b.is_object()) return a == b;
  return a.size() == b.size() && std::ranges::all_of(a.items(), [&](auto const& item) {
           return b.contains(item.key()) && is_alike(item.value(), b[item.key()]);
         });
}

/// Names of what differs; "geometry" among them.
std::vector<std::string> differences(Json const& before, Json const& after) {
  std::vector<std::string> names;
  if (!is_alike(before.value("geometry", Json()), after.value("geometry", Json()))) names.emplace_back("geometry");
  auto all = before.value("properties", Json::object());
  all.update(after.value("properties", Json::object()));
  for (auto const& [name, value] : all.items()) {
    if (std::ranges::find(asides, name) != asides.end()) continue;
    auto const pointer = Json::json_pointer("/properties") / name;
    bool const is_same = before.contains(pointer) && after.contains(pointer) && before[pointer] == after[pointer];
    if (!is_same) names.push_back(name);
  }
  return names;
}

class Comparison {
 public:
  explicit Comparison(std::size_t most) : most_(most) {}

  void layer(std::string_view name, Features const& before, Features const& after) {
    Json added = Json::array();
    Json changed = Json::array();
    Json removed = Json::array();
    for (auto const& [id, feature] : after) {
      auto const known = before.find(id);
      if (known == before.end()) {
        note(added, feature);
      } else if (auto names = differences(known->second, feature); !names.empty()) {
        note(changed, {{"before", known->second}, {"after", feature}, {"properties", std::move(names)}});
      }
    }
    for (auto const& [id, feature] : before)
      if (!after.contains(id)) note(removed, feature);
    if (added.empty() && changed.empty() && removed.empty()) return;
    layers_.push_back({{"layer", name},
                       {"added", std::move(added)},
                       {"changed", std::move(changed)},
                       {"removed", std::move(removed)}});
  }
  [[nodiscard]] FeatureChanges result() const {
    return {.layers = layers_.dump(-1, ' ', false, Json::error_handler_t::replace), .left_out = left_out_};
  }

 private:
  void note(Json& list, Json what) {
    if (noted_ >= most_) {
      ++left_out_;
      return;
    }
    ++noted_;
    list.push_back(std::move(what));
  }

  std::size_t most_;
  std::size_t noted_ = 0;
  std::size_t left_out_ = 0;
  Json layers_ = Json::array();
};

}  // namespace

FeatureChanges feature_changes(std::vector<map::Store::Shown> const& before,
                               std::vector<map::Store::Shown> const& after, std::size_t most) {
  Comparison comparison(most);
  for (auto const kind : map::all_layers) {
    if (kind == map::LayerKind::tracks) continue;
    auto const feed = "map." + std::string(map::name_of(kind));
    comparison.layer(map::name_of(kind), features_of(before, feed), features_of(after, feed));
  }
  return comparison.result();
}

}  // namespace lapwing::station
