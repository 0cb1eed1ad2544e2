// "QGC WPL 110": one item a line, twelve columns: index, current, frame, command, parameters 1 to 7, autocontinue.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "plan/internal/plan_reader.hpp"

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

std::optional<double> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  auto const [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

Result<FileItem> item_of(std::vector<std::string_view> const& words, std::size_t index) {
  using base::ErrorKind;
  if (words.size() != columns)
    return base::fail(ErrorKind::invalid_input,
                      fmt::format("an item has {} columns, not {}", columns,
                                  words.size() > columns ? "more" : fmt::to_string(words.size())));
  std::array<double, columns> values{};
  for (std::size_t i = 0; i < columns; ++i) {
    auto const value = number(words[i]);
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
Result<> finish(std::string_view file, PlanFile& plan, bool has_home) {
  for (auto& item : plan.mission.items) {
    if (item.command != mavlink::MavCmd::do_jump) continue;
    if (!has_home) item.params[0] += 1.0F;
    bool const is_inside = item.params[0] >= 1.0F && item.params[0] <= static_cast<float>(plan.mission.items.size());
    if (!is_inside) return wrong(file, fmt::format("a jump leads to item {}, which is not there", item.params[0]));
  }
  return {};
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
  PlanFile plan;
  for (std::size_t index = 0; auto const line = lines.next();) {
    auto const words = words_of(*line);
    if (words.empty()) continue;
    auto const where = [&] { return fmt::format("{}:{}", file, lines.number()); };
    if (index > max_mission_items) return wrong(where(), "more items than a mission can hold");
    auto const read = item_of(words, index);
    if (!read) return wrong(where(), read.error().message);
    auto const item = to_item(*read);
    if (!item) return wrong(where(), item.error().message, item.error().hint);
    if (index++ > 0 || !has_home) {
      plan.mission.items.push_back(*item);
    } else if (item->place.lat_rad != 0.0 || item->place.lon_rad != 0.0) {
      plan.mission.planned_home = position_of(*item);
    }
  }
  if (auto finished = finish(file, plan, has_home); !finished) return std::unexpected(finished.error());
  return plan;
}

}  // namespace lapwing::plan::internal
