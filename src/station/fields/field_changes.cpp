#include "station/fields/field_changes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lapwing::station::internal {

void FieldChanges::begin(std::uint64_t revision) {
  revision_ = revision;
  ++looks_;
  line_ = lines_.size();
  has_news_ = false;
}

/// What is not told any more is news when it comes back, whatever it is then.
void FieldChanges::forget_unseen() {
  for (auto& line : lines_) {
    if (line.seen != looks_) line.changed = line.told = 0;
  }
}

/// Tables keep their order: the line that is looked for is mostly the one behind the last.
std::size_t FieldChanges::place_of(std::string_view key) const {
  auto const next = line_ + 1 < lines_.size() ? line_ + 1 : 0;
  if (next < lines_.size() && lines_[next].key == key) return next;
  auto const found = std::ranges::find(lines_, key, &Line::key);
  return static_cast<std::size_t>(found - lines_.begin());
}

FieldChanges::News FieldChanges::news_of(std::string_view key, std::uint64_t since) const {
  line_ = place_of(key);
  if (line_ == lines_.size()) return {};
  return {.value = lines_[line_].changed > since, .age = lines_[line_].told > since};
}

bool FieldChanges::wants(Member const& member) {
  if (depth_ > 0) {
    add_text(member.key);
    return true;
  }
  line_ = place_of(member.key);
  if (line_ == lines_.size()) lines_.push_back({.key = std::string(member.key)});
  heard_ = member.heard;
  value_.clear();
  return true;
}

void FieldChanges::number(Member const&, std::optional<double> value, Unit const& unit) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double const told = value && std::isfinite(*value) ? rounded(*value, unit) : none;
  add(&told, sizeof told);
  end_value();
}

void FieldChanges::flag(Member const&, bool value) {
  add(&value, sizeof value);
  end_value();
}

void FieldChanges::text(Member const&, std::string_view value) {
  add_text(value);
  end_value();
}

void FieldChanges::word(Member const&, std::string_view value, Words const&) {
  add_text(value);
  end_value();
}

void FieldChanges::begin_object(Member const&, Type const&) {
  ++depth_;
  add("{", 1);
}

void FieldChanges::begin_list(Member const&, Unique) {
  ++depth_;
  add("[", 1);
}

void FieldChanges::end() {
  --depth_;
  add("]", 1);
  end_value();
}

void FieldChanges::add(void const* bytes, std::size_t size) {
  value_.append(static_cast<char const*>(bytes), size);
}

void FieldChanges::add_text(std::string_view text) {
  auto const size = text.size();
  add(&size, sizeof size);
  value_.append(text);
}

/// Of a whole line, unless it is within one.
void FieldChanges::end_value() {
  if (depth_ > 0) return;
  auto& line = lines_[line_];
  line.seen = looks_;
  bool const is_first = line.changed == 0;
  if (is_first || line.value != value_) {
    line.changed = line.told = revision_;
    std::swap(line.value, value_);
  } else if (line.heard != heard_) {
    line.told = revision_;
  }
  line.heard = heard_;
  has_news_ = has_news_ || line.told == revision_;
}

}  // namespace lapwing::station::internal
