#include "dryrun/internal/drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <boost/geometry/algorithms/simplify.hpp>
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/register/linestring.hpp>
#include <boost/geometry/geometries/register/point.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <nlohmann/json.hpp>

#include "base/text/json.hpp"

BOOST_GEOMETRY_REGISTER_POINT_2D(lapwing::dryrun::internal::Point, double, boost::geometry::cs::cartesian, x, y)
BOOST_GEOMETRY_REGISTER_LINESTRING(lapwing::dryrun::internal::Line)

namespace lapwing::dryrun::internal {

namespace {

constexpr double mean_width = 0.56;  // of a letter, in font sizes

bool begins_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

}  // namespace

std::string escaped(std::string_view text) {
  using Json = nlohmann::json;
  auto const whole =
      Json::parse(base::to_text(Json(text))).get<std::string>();  // what is no UTF-8 is replaced on the way
  std::string out;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    auto const c = whole[i];
    auto const letter = std::string_view(whole).substr(i, 3);
    if (letter == "\uFFFE" || letter == "\uFFFF") {
      out += "\uFFFD";
      i += 2;
    } else if (c == '&' || c == '<' || c == '>') {
      out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : "&gt;";
    } else {
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

double text_width(std::string_view text, double size) {
  return mean_width * size * static_cast<double>(std::ranges::count_if(text, begins_letter));
}

std::string fitted(std::string_view text, double size, double width) {
  if (text_width(text, size) <= width) return std::string(text);
  double room = width / (mean_width * size) - 1.0;  // in letters, beside the ellipsis
  if (room < 1.0) return {};
  auto const end = std::ranges::find_if(text, [&](char byte) { return begins_letter(byte) && (room -= 1.0) < 0.0; });
  return std::string(text.begin(), end) + "…";
}

Line simplified(Line const& line, double tolerance) {
  Line fewer;
  boost::geometry::simplify(line, fewer, tolerance);
  return fewer;
}

double Drawing::shown(double value) {
  return std::round(value * 10.0) / 10.0 + 0.0;  // no negative zero
}

std::string Drawing::shown(Point point) {
  return fmt::format("{} {}", shown(point.x), shown(point.y));
}

std::string Drawing::shown(Line const& line) {
  std::string path;
  for (auto const& point : line) path += (path.empty() ? "M" : "L") + shown(point);
  return path;
}

std::string Drawing::shown(std::vector<Line> const& rings) {
  std::string path;
  for (auto const& ring : rings) path += shown(ring) + "Z";
  return path;
}

bool Labels::write(Drawing& drawing, Point anchor, std::string_view words, double size, double gap,
                   std::string_view css_class) {
  double const width = text_width(words, size);
  double const right = anchor.x + gap;
  double const left = anchor.x - gap - width;
  double const middle = anchor.x - width / 2.0;
  std::array const corners{Point{right, anchor.y - gap - size},      Point{right, anchor.y + gap},
                           Point{left, anchor.y - gap - size},       Point{left, anchor.y + gap},
                           Point{right, anchor.y - size / 2.0},      Point{left, anchor.y - size / 2.0},
                           Point{middle, anchor.y - 2 * gap - size}, Point{middle, anchor.y + 2 * gap}};
  auto const is_free = [&](Point corner) {
    Box const box{corner, width, size};
    return area_.contains(corner) && area_.contains(Point{box.right(), box.bottom()}) &&
           std::ranges::none_of(taken_, [&](Box const& other) { return other.meets(box); });
  };
  auto const at = std::ranges::find_if(corners, is_free);
  if (at == corners.end()) return false;
  occupy({*at, width, size});
  // Letters stand on four fifths of the height.
  drawing.add(R"(<text x="{}" y="{}" class="{}">{}</text>)", at->x, at->y + 0.8 * size, css_class, words);
  return true;
}

}  // namespace lapwing::dryrun::internal
