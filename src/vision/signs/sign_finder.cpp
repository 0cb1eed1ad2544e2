#include "vision/signs/sign_finder.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "vision/image/rectify.hpp"
#include "vision/signs/room_text.hpp"
#include "vision/signs/text_lines.hpp"

namespace lapwing::vision {

namespace {

/// Letters of a sign that a robot stands before are seen at this size, and what is finer costs time.
constexpr int working_side = 1440;
/// Of a number, below which it is rather something else that looks like one.
constexpr double least_confidence = 0.25;

/// What one row says.
struct ReadLine {
  Quadrilateral corners;
  cv::Rect2d box;
  double letter_height = 0.0;
  std::optional<Vote> number{};
  std::optional<std::string> kind{};
};

/// Room for letters that the row's ends were cut off from, and a second look with more ground: readers slip on
/// different crops.
std::vector<cv::Mat> crops_of(cv::Mat const& pixels, TextLine const& line) {
  std::vector<cv::Mat> crops;
  for (float const more : {0.0F, 0.25F}) {
    auto corners = line.corners;
    auto const margin = static_cast<float>(line.letter_height) * more;
    corners[0] += cv::Point2f(-margin, -margin);
    corners[1] += cv::Point2f(margin, -margin);
    corners[2] += cv::Point2f(margin, margin);
    corners[3] += cv::Point2f(-margin, margin);
    crops.push_back(rectified(pixels, corners));
  }
  return crops;
}

bool says_a_room(Reading const& reading) {
  auto const said = room_text(reading.text);
  return said.number || said.kind;
}

ReadLine read_line(cv::Mat const& pixels, TextLine const& line,
                   std::vector<std::unique_ptr<LineReader>> const& readers) {
  ReadLine read{.corners = line.corners, .box = line.box(), .letter_height = line.letter_height};
  std::vector<Reading> readings;
  for (auto const& crop : crops_of(pixels, line)) {
    for (auto const& reader : readers) readings.push_back(reader->read(crop));
    // Most rows are no letters, or none of a room: where nobody reads any, more ground seldom brings them out.
    if (std::ranges::none_of(readings, says_a_room)) break;
  }
  read.number = vote_on_number(readings);
  for (auto const& reading : readings) {
    if (!read.kind && reading.confidence > 0.5) read.kind = room_text(reading.text).kind;
  }
  return read;
}

/// Rows of one sign: above each other, or side by side on one line.
bool belong_together(Box const& sign, ReadLine const& row) {
  double const across = std::max(sign.x, row.box.x) - std::min(sign.x + sign.width, row.box.x + row.box.width);
  double const down = std::max(sign.y, row.box.y) - std::min(sign.y + sign.height, row.box.y + row.box.height);
  return across < 2.0 * row.letter_height && down < 8.0 * row.letter_height;
}

Detection detection_of(ReadLine const& line) {
  Detection sign{.category = "sign", .box = {line.box.x, line.box.y, line.box.width, line.box.height}};
  constexpr double of_a_kind_alone = 0.5;
  sign.score = line.number ? std::min(1.0, line.number->confidence) : of_a_kind_alone;
  if (line.number) sign.text = line.number->number;
  sign.kind = line.kind;
  return sign;
}

/// Where the parts of a number stand. Rows that lie over each other are the same letters, found twice.
bool are_side_by_side(cv::Rect2d const& a, cv::Rect2d const& b) {
  double const both = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  bool const is_level = std::abs(a.y + 0.5 * a.height - b.y - 0.5 * b.height) < 0.4 * std::max(a.height, b.height);
  return is_level && both < 0.5 * std::min(a.width, b.width);
}

/// A sign that is being put together, and the row with its number.
struct Sign {
  Detection detection;
  ReadLine number;
  std::vector<Quadrilateral> rows;
};

/// Round all rows, in the directions of the first: what leans is not taken for perspective, which a single row is too
/// low to show.
std::array<Point, 4> corners_of(std::vector<Quadrilateral> const& rows) {
  auto const& first = rows.front();
  auto const width = static_cast<float>(cv::norm(first[1] - first[0]));
  auto const height = static_cast<float>(cv::norm(first[3] - first[0]));
  std::array<cv::Point2f, 3> const seen{first[0], first[1], first[3]};
  std::array<cv::Point2f, 3> const level{cv::Point2f(0.0F, 0.0F), cv::Point2f(width, 0.0F), cv::Point2f(0.0F, height)};
  std::vector<cv::Point2f> points;
  for (auto const& row : rows) points.insert(points.end(), row.begin(), row.end());
  cv::transform(points, points, cv::getAffineTransform(seen.data(), level.data()));
  auto const [left, right] = std::ranges::minmax(points, {}, &cv::Point2f::x);
  auto const [top, bottom] = std::ranges::minmax(points, {}, &cv::Point2f::y);
  std::vector<cv::Point2f> round{{left.x, top.y}, {right.x, top.y}, {right.x, bottom.y}, {left.x, bottom.y}};
  cv::transform(round, round, cv::getAffineTransform(level.data(), seen.data()));
  std::array<Point, 4> corners;
  std::ranges::transform(round, corners.begin(), [](cv::Point2f const& point) { return Point{point.x, point.y}; });
  return corners;
}

void take_in(Sign& sign, ReadLine const& line) {
  sign.rows.push_back(line.corners);
  auto& whole = sign.detection;
  auto const row = detection_of(line);
  double const right = std::max(whole.box.x + whole.box.width, row.box.x + row.box.width);
  double const bottom = std::max(whole.box.y + whole.box.height, row.box.y + row.box.height);
  whole.box.x = std::min(whole.box.x, row.box.x);
  whole.box.y = std::min(whole.box.y, row.box.y);
  whole.box.width = right - whole.box.x;
  whole.box.height = bottom - whole.box.y;
  if (!whole.kind) whole.kind = row.kind;
  if (!row.text) return;
  std::optional<std::string> both;
  if (whole.text && are_side_by_side(sign.number.box, line.box)) {
    bool const is_first = line.box.x < sign.number.box.x;
    both = is_first ? joined_number(*row.text, *whole.text) : joined_number(*whole.text, *row.text);
  }
  if (both) {
    whole.text = std::move(both);
    whole.score = std::min(whole.score, row.score);
  } else if (!whole.text || row.score > whole.score) {
    whole.text = row.text;
    whole.score = row.score;
    sign.number = line;
  }
}

void clip(Box& box, cv::Size const& size) {
  double const right = std::min<double>(size.width, box.x + box.width);
  double const bottom = std::min<double>(size.height, box.y + box.height);
  box.x = std::clamp<double>(box.x, 0.0, size.width);
  box.y = std::clamp<double>(box.y, 0.0, size.height);
  box.width = std::max(0.0, right - box.x);
  box.height = std::max(0.0, bottom - box.y);
}

/// From the door's middle to the sign's, in widths of the door; nothing when it is not beside it.
std::optional<double> distance(Detection const& door, Detection const& sign) {
  double const x = sign.box.x + 0.5 * sign.box.width;
  double const y = sign.box.y + 0.5 * sign.box.height;
  bool const is_beside = x > door.box.x - door.box.width && x < door.box.x + 2.0 * door.box.width;
  bool const is_level = y > door.box.y - 0.3 * door.box.height && y < door.box.y + door.box.height;
  if (!is_beside || !is_level || door.box.width <= 0.0) return std::nullopt;
  return std::abs(x - door.box.x - 0.5 * door.box.width) / door.box.width;
}

}  // namespace

SignFinder::SignFinder(std::vector<std::unique_ptr<LineReader>> readers) : readers_(std::move(readers)) {}

std::vector<Detection> SignFinder::find(cv::Mat const& pixels) {
  if (pixels.empty()) return {};
  double const scale = std::min(1.0, static_cast<double>(working_side) / std::max(pixels.cols, pixels.rows));
  cv::Mat small;
  cv::resize(pixels, small, {}, scale, scale, cv::INTER_AREA);
  cv::Mat grey;
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  std::vector<Sign> signs;
  for (auto const& line : find_text_lines(grey)) {
    auto const read = read_line(small, line, readers_);
    if (!read.kind && (!read.number || read.number->confidence < least_confidence)) continue;
    auto const other =
        std::ranges::find_if(signs, [&](auto const& sign) { return belong_together(sign.detection.box, read); });
    if (other == signs.end()) {
      signs.push_back({detection_of(read), read, {read.corners}});
    } else {
      take_in(*other, read);
    }
  }
  std::vector<Detection> found;
  for (auto& [sign, number, rows] : signs) {
    clip(sign.box, small.size());
    sign.box = {sign.box.x / scale, sign.box.y / scale, sign.box.width / scale, sign.box.height / scale};
    sign.corners = corners_of(rows);
    for (auto& corner : *sign.corners) corner = {corner.x / scale, corner.y / scale};
    found.push_back(sign);
  }
  return found;
}

void name_doors(std::vector<Detection>& detections) {
  for (auto const& sign : detections) {
    if (sign.category != "sign") continue;
    Detection* nearest = nullptr;
    double least = 0.0;
    for (auto& door : detections) {
      if (door.category != "door") continue;
      auto const away = distance(door, sign);
      if (!away || (nearest && *away >= least)) continue;
      nearest = &door;
      least = *away;
    }
    if (!nearest || nearest->text) continue;
    nearest->text = sign.text;
    nearest->kind = sign.kind;
  }
}

}  // namespace lapwing::vision
