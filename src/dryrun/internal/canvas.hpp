#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing::dryrun::internal {

/// In pixels, to the right and down.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

struct Box {
  Point at;  ///< upper left corner
  double width = 0.0;
  double height = 0.0;

  [[nodiscard]] double right() const { return at.x + width; }
  [[nodiscard]] double bottom() const { return at.y + height; }
  [[nodiscard]] bool contains(Point point) const {
    return at.x <= point.x && point.x <= right() && at.y <= point.y && point.y <= bottom();
  }
  [[nodiscard]] bool contains(Box const& other) const {
    return contains(other.at) && contains(Point{other.right(), other.bottom()});
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
/// The line with fewer points, nowhere farther than `tolerance` from the old one (Ramer 1972, Douglas and Peucker
/// 1973).
[[nodiscard]] std::vector<Point> simplified(std::span<Point const> line, double tolerance);

/// Writes SVG elements. `attributes` are ours, never foreign text; `hint` is what a browser shows under the mouse.
class Canvas {
 public:
  void raw(std::string_view markup) { text_ += markup; }
  void open(std::string_view attributes);
  void close();
  void rect(Box const& box, std::string_view attributes, std::string_view hint = {});
  void line(Point from, Point to, std::string_view attributes);
  void circle(Point center, double radius, std::string_view attributes, std::string_view hint = {});
  void polyline(std::span<Point const> points, std::string_view attributes, std::string_view hint = {});
  /// Closed rings, filled by the even-odd rule.
  void rings(std::span<std::vector<Point> const> rings, std::string_view attributes, std::string_view hint = {});
  void words(Point at, std::string_view words, std::string_view attributes);

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void end(std::string_view tag, std::string_view hint);
  std::string text_;
};

}  // namespace lapwing::dryrun::internal
