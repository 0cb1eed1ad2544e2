#include "autonomy/settings/heights_text.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/config.hpp"
#include "base/crc32.hpp"

namespace lapwing::autonomy {

namespace {

constexpr std::string_view checksum_begin = "# crc32 = ";
std::size_t constexpr checksum_line = checksum_begin.size() + 8 + 1;

std::string checksum_of(std::string_view content) {
  return fmt::format("{}{:08x}\n", checksum_begin, base::crc32(content));
}

std::unexpected<base::Error> unreadable(std::string const& name, std::string_view why) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("{}: {}", name, why),
                    "configure the hover heights again");
}

/// What stands before the checksum, when that is right.
std::optional<std::string_view> checked(std::string_view text) {
  if (text.size() < checksum_line) return std::nullopt;
  auto const content = text.substr(0, text.size() - checksum_line);
  if (text.substr(content.size()) != checksum_of(content)) return std::nullopt;
  return content;
}

}  // namespace

std::string to_text(HoverHeights const& heights) {
  auto text = fmt::format(
      "# The drone's hover heights in metres, written by itself. By hand they are changed with Configure.\n"
      "min_hover_height_m = {}\ndesired_hover_height_m = {}\nmax_hover_height_m = {}\n",
      heights.min_m, heights.desired_m, heights.max_m);
  return text + checksum_of(text);
}

base::Result<HoverHeights> parse_heights(std::string const& name, std::string_view text) {
  if (text.size() > longest_settings) return unreadable(name, "it is too long for hover heights");
  auto const content = checked(text);
  if (!content) return unreadable(name, "it is cut off or was changed: its checksum is wrong");
  base::SourceFile const source(name, std::string(*content));
  base::Diagnostics diagnostics(source);
  auto const root = base::parse_config(source, diagnostics);
  base::ConfigReader reader(root, diagnostics);
  double constexpr most = std::numeric_limits<double>::max();
  auto const min = reader.number("min_hover_height_m", -most, most);
  auto const desired = reader.number("desired_hover_height_m", -most, most);
  auto const max = reader.number("max_hover_height_m", -most, most);
  reader.refuse_unknown();
  if (diagnostics.has_errors()) return unreadable(name, diagnostics.sorted().front().message);
  if (!min || !desired || !max) return unreadable(name, "a hover height is missing");
  HoverHeights const heights{min->value, desired->value, max->value};
  if (auto const fault = heights_fault(heights)) return unreadable(name, *fault);
  return heights;
}

}  // namespace lapwing::autonomy
