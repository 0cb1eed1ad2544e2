#include "video/camera/pose_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <ranges>

#include <fmt/format.h>

#include "base/text/printable.hpp"
#include "base/text/utc_text.hpp"

namespace lapwing::video {

namespace {

constexpr std::size_t columns = 8;
constexpr std::size_t first_number = 2;
constexpr double farthest_m = 100'000.0;
constexpr double full_turn_deg = 360.0;

using Cells = std::array<std::string_view, columns>;

std::unexpected<base::Error> wrong(std::size_t line, std::string what) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("line {} of the table of poses: {}", line, what),
                    fmt::format("its columns are {}", pose_columns));
}

std::optional<Cells> cells_of(std::string_view line) {
  Cells cells;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < columns; ++i) {
    auto const end = line.find(',', begin);
    if ((end == std::string_view::npos) != (i + 1 == columns)) return std::nullopt;
    cells[i] = line.substr(begin, end - begin);
    begin = end + 1;
  }
  return cells;
}

/// A name within the folder: with a path a table could name any file of the machine.
bool is_plain_name(std::string_view name) {
  constexpr std::size_t longest = 200;
  return !name.empty() && name.size() <= longest && name != "." && name != ".." &&
         name.find_first_of("/\\") == std::string_view::npos && !name.contains('\0');
}

/// The six numbers of a pose, each within its limit.
std::optional<std::array<double, columns - first_number>> numbers_of(Cells const& cells) {
  std::array<double, columns - first_number> numbers = {};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    auto const cell = cells[first_number + i];
    constexpr std::size_t places = 3;
    double const limit = i < places ? farthest_m : full_turn_deg;
    auto const [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), numbers[i]);
    if (error != std::errc() || end != cell.data() + cell.size() || !(std::abs(numbers[i]) <= limit))
      return std::nullopt;
  }
  return numbers;
}

base::Result<ListedPicture> picture_of(std::string_view line, std::size_t number) {
  auto const cells = cells_of(line);
  if (!cells) return wrong(number, fmt::format("it has not {} values", columns));
  if (!is_plain_name((*cells)[0]))
    return wrong(number, fmt::format("\"{}\" is no file in the folder",
                                     base::printable(std::string((*cells)[0].substr(0, 60)))));
  auto const at = base::utc_from_text((*cells)[1]);
  if (!at) return wrong(number, "its time is not as in 2026-11-21T10:12:52.123Z");
  ListedPicture picture{.file = std::string((*cells)[0]), .at = *at};
  if (std::ranges::all_of(*cells | std::views::drop(first_number), &std::string_view::empty)) return picture;
  auto const numbers = numbers_of(*cells);
  if (!numbers)
    return wrong(number, fmt::format("its pose is not three places within {} m and three angles within {} degrees",
                                     farthest_m, full_turn_deg));
  constexpr double degree = std::numbers::pi / 180.0;
  auto const& n = *numbers;
  picture.site_from_camera =
      geo::camera_at(geo::Point3<geo::SiteFrame>(n[0], n[1], n[2]), n[3] * degree, n[4] * degree, n[5] * degree);
  return picture;
}

}  // namespace

base::Result<std::vector<ListedPicture>> pictures_of_table(std::string_view text) {
  std::vector<ListedPicture> pictures;
  std::size_t number = 0;
  while (!text.empty()) {
    auto const end = text.find('\n');
    auto line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number;
    if (number == 1) {
      if (line != pose_columns) return wrong(number, "it does not name the columns");
      continue;
    }
    if (line.empty()) continue;
    if (pictures.size() == most_pictures)
      return wrong(number, fmt::format("there are more than {} pictures", most_pictures));
    auto picture = picture_of(line, number);
    if (!picture) return std::unexpected(picture.error());
    pictures.push_back(std::move(*picture));
  }
  if (number == 0) return wrong(1, "the table is empty");
  return pictures;
}

}  // namespace lapwing::video
