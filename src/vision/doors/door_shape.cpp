#include "vision/doors/door_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

/// Enough for lines, whatever the picture's size.
constexpr int working_height = 160;
/// How far a side may be from the box's, in widths (or heights) of the box.
constexpr double reach = 0.14;
/// A wall that runs away at 60 degrees slants a door's top by less than that; jambs lean by the camera's roll alone.
constexpr double most_slant_of_top = 0.5;
constexpr double most_slant_of_side = 0.12;
/// Far from the box's side a line has to be so much clearer.
constexpr double price_of_distance = 0.25;
/// Below it a line is no better than the box.
constexpr double least_support = 0.35;

/// y = at + slant (x - middle) for lines that lie, x and y changed for those that stand.
struct Line {
  double at = 0.0;
  double slant = 0.0;
  double support = 0.0;
};

struct Search {
  double wanted;  ///< where the box's side is
  double reach;   ///< how far from there the line may be
  double slant;   ///< the steepest
  double from;    ///< where the side begins and ends, along it
  double to;
};

/// 0 to 1: an edge of this direction, of whatever contrast as long as it stands out from its surroundings.
cv::Mat edges(cv::Mat const& grey, int dx, int dy) {
  cv::Mat slope;
  cv::Sobel(grey, slope, CV_32F, dx, dy);
  cv::Mat const strength = cv::abs(slope);
  // Noise and grain are around the mean; a line's middle is better than its rims, however strong these are.
  double const usual = std::max(8.0, 2.5 * cv::mean(strength)[0]);
  cv::Mat const squared = strength.mul(strength);
  cv::Mat out;
  cv::divide(squared, squared + usual * usual, out);
  return out;
}

/// The clearest line of those that lie in `edge`; for standing ones it is given transposed.
Line clearest(cv::Mat const& edge, Search const& search) {
  constexpr int offsets = 24;
  constexpr int slants = 12;
  double const middle = 0.5 * (search.from + search.to);
  int const first = std::max(0, static_cast<int>(search.from));
  int const last = std::min(edge.cols, static_cast<int>(search.to));
  Line best{.at = search.wanted};
  double best_worth = 0.0;
  for (int i = -offsets; i <= offsets; ++i) {
    double const moved = static_cast<double>(i) / offsets;
    for (int j = -slants; j <= slants; ++j) {
      Line line{.at = search.wanted + moved * search.reach, .slant = search.slant * j / slants};
      double sum = 0.0;
      int count = 0;
      for (int x = first; x < last; ++x) {
        int const y = static_cast<int>(std::lround(line.at + line.slant * (x - middle)));
        if (y < 0 || y >= edge.rows) continue;
        sum += edge.at<float>(y, x);
        ++count;
      }
      if (2 * count < last - first) continue;
      line.support = sum / count;
      double const worth = line.support - price_of_distance * std::abs(moved);
      if (worth <= best_worth) continue;
      best_worth = worth;
      best = line;
    }
  }
  return best;
}

/// One side of a door, in pixels of the small picture.
struct Side {
  cv::Mat const& edge;
  Search search;
  bool is_cut;  ///< it lies on the picture's edge, where there is no line: the door goes on beyond it
  bool counts;  ///< its line tells that there is a door
};

struct Outline {
  std::array<Line, 4> lines;
  double support = 0.0;  ///< the mean of the sides that count
};

Outline outline_of(std::array<Side, 4> const& sides) {
  Outline outline;
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    outline.lines[k] = {.at = sides[k].search.wanted};
    if (sides[k].is_cut) continue;
    auto const line = clearest(sides[k].edge, sides[k].search);
    if (line.support >= least_support) outline.lines[k] = line;
    if (!sides[k].counts) continue;
    sum += line.support;
    ++count;
  }
  outline.support = count > 0 ? sum / count : 0.0;
  return outline;
}

/// Where a standing and a lying line meet.
cv::Point2d meeting(Line const& standing, double y_middle, Line const& lying, double x_middle) {
  // x = a + p (y - m), y = b + q (x - n)
  double const p = standing.slant;
  double const q = lying.slant;
  double const x = (standing.at + p * (lying.at - q * x_middle - y_middle)) / (1.0 - p * q);
  return {x, lying.at + q * (x - x_middle)};
}

}  // namespace

DoorShape door_shape(cv::Mat const& pixels, Box const& box) {
  auto const corner = [&](double x, double y) { return cv::Point2f(static_cast<float>(x), static_cast<float>(y)); };
  double const right = box.x + box.width;
  double const bottom = box.y + box.height;
  DoorShape shape{
      .corners = {corner(box.x, box.y), corner(right, box.y), corner(right, bottom), corner(box.x, bottom)}};
  double const margin = 1.5 * reach;
  cv::Rect const whole(0, 0, pixels.cols, pixels.rows);
  cv::Rect const around =
      cv::Rect(static_cast<int>(box.x - margin * box.width), static_cast<int>(box.y - margin * box.height),
               static_cast<int>((1.0 + 2.0 * margin) * box.width),
               static_cast<int>((1.0 + 2.0 * margin) * box.height)) &
      whole;
  if (around.width < 8 || around.height < 8) return shape;
  double const scale = std::min(1.0, static_cast<double>(working_height) / around.height);
  cv::Mat small;
  cv::resize(pixels(around), small, {}, scale, scale, cv::INTER_AREA);
  if (small.cols < 4 || small.rows < 4) return shape;
  cv::Mat grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  cv::GaussianBlur(grey, grey, {3, 3}, 0.0);
  cv::Mat const upright = edges(grey, 1, 0).t();
  cv::Mat const lying = edges(grey, 0, 1);

  // In pixels of the small picture.
  Box const in{(box.x - around.x) * scale, (box.y - around.y) * scale, box.width * scale, box.height * scale};
  Search const side{
      .wanted = in.x, .reach = reach * in.width, .slant = most_slant_of_side, .from = in.y, .to = in.y + in.height};
  Search const across{
      .wanted = in.y, .reach = reach * in.height, .slant = most_slant_of_top, .from = in.x, .to = in.x + in.width};
  auto const moved = [](Search search, double wanted) {
    search.wanted = wanted;
    return search;
  };
  constexpr double edge_pixels = 3.0;
  std::array<Side, 4> const sides{
      Side{upright, side, box.x < edge_pixels, true}, Side{lying, across, box.y < edge_pixels, true},
      Side{upright, moved(side, in.x + in.width), right > pixels.cols - edge_pixels, true},
      // Floors have edges of their own, and furniture stands before doors.
      Side{lying, moved(across, in.y + in.height), bottom > pixels.rows - edge_pixels, false}};
  auto const [lines, support] = outline_of(sides);
  shape.support = support;
  double const x_middle = in.x + 0.5 * in.width;
  double const y_middle = in.y + 0.5 * in.height;
  constexpr std::array<std::array<std::size_t, 2>, 4> meet{{{0, 1}, {2, 1}, {2, 3}, {0, 3}}};
  for (std::size_t k = 0; k < meet.size(); ++k) {
    auto const at = meeting(lines[meet[k][0]], y_middle, lines[meet[k][1]], x_middle);
    shape.corners[k] = corner(around.x + at.x / scale, around.y + at.y / scale);
  }
  return shape;
}

}  // namespace lapwing::vision
