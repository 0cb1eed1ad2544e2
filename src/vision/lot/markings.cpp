#include "vision/lot/markings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

/// A line of 10 cm is two pixels wide, and its edges are apart.
constexpr double line_metres = 0.05;
constexpr double least_length_m = 1.4;
constexpr double shortest_piece = 16.0;  // pixels: what is shorter may have any direction
constexpr double same_direction = 0.09;  // radians
constexpr double same_line = 6.5;        // pixels aside: the widest paint
constexpr double longest_gap = 14.0;     // pixels along: worn away, or hidden
constexpr double both_edges = 1.2;       // pixels between the edges of the narrowest paint

/// What is brighter than everything half a metre round it, as that stands out.
cv::Mat narrow_and_bright(cv::Mat const& pixels) {
  // The brightest channel: yellow paint is as bright as white there.
  cv::Mat channels[3];
  cv::split(pixels, channels);
  cv::Mat light;
  cv::max(channels[1], channels[2], light);
  cv::max(light, channels[0], light);
  constexpr double blur = 0.8;
  cv::GaussianBlur(light, light, {}, blur);
  cv::Mat out;
  cv::morphologyEx(light, out, cv::MORPH_TOPHAT, cv::getStructuringElement(cv::MORPH_ELLIPSE, {11, 11}));
  // Fresh paint is not more of a line than worn paint.
  constexpr double bright_enough = 60.0;
  constexpr double stretch = 4.0;
  cv::min(out, bright_enough, out);
  out.convertTo(out, CV_8U, stretch);
  return out;
}

struct Piece {
  cv::Point2d from;
  cv::Point2d to;
  double direction = 0.0;  ///< 0 to pi
  double length = 0.0;
};

std::vector<Piece> pieces_of(cv::Mat const& light) {
  auto const detector = cv::createLineSegmentDetector(cv::LSD_REFINE_STD);
  std::vector<cv::Vec4f> segments;
  detector->detect(light, segments);
  std::vector<Piece> pieces;
  for (auto const& segment : segments) {
    Piece piece{.from = {segment[0], segment[1]}, .to = {segment[2], segment[3]}};
    auto const way = piece.to - piece.from;
    piece.length = cv::norm(way);
    if (piece.length < shortest_piece) continue;
    piece.direction = std::atan2(way.y, way.x);
    if (piece.direction < 0.0) piece.direction += std::numbers::pi;
    pieces.push_back(piece);
  }
  std::ranges::stable_sort(pieces, std::ranges::greater(), &Piece::length);
  return pieces;
}

double between_directions(double a, double b) {
  double const apart = std::abs(a - b);
  return std::min(apart, std::numbers::pi - apart);
}

/// Pieces that lie in one line, on either edge of it.
class Gathering {
 public:
  explicit Gathering(Piece const& first)
      : origin_(0.5 * (first.from + first.to)),
        along_(std::cos(first.direction), std::sin(first.direction)),
        direction_(first.direction),
        begin_(-0.5 * first.length),
        end_(0.5 * first.length) {}

  [[nodiscard]] bool takes(Piece const& piece) {
    if (between_directions(piece.direction, direction_) >= same_direction) return false;
    double const aside = across(0.5 * (piece.from + piece.to));
    if (std::abs(aside) >= same_line) return false;
    auto const [low, high] = std::minmax({(piece.from - origin_).dot(along_), (piece.to - origin_).dot(along_)});
    if (high <= begin_ - longest_gap || low >= end_ + longest_gap) return false;
    begin_ = std::min(begin_, low);
    end_ = std::max(end_, high);
    left_ = std::min(left_, aside);
    right_ = std::max(right_, aside);
    return true;
  }

  /// None if it is short, or has one edge alone, as kerbs and changes of the ground have.
  [[nodiscard]] std::optional<PaintedLine> line() const {
    if ((end_ - begin_) * line_metres < least_length_m || right_ - left_ <= both_edges) return std::nullopt;
    cv::Point2d const middle = origin_ + 0.5 * (left_ + right_) * cv::Point2d(-along_.y, along_.x);
    return PaintedLine{(middle + begin_ * along_) * line_metres, (middle + end_ * along_) * line_metres};
  }

 private:
  [[nodiscard]] double across(cv::Point2d const& point) const {
    return (point - origin_).dot(cv::Point2d(-along_.y, along_.x));
  }

  cv::Point2d origin_;
  cv::Point2d along_;
  double direction_;
  double begin_;
  double end_;
  double left_ = 0.0;
  double right_ = 0.0;
};

std::vector<PaintedLine> gathered(std::vector<Piece> pieces) {
  std::vector<PaintedLine> lines;
  while (!pieces.empty()) {
    Gathering gathering(pieces.front());
    pieces.erase(pieces.begin());
    // A line that has grown may reach what it did not before.
    for (std::size_t before = pieces.size() + 1; before != pieces.size();) {
      before = pieces.size();
      std::erase_if(pieces, [&](Piece const& piece) { return gathering.takes(piece); });
    }
    if (auto const line = gathering.line()) lines.push_back(*line);
  }
  return lines;
}

}  // namespace

std::vector<PaintedLine> painted_lines(cv::Mat const& pixels, double metres_a_pixel) {
  if (pixels.empty()) return {};
  double const scale = metres_a_pixel / line_metres;
  cv::Size const size(static_cast<int>(std::lround(pixels.cols * scale)),
                      static_cast<int>(std::lround(pixels.rows * scale)));
  constexpr int least_side = 30;
  if (std::min(size.width, size.height) < least_side) return {};
  cv::Mat scaled;
  cv::resize(pixels, scaled, size, 0.0, 0.0, scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return gathered(pieces_of(narrow_and_bright(scaled)));
}

}  // namespace lapwing::vision
