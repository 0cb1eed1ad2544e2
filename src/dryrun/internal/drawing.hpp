#pragma once

#include <concepts>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace lapwing::dryrun::internal {

/// In pixels, to the right and down.
struct Point {
  double x = 0.0;
  double y = 0.0;
};
using Line = std::vector<Point>;

struct Box {
  Point at;  ///< upper left corner
  double width = 0.0;
  double height = 0.0;

  [[nodiscard]] double right() const { return at.x + width; }
  [[nodiscard]] double bottom() const { return at.y + height; }
  [[nodiscard]] bool contains(Point point) const {
    return at.x <= point.x && point.x <= right() && at.y <= point.y && point.y <= bottom();
  }
  [[nodiscard]] bool meets(Box const& other) const {
    return at.x < other.right() && other.at.x < right() && at.y < other.bottom() && other.at.y < bottom();
  }
};

/// Foreign text as XML text: markup escaped, bytes that are no UTF-8 and characters that XML cannot hold replaced.
[[nodiscard]] std::string escaped(std::string_view text);
/// About how wide a text is, in a sans-serif font of that size.
[[nodiscard]] double text_width(std::string_view text, double size);
/// The text, or its begin and an ellipsis, so that it is no wider.
[[nodiscard]] std::string fitted(std::string_view text, double size, double width);
/// The line with fewer points, nowhere farther than `tolerance` from the old one.
[[nodiscard]] Line simplified(Line const& line, double tolerance);

/// SVG as it is written: markup of ours with gaps for values. Numbers are rounded to a tenth of a pixel, which no
/// screen shows finer, points become "x y", lines the data of a path, several lines closed rings, and texts are
/// escaped.
class Drawing {
 public:
  template <class... Values>
  void add(std::string_view markup, Values const&... values) {
    fmt::format_to(std::back_inserter(text_), fmt::runtime(markup), shown(values)...);
    text_ += '\n';
  }
  /// Without gaps, braces and all.
  void add_whole(std::string_view markup) { text_ += markup; }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  static double shown(double value);
  static std::string shown(Point point);
  static std::string shown(Line const& line);
  static std::string shown(std::vector<Line> const& rings);
  static std::string shown(std::string_view words) { return escaped(words); }
  static auto shown(std::integral auto number) { return number; }
  std::string text_;
};

/// Finds room for texts on a map, first come first served.
class Labels {
 public:
  explicit Labels(Box const& area) : area_(area) {}

  /// Keeps others away from there.
  void occupy(Box const& box) { taken_.push_back(box); }
  /// Writes a text beside `anchor`; not where there is no room on any side of it.
  bool write(Drawing& drawing, Point anchor, std::string_view words, double size, double gap,
             std::string_view css_class);

 private:
  Box area_;
  std::vector<Box> taken_;
};

}  // namespace lapwing::dryrun::internal
