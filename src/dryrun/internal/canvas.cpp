#include "dryrun/internal/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace lapwing::dryrun::internal {

namespace {

/// One decimal is a tenth of a pixel: finer than any screen shows at the size it is drawn for.
std::string coordinate(double value) {
  auto text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string path_of(std::span<Point const> points) {
  std::string path;
  for (auto const& point : points)
    path += fmt::format("{}{} {}", path.empty() ? "M" : "L", coordinate(point.x), coordinate(point.y));
  return path;
}

/// Bytes of the character that begins here; 0 when it is no UTF-8.
std::size_t character_length(std::string_view text) {
  auto const byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  auto const follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  if (byte(0) < 0x80U) return 1;
  if (byte(0) >= 0xC2U && byte(0) < 0xE0U && follows(1)) return 2;
  if (byte(0) >= 0xE0U && byte(0) < 0xF0U && follows(1) && follows(2)) {
    bool const overlong = byte(0) == 0xE0U && byte(1) < 0xA0U;
    bool const surrogate = byte(0) == 0xEDU && byte(1) >= 0xA0U;
    bool const noncharacter = byte(0) == 0xEFU && byte(1) == 0xBFU && byte(2) >= 0xBEU;
    return overlong || surrogate || noncharacter ? 0 : 3;
  }
  if (byte(0) >= 0xF0U && byte(0) < 0xF5U && follows(1) && follows(2) && follows(3)) {
    bool const overlong = byte(0) == 0xF0U && byte(1) < 0x90U;
    bool const beyond = byte(0) == 0xF4U && byte(1) >= 0x90U;
    return overlong || beyond ? 0 : 4;
  }
  return 0;
}

double distance_to_line(Point point, Point a, Point b) {
  double const x = b.x - a.x;
  double const y = b.y - a.y;
  double const square = x * x + y * y;
  double const along = square > 0.0 ? std::clamp(((point.x - a.x) * x + (point.y - a.y) * y) / square, 0.0, 1.0) : 0.0;
  return std::hypot(point.x - a.x - along * x, point.y - a.y - along * y);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    auto const length = character_length(text);
    char const c = text.front();
    bool const is_control = static_cast<unsigned char>(c) < 0x20;
    if (length == 0 || is_control) {
      out += is_control ? " " : "\uFFFD";
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

double text_width(std::string_view text, double size) {
  constexpr double mean_width = 0.56;  // of a letter, in font sizes
  auto const letters = std::ranges::count_if(text, [](char c) { return (static_cast<unsigned>(c) & 0xC0U) != 0x80U; });
  return mean_width * size * static_cast<double>(letters);
}

std::string fitted(std::string_view text, double size, double width) {
  if (text_width(text, size) <= width) return std::string(text);
  std::string kept;
  while (!text.empty()) {
    auto const length = std::max<std::size_t>(character_length(text), 1);
    auto const longer = kept + std::string(text.substr(0, length));
    if (text_width(longer + "…", size) > width) break;
    kept = longer;
    text.remove_prefix(length);
  }
  return kept.empty() ? std::string() : kept + "…";
}

std::vector<Point> simplified(std::span<Point const> line, double tolerance) {
  if (line.size() < 3) return {line.begin(), line.end()};
  std::vector<bool> keeps(line.size(), false);
  keeps.front() = keeps.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
  while (!open.empty()) {
    auto const [first, last] = open.back();
    open.pop_back();
    double farthest = tolerance;
    std::size_t at = 0;
    for (auto i = first + 1; i < last; ++i) {
      double const distance = distance_to_line(line[i], line[first], line[last]);
      if (distance > farthest) std::tie(farthest, at) = std::pair(distance, i);
    }
    if (at == 0) continue;
    keeps[at] = true;
    open.emplace_back(first, at);
    open.emplace_back(at, last);
  }
  std::vector<Point> kept;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (keeps[i]) kept.push_back(line[i]);
  return kept;
}

void Canvas::open(std::string_view attributes) {
  text_ += fmt::format("<g {}>\n", attributes);
}

void Canvas::close() {
  text_ += "</g>\n";
}

void Canvas::end(std::string_view tag, std::string_view hint) {
  text_ += hint.empty() ? "/>\n" : fmt::format("><title>{}</title></{}>\n", escaped(hint), tag);
}

void Canvas::rect(Box const& box, std::string_view attributes, std::string_view hint) {
  text_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}", coordinate(box.at.x),
                       coordinate(box.at.y), coordinate(box.width), coordinate(box.height), attributes);
  end("rect", hint);
}

void Canvas::line(Point from, Point to, std::string_view attributes) {
  text_ += fmt::format("<path d=\"{}\" {}/>\n", path_of(std::array{from, to}), attributes);
}

void Canvas::circle(Point center, double radius, std::string_view attributes, std::string_view hint) {
  text_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {}", coordinate(center.x), coordinate(center.y),
                       coordinate(radius), attributes);
  end("circle", hint);
}

void Canvas::polyline(std::span<Point const> points, std::string_view attributes, std::string_view hint) {
  if (points.empty()) return;
  text_ += fmt::format("<path d=\"{}\" {}", path_of(points), attributes);
  end("path", hint);
}

void Canvas::rings(std::span<std::vector<Point> const> rings, std::string_view attributes, std::string_view hint) {
  std::string path;
  for (auto const& ring : rings) path += path_of(ring) + "Z";
  text_ += fmt::format("<path d=\"{}\" fill-rule=\"evenodd\" {}", path, attributes);
  end("path", hint);
}

void Canvas::words(Point at, std::string_view words, std::string_view attributes) {
  text_ += fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>\n", coordinate(at.x), coordinate(at.y), attributes,
                       escaped(words));
}

}  // namespace lapwing::dryrun::internal
