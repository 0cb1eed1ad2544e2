#include "robot/old_parts/told_points.hpp"

#include <algorithm>
#include <set>

#include "robot/seed_text/payload.hpp"

namespace lapwing::robot {

namespace {

std::size_t constexpr longest_text = 200;  // bytes; the seed's message takes no more

/// As the seed's messages can have it: without quotation marks, and not longer than they take.
std::string tellable(std::string text) {
  std::ranges::replace(text, '"', '\'');
  auto end = std::min(text.size(), longest_text);
  // Never within a character of UTF-8.
  while (end < text.size() && end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  text.resize(end);
  return text;
}

base::Result<std::string> message_of(Robot const& robot, map::PointOfInterest const& point) {
  auto const at = robot.on_map(point.position);
  auto const kind =
      point.kind == "door" ? seed_text::PointOfInterest::Kind::door : seed_text::PointOfInterest::Kind::name_tag;
  return seed_text::write(seed_text::PointOfInterest{
      .kind = kind, .text = tellable(point.text.empty() ? point.name : point.text), .x_m = at.x(), .y_m = at.y()});
}

}  // namespace

void ToldPoints::update(Robot const& robot, std::vector<map::FeatureRecord const*> const& records) {
  std::set<std::string> there;
  for (auto const* const record : records) {
    auto const* const point = std::get_if<map::PointOfInterest>(&record->feature.content);
    if (point == nullptr || record->feature.account.writer != robot.spec().id) continue;
    auto message = message_of(robot, *point);
    if (!message) continue;
    there.insert(record->feature.id);
    auto& told = points_[record->feature.id];
    if (told.number != 0 && told.message == *message) continue;
    told = {.message = *std::move(message), .number = ++last_number_};
  }
  std::erase_if(points_, [&](auto const& entry) { return !there.contains(entry.first); });
}

std::vector<std::pair<std::uint64_t, std::string>> ToldPoints::after(std::uint64_t number, std::size_t most) const {
  std::vector<std::pair<std::uint64_t, std::string>> found;
  for (auto const& [id, told] : points_)
    if (told.number > number) found.emplace_back(told.number, told.message);
  std::ranges::sort(found);
  if (found.size() > most) found.resize(most);
  return found;
}

}  // namespace lapwing::robot
