#include "station/fields/field_json.hpp"

#include <cmath>
#include <utility>

namespace lapwing::station::internal {

FieldJson::FieldJson(Json& into, base::TimePoint now, Choose choose)
    : now_(now), choose_(std::move(choose)), open_{&into} {}

void FieldJson::finish() {
  if (!ages_.empty()) (*open_.front())["age_s"] = std::move(ages_);
}

bool FieldJson::wants(Member const& member) {
  bool const is_line = open_.size() == 1;
  if (!is_line) return true;
  auto const news = choose_ ? choose_(member.key) : News{};
  if (news.age && member.heard)
    ages_[std::string(member.key)] = rounded(base::to_seconds(now_ - *member.heard), seconds(3));
  return news.value;
}

void FieldJson::number(Member const& member, std::optional<double> value, Unit const& unit) {
  if (!value || !std::isfinite(*value)) return (void)put(member, nullptr);
  double const near = rounded(*value, unit);
  put(member, unit.decimals <= 0 ? base::json_number<Json>(near) : Json(near));
}

void FieldJson::flag(Member const& member, bool value) {
  put(member, value);
}

void FieldJson::text(Member const& member, std::string_view value) {
  put(member, value);
}

void FieldJson::word(Member const& member, std::string_view value, Words const&) {
  put(member, value);
}

void FieldJson::begin_object(Member const& member, Type const&) {
  open_.push_back(&put(member, Json::object()));
}

void FieldJson::begin_list(Member const& member, Unique) {
  open_.push_back(&put(member, Json::array()));
}

void FieldJson::end() {
  open_.pop_back();
}

Json& FieldJson::put(Member const& member, Json value) {
  auto& parent = *open_.back();
  if (parent.is_array()) return parent.emplace_back(std::move(value));
  return parent[std::string(member.key)] = std::move(value);
}

}  // namespace lapwing::station::internal
