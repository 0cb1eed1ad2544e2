// "QGC WPL 110": one item a line, twelve columns: index, current, frame, command, parameters 1 to 7, autocontinue.
#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plan/files/internal/plan_reader.hpp"
#include "plan/files/vehicle_plan.hpp"

namespace lapwing::plan::internal {
namespace {

using base::Result;

constexpr std::size_t columns = 12;

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<std::string_view> words;
  for (auto begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
    auto const end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
    if (words.size() > columns) break;  // enough to see that they are too many
  }
  return words;
}

Result<FileItem> item_of(std::vector<std::string_view> const& words, std::size_t index) {
  using base::ErrorKind;
  if (words.size() != columns)
    return base::fail(ErrorKind::invalid_input,
                      fmt::format("an item has {} columns, not {}", columns,
                                  words.size() > columns ? "more" : fmt::to_string(words.size())));
  std::array<double, columns> values{};
  for (std::size_t i = 0; i < columns; ++i) {
    auto const value = number_in(words[i]);
    if (!value)
      return base::fail(ErrorKind::invalid_input, fmt::format("column {}: '{}' is no number", i + 1, words[i]));
    values[i] = *value;
  }
  if (values[0] != static_cast<double>(index))
    return base::fail(ErrorKind::invalid_input, fmt::format("item {} comes where item {} should", values[0], index));
  FileItem item{.command = values[3], .frame = values[2], .params = {}, .autocontinue = values[11] != 0.0};
  std::copy(values.begin() + 4, values.begin() + 11, item.params.begin());
  return item;
}

/// The lines of a text, one after the other, counted from 1.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    auto const end = rest_.find('\n');
    auto const line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    return line;
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// Jumps count from 1 in `Mission`; without a home line the file's count from 0.
Result<> finish_mission(std::string_view file, Plan& plan, bool has_home) {
  for (auto& item : plan.mission.items) {
    if (item.command != mavlink::MavCmd::do_jump) continue;
    if (!has_home) item.params[0] += 1.0F;
    bool const is_inside = item.params[0] >= 1.0F && item.params[0] <= static_cast<float>(plan.mission.items.size());
    if (!is_inside) return wrong(file, fmt::format("a jump leads to item {}, which is not there", item.params[0]));
  }
  return {};
}

/// Ground stations save fences and rally points in the same form, without a home line, each in a file of its own.
Result<PlanFile> finish(std::string_view file, std::vector<mavlink::MissionItem> items, bool has_home) {
  PlanFile read{.plan = {}};
  auto& plan = read.plan;
  auto const list = items.empty() ? mavlink::MissionType::mission : list_of(items.back().command);
  auto const other = [](std::string_view file_name, base::Error const& error) {
    return wrong(file_name, error.message, "a way point file holds a mission, a fence or rally points");
  };
  has_home = has_home && !items.empty() && list_of(items.front().command) == mavlink::MissionType::mission;
  if (has_home) {
    auto const home = position_of(items.front());
    if (is_placed(items.front()) && (home.lat_rad != 0.0 || home.lon_rad != 0.0)) plan.mission.planned_home = home;
    items.erase(items.begin());
  }
  if (list == mavlink::MissionType::fence) {
    auto fence = fence_from(items);
    if (!fence) return other(file, fence.error());
    plan.fence = *std::move(fence);
  } else if (list == mavlink::MissionType::rally) {
    auto rally = rally_from(items);
    if (!rally) return other(file, rally.error());
    plan.rally = *std::move(rally);
  } else {
    plan.mission.items = std::move(items);
    if (auto finished = finish_mission(file, plan, has_home); !finished) return std::unexpected(finished.error());
  }
  return read;
}

}  // namespace

Result<PlanFile> read_way_points(std::string_view file, std::string_view text) {
  Lines lines(text);
  auto heading = words_of(lines.next().value_or(""));
  while (heading.empty()) heading = words_of(*lines.next());
  auto const version = heading.size() == 3 ? heading[2] : std::string_view{};
  bool const has_home = version == "110";
  if (!has_home && version != "120")
    return wrong(fmt::format("{}:{}", file, lines.number()), "this version of way point files is not known",
                 "the first line of the known ones is: QGC WPL 110");
  std::vector<mavlink::MissionItem> items;
  while (auto const line = lines.next()) {
    auto const words = words_of(*line);
    if (words.empty()) continue;
    auto const where = [&] { return fmt::format("{}:{}", file, lines.number()); };
    if (items.size() > max_mission_items) return wrong(where(), "more items than a mission can hold");
    auto const read = item_of(words, items.size());
    if (!read) return wrong(where(), read.error().message);
    auto const item = to_item(*read);
    if (!item) return wrong(where(), item.error().message, item.error().hint);
    items.push_back(*item);
  }
  return finish(file, std::move(items), has_home);
}

std::string write_way_points(Plan const& plan) {
  std::string text = "QGC WPL 110\n";
  std::size_t index = 0;
  auto const add = [&](mavlink::MissionItem const& item) {
    auto const values = from_item(item);
    text += fmt::format("{}\t{}\t{}\t{}\t{}\t{:d}\n", index, index == 0 ? 1 : 0, values.frame, values.command,
                        fmt::join(values.params, "\t"), values.autocontinue);
    ++index;
  };
  if (!plan.mission.items.empty() || plan.mission.planned_home) {
    mavlink::MissionItem home{.command = mavlink::MavCmd::nav_waypoint};
    auto const place = plan.mission.planned_home.value_or(geo::Wgs84{});
    home.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = place.alt_m};
    add(home);
  }
  std::ranges::for_each(plan.mission.items, add);
  std::ranges::for_each(fence_items(plan.fence), add);
  std::ranges::for_each(rally_items(plan.rally), add);
  return text;
}

}  // namespace lapwing::plan::internal
