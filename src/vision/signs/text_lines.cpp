#include "vision/signs/text_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

constexpr int least_height = 9;
/// Of the picture's height.
constexpr double most_height = 0.25;
/// Width to height: blurred letters grow together.
constexpr double most_width = 6.0;
/// Of the height of what has grown together: what is lower is a part of a letter.
constexpr double least_share = 0.6;
/// Grey levels between letter and ground.
constexpr double least_contrast = 22.0;
/// The more there are, the less each can be a letter of a sign that somebody shall read; the largest are kept.
constexpr std::size_t most_pieces = 1200;

/// Something of one polarity that may be a letter.
struct Piece {
  cv::Rect box;
  double level = 0.0;     ///< its mean grey
  double contrast = 0.0;  ///< to what is round it

  [[nodiscard]] double middle_y() const { return box.y + 0.5 * box.height; }
  [[nodiscard]] int right() const { return box.x + box.width; }
};

double mean_of(cv::Mat const& grey, cv::Mat const& mask) {
  return cv::mean(grey, mask)[0];
}

bool has_a_letters_shape(cv::Rect const& box, int area, cv::Size const& picture) {
  double const filling = static_cast<double>(area) / box.area();
  return box.height >= least_height && box.height <= most_height * picture.height && box.width >= 2 &&
         box.width <= most_width * box.height && filling > 0.12 && filling < 0.97;
}

/// The connected parts of a mask.
struct Parts {
  explicit Parts(cv::Mat const& mask) : count(cv::connectedComponentsWithStats(mask, labels, stats, centres)) {}
  [[nodiscard]] cv::Rect box(int k) const {
    return {stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP), stats.at<int>(k, cv::CC_STAT_WIDTH),
            stats.at<int>(k, cv::CC_STAT_HEIGHT)};
  }
  [[nodiscard]] int area(int k) const { return stats.at<int>(k, cv::CC_STAT_AREA); }

  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centres;
  int count;  ///< from 1; 0 is what the mask leaves out
};

/// Letters that stand close grow together in the mask, which takes in their blurred edges; half-way between the ground
/// and what differs most from it they come apart. `ground`: the grey level round them.
std::vector<Piece> split(cv::Mat const& grey, cv::Mat const& own, Piece const& whole, double ground) {
  double darkest = 0.0;
  double brightest = 0.0;
  cv::minMaxLoc(grey(whole.box), &darkest, &brightest, nullptr, nullptr, own);
  bool const is_bright = whole.level > ground;
  cv::Mat core;
  cv::compare(grey(whole.box), ((is_bright ? brightest : darkest) + ground) / 2.0, core,
              is_bright ? cv::CMP_GT : cv::CMP_LT);
  core &= own;
  std::vector<Piece> letters;
  Parts const parts(core);
  for (int k = 1; k < parts.count; ++k) {
    auto const box = parts.box(k);
    if (has_a_letters_shape(box, parts.area(k), grey.size()) && box.height > least_share * whole.box.height)
      letters.push_back({box + whole.box.tl(), whole.level, whole.contrast});
  }
  return letters.size() > 1 ? letters : std::vector{whole};
}

/// `mask`: 255 where the picture is brighter (or darker) than round about.
std::vector<Piece> pieces_of(cv::Mat const& grey, cv::Mat const& mask) {
  std::vector<Piece> pieces;
  Parts const parts(mask);
  for (int k = 1; k < parts.count; ++k) {
    auto const box = parts.box(k);
    if (!has_a_letters_shape(box, parts.area(k), grey.size())) continue;
    cv::Mat const own = parts.labels(box) == k;
    double const level = mean_of(grey(box), own);
    double const ground = mean_of(grey(box), mask(box) == 0);
    Piece const whole{box, level, std::abs(level - ground)};
    if (whole.contrast < least_contrast) continue;
    std::ranges::copy(split(grey, own, whole, ground), std::back_inserter(pieces));
  }
  std::ranges::stable_sort(pieces, std::ranges::greater(), [](Piece const& piece) { return piece.box.area(); });
  if (pieces.size() > most_pieces) pieces.resize(most_pieces);
  std::ranges::stable_sort(pieces, {}, [](Piece const& piece) { return piece.box.x; });
  return pieces;
}

/// `b` begins right of where `a` begins.
bool are_neighbours(Piece const& a, Piece const& b) {
  double const height = std::max(a.box.height, b.box.height);
  return std::min(a.box.height, b.box.height) > 0.6 * height && std::abs(a.middle_y() - b.middle_y()) < 0.4 * height &&
         b.box.x - a.right() < 1.1 * height && b.box.x + b.box.width > a.right() &&
         std::abs(a.level - b.level) < 60.0 &&
         std::min(a.contrast, b.contrast) > 0.4 * std::max(a.contrast, b.contrast);
}

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t at) {
  while (parents[at] != at) at = parents[at] = parents[parents[at]];
  return at;
}

std::vector<std::vector<Piece>> rows_of(std::vector<Piece> const& pieces) {
  std::vector<std::size_t> parents(pieces.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  for (std::size_t a = 0; a < pieces.size(); ++a) {
    for (std::size_t b = a + 1; b < pieces.size(); ++b) {
      if (pieces[b].box.x > pieces[a].right() + 1.1 * most_height * 4.0 * pieces[a].box.height) break;
      if (are_neighbours(pieces[a], pieces[b])) parents[root_of(parents, b)] = root_of(parents, a);
    }
  }
  std::vector<std::vector<Piece>> rows(pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k) rows[root_of(parents, k)].push_back(pieces[k]);
  std::erase_if(rows, [](auto const& row) { return row.empty(); });
  return rows;
}

/// y = offset + slope * x through the points, by least squares.
struct Line {
  double offset = 0.0;
  double slope = 0.0;

  [[nodiscard]] cv::Point2f at(double x) const {
    return {static_cast<float>(x), static_cast<float>(offset + slope * x)};
  }
};

Line line_through(std::vector<cv::Point2d> const& points) {
  double const n = static_cast<double>(points.size());
  cv::Point2d mean;
  for (auto const& point : points) mean += point * (1.0 / n);
  double along = 0.0;
  double both = 0.0;
  for (auto const& point : points) {
    along += (point.x - mean.x) * (point.x - mean.x);
    both += (point.x - mean.x) * (point.y - mean.y);
  }
  double const slope = points.size() > 2 && along > 0.0 ? both / along : 0.0;
  return {mean.y - slope * mean.x, slope};
}

TextLine text_line_of(std::vector<Piece> const& row) {
  std::vector<cv::Point2d> tops;
  std::vector<cv::Point2d> bottoms;
  std::vector<int> heights;
  int right = 0;
  for (auto const& piece : row) {
    double const x = piece.box.x + 0.5 * piece.box.width;
    tops.emplace_back(x, piece.box.y);
    bottoms.emplace_back(x, piece.box.y + piece.box.height);
    heights.push_back(piece.box.height);
    right = std::max(right, piece.right());
  }
  std::ranges::nth_element(heights, heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2));
  double const height = heights[heights.size() / 2];
  // Readers want some ground round the letters.
  double const margin = 0.3 * height;
  auto top = line_through(tops);
  auto bottom = line_through(bottoms);
  // Tops of a few letters may lie anywhere; rows are near to parallel.
  double const slope = 0.5 * (top.slope + bottom.slope);
  if (row.size() < 5) {
    top = {tops.front().y + 0.5 * (tops.back().y - tops.front().y) - slope * 0.5 * (tops.front().x + tops.back().x),
           slope};
    bottom = {bottoms.front().y + 0.5 * (bottoms.back().y - bottoms.front().y) -
                  slope * 0.5 * (bottoms.front().x + bottoms.back().x),
              slope};
  }
  double const left = row.front().box.x;
  top.offset -= margin;
  bottom.offset += margin;
  return {
      .corners = {top.at(left - margin), top.at(right + margin), bottom.at(right + margin), bottom.at(left - margin)},
      .letter_height = height,
      .letters = static_cast<int>(row.size())};
}

/// Letters of one height on one line, and enough of them: higher is better, below 0 is none.
double regularity(std::vector<Piece> const& row) {
  double width = 0.0;
  double mean = 0.0;
  for (auto const& piece : row) {
    width += static_cast<double>(piece.box.width) / piece.box.height;
    mean += static_cast<double>(piece.box.height) / static_cast<double>(row.size());
  }
  if (row.size() < 3 && width < 1.6) return -1.0;
  double spread = 0.0;
  double contrast = 0.0;
  for (auto const& piece : row) {
    spread += std::abs(piece.box.height - mean) / mean / static_cast<double>(row.size());
    contrast += piece.contrast / static_cast<double>(row.size());
  }
  double const letters = std::min<double>(static_cast<double>(row.size()), 8.0);
  return letters * (1.0 - std::min(spread, 0.9)) * std::min(1.0, contrast / 80.0) * std::min(1.0, mean / 16.0);
}

}  // namespace

cv::Rect2d TextLine::box() const {
  auto const [left, right] = std::ranges::minmax({corners[0].x, corners[1].x, corners[2].x, corners[3].x});
  auto const [top, bottom] = std::ranges::minmax({corners[0].y, corners[1].y, corners[2].y, corners[3].y});
  return {left, top, right - left, bottom - top};
}

std::vector<TextLine> find_text_lines(cv::Mat const& grey, std::size_t most) {
  constexpr int least_side = 24;
  if (grey.cols < least_side || grey.rows < least_side) return {};
  // Larger than a letter, smaller than a change of light.
  int const block = std::max(25, std::min(grey.cols, grey.rows) / 9) | 1;
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, {3, 3}, 0.0);
  std::vector<std::pair<double, TextLine>> lines;
  for (auto const kind : {cv::THRESH_BINARY, cv::THRESH_BINARY_INV}) {
    cv::Mat mask;
    double const offset = kind == cv::THRESH_BINARY ? -0.4 * least_contrast : 0.4 * least_contrast;
    cv::adaptiveThreshold(smooth, mask, 255.0, cv::ADAPTIVE_THRESH_MEAN_C, kind, block, offset);
    for (auto const& row : rows_of(pieces_of(grey, mask))) {
      double const score = regularity(row);
      if (score > 0.0) lines.emplace_back(score, text_line_of(row));
    }
  }
  std::ranges::stable_sort(lines, std::ranges::greater(), &std::pair<double, TextLine>::first);
  if (lines.size() > most) lines.resize(most);
  std::vector<TextLine> best;
  for (auto const& [score, line] : lines) best.push_back(line);
  return best;
}

}  // namespace lapwing::vision
