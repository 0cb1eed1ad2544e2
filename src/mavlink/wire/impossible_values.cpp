#include "mavlink/wire/impossible_values.hpp"

#include <numbers>

#include <fmt/format.h>

#include "mavlink/wire/dialect_names.hpp"

namespace lapwing::mavlink::internal {

namespace {

base::Duration constexpr silence = std::chrono::minutes(1);
/// Who invents vehicles gets no more lines than this; all is counted.
std::size_t constexpr most_told = 256;

/// Angles in degrees, as people and the wire have them.
std::string in_words(ImpossibleField const& field) {
  if (field.unit == "rad") return fmt::format("{:.6g} deg", field.value * 180.0 / std::numbers::pi);
  return fmt::format("{:.6g}{}{}", field.value, field.unit.empty() ? "" : " ", field.unit);
}

std::string name_of(Address source) {
  if (source.component == autopilot_component) return fmt::format("vehicle {}", source.system);
  return fmt::format("component {} of vehicle {}", source.component, source.system);
}

}  // namespace

std::vector<std::string> ImpossibleValues::note(std::size_t link, Frame const& frame,
                                                std::span<ImpossibleField const> fields, base::TimePoint now) {
  std::vector<std::string> lines;
  for (auto const& field : fields) {
    Field const key{frame.message_id, field.name};
    ++counts_[{link, key}];
    auto told = told_.find({frame.source, key});
    bool const is_new = told == told_.end();
    if (is_new && told_.size() >= most_told) continue;
    if (is_new) told = told_.emplace(std::tuple{frame.source, key}, Told{}).first;
    ++told->second.count;
    if (!is_new && now - told->second.said < silence) continue;
    told->second.said = now;
    auto line = fmt::format("{} tells what cannot be: {}.{} is {}; left out", name_of(frame.source),
                            message_name(frame.message_id), field.name, in_words(field));
    if (!is_new) line += fmt::format(", {} times so far", told->second.count);
    lines.push_back(std::move(line));
  }
  return lines;
}

void ImpossibleValues::report(std::vector<LinkReport>& links) const {
  for (auto const& [key, count] : counts_) {
    auto const& [link, field] = key;
    auto const& [message, name] = field;
    if (link < links.size()) links[link].impossible_values.push_back({message_name(message), name, count});
  }
}

}  // namespace lapwing::mavlink::internal
