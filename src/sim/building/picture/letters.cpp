#include "sim/building/picture/letters.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace lapwing::sim::building {

namespace {

/// Tenths of a capital's height. Points `x,y` are joined; `@x,y,rx,ry,a,b` is part of an ellipse around (x, y) from
/// angle a to b in degrees, joined to what stands before and after; `;` lifts the pen.
struct Drawn {
  char letter;
  double width;
  std::string_view strokes;
};

constexpr std::array drawn_letters = std::to_array<Drawn>({
    {'0', 6, "@3,5,3,5,0,360"},
    {'1', 3, "0.2,8.2 2.2,10 2.2,0"},
    {'2', 6, "@3,7,3,3,170,-35 0,0 6,0"},
    {'3', 5.9, "@2.9,7.5,2.7,2.5,150,-90 @2.9,2.5,3,2.5,90,-150"},
    {'4', 6, "4.5,0 4.5,10 0,3 6,3"},
    {'5', 6, "5.5,10 1,10 0.7,5.3 @2.9,3.1,3.1,3.1,135,-150"},
    {'6', 6, "@3,3,3,3,0,360; @5.2,3,5.2,7,180,95"},
    {'7', 6, "0,10 6,10 2,0"},
    {'8', 6, "@3,7.5,2.6,2.5,0,360; @3,2.5,3,2.5,0,360"},
    {'9', 6, "@3,7,3,3,0,360; @0.8,7,5.2,7,0,-85"},
    {'A', 7, "0,0 3.5,10 7,0; 1.2,3.5 5.8,3.5"},
    {'B', 6, "0,0 0,10 3.2,10 @3.2,7.6,2.4,2.4,90,-90 0,5.2; 3.4,5.2 @3.4,2.6,2.6,2.6,90,-90 0,0"},
    {'C', 6.4, "@3.8,5,3.8,5,50,310"},
    {'D', 6.5, "0,0 0,10 2.5,10 @2.5,5,4,5,90,-90 0,0"},
    {'E', 5.5, "5.5,10 0,10 0,0 5.5,0; 0,5.2 4.6,5.2"},
    {'F', 5.5, "5.5,10 0,10 0,0; 0,5.2 4.6,5.2"},
    {'G', 7.2, "@3.8,5,3.8,5,50,320; 4.4,4.6 7.2,4.6 7.2,1.4"},
    {'H', 6, "0,0 0,10; 6,0 6,10; 0,5.2 6,5.2"},
    {'I', 0.8, "0.4,0 0.4,10"},
    {'J', 4, "4,10 4,2.8 @2,2.6,2,2.6,0,-170"},
    {'K', 6.2, "0,0 0,10; 6,10 0,4; 2.2,6.1 6.2,0"},
    {'L', 5, "0,10 0,0 5,0"},
    {'M', 7.6, "0,0 0,10 3.8,3 7.6,10 7.6,0"},
    {'N', 6, "0,0 0,10 6,0 6,10"},
    {'O', 8, "@4,5,4,5,0,360"},
    {'P', 5.8, "0,0 0,10 3.2,10 @3.2,7.3,2.6,2.7,90,-90 0,4.6"},
    {'Q', 8, "@4,5,4,5,0,360; 5,2.5 8,-0.8"},
    {'R', 6, "0,0 0,10 3.2,10 @3.2,7.3,2.6,2.7,90,-90 0,4.6; 3,4.6 6,0"},
    {'S', 6, "@3,7.5,2.8,2.5,35,270 @3,2.5,3,2.5,90,-150"},
    {'T', 7, "0,10 7,10; 3.5,10 3.5,0"},
    {'U', 6, "0,10 0,3.2 @3,3.2,3,3.2,180,360 6,10"},
    {'V', 7, "0,10 3.5,0 7,10"},
    {'W', 9.6, "0,10 2.4,0 4.8,9 7.2,0 9.6,10"},
    {'X', 6.4, "0,10 6.4,0; 6.4,10 0,0"},
    {'Y', 6.8, "0,10 3.4,4.8 6.8,10; 3.4,4.8 3.4,0"},
    {'Z', 6, "0,10 6,10 0,0 6,0"},
    {'a', 5, "@2.5,3.4,2.5,3.4,0,360; 5,6.8 5,0"},
    {'b', 5, "0,10 0,0; @2.5,3.4,2.5,3.4,0,360"},
    {'c', 4.4, "@2.6,3.4,2.6,3.4,50,310"},
    {'d', 5, "5,10 5,0; @2.5,3.4,2.5,3.4,0,360"},
    {'e', 5, "0.1,3.6 5,3.6 @2.5,3.4,2.5,3.4,3,310"},
    {'f', 3.4, "@3,8,1.6,2,70,180 1.4,0; 0,6.6 3.2,6.6"},
    {'g', 5, "@2.5,3.4,2.5,3.4,0,360; 5,6.8 5,-0.6 @2.5,-0.6,2.5,2.4,0,-150"},
    {'h', 4.8, "0,10 0,0; 0,4.2 @2.4,4.2,2.4,2.6,180,0 4.8,0"},
    {'i', 0.8, "0.4,6.8 0.4,0; 0.4,9.4 0.4,9.2"},
    {'j', 1.8, "1.6,6.8 1.6,-1 @0.2,-1,1.4,1.8,0,-100; 1.6,9.4 1.6,9.2"},
    {'k', 4.8, "0,10 0,0; 4.4,6.8 0,2.6; 1.6,4.1 4.8,0"},
    {'l', 0.8, "0.4,10 0.4,0"},
    {'m', 7.6, "0,6.8 0,0; 0,4.4 @1.9,4.4,1.9,2.4,180,0 3.8,0; 3.8,4.4 @5.7,4.4,1.9,2.4,180,0 7.6,0"},
    {'n', 4.8, "0,6.8 0,0; 0,4.2 @2.4,4.2,2.4,2.6,180,0 4.8,0"},
    {'o', 5.2, "@2.6,3.4,2.6,3.4,0,360"},
    {'p', 5, "0,6.8 0,-3; @2.5,3.4,2.5,3.4,0,360"},
    {'q', 5, "5,6.8 5,-3; @2.5,3.4,2.5,3.4,0,360"},
    {'r', 3, "0,6.8 0,0; 0,4 @2.4,4,2.4,2.8,180,75"},
    {'s', 4.4, "@2.2,5.1,2,1.7,40,270 @2.2,1.7,2.2,1.7,90,-150"},
    {'t', 3.4, "1.4,9 1.4,1.6 @2.8,1.6,1.4,1.6,180,290; 0,6.6 3.2,6.6"},
    {'u', 4.8, "0,6.8 0,2.6 @2.4,2.6,2.4,2.6,180,360; 4.8,6.8 4.8,0"},
    {'v', 5, "0,6.8 2.5,0 5,6.8"},
    {'w', 7.2, "0,6.8 1.8,0 3.6,6.2 5.4,0 7.2,6.8"},
    {'x', 4.8, "0,6.8 4.8,0; 4.8,6.8 0,0"},
    {'y', 5, "0,6.8 2.6,0; 5,6.8 1.4,-3"},
    {'z', 4.6, "0,6.8 4.6,6.8 0,0 4.6,0"},
    {'-', 3.8, "0.4,4.2 3.4,4.2"},
    {'.', 0.8, "0.4,0.1 0.4,0.3"},
    {',', 0.8, "0.6,0.4 0.1,-1.4"},
    {':', 0.8, "0.4,0.1 0.4,0.3; 0.4,6 0.4,6.2"},
    {'/', 4, "0,-1 4,11"},
    {'+', 5, "0,4.5 5,4.5; 2.5,2 2.5,7"},
    {'(', 1.8, "@3,4.5,3,6.5,130,230"},
    {')', 1.8, "@-1.2,4.5,3,6.5,50,-50"},
    {'\'', 0.8, "0.4,10 0.4,8"},
});

constexpr double tenth = 0.1;
/// Between the outermost middles of strokes of neighbouring letters.
constexpr double gap = 0.26;
constexpr double blank = 0.45;
/// A straight piece of a curve spans so much at most: nobody sees the corners.
constexpr double degrees_a_piece = 12.0;

struct Pen {
  std::vector<Stroke>& strokes;
  double left;
  std::optional<std::pair<double, double>> at = std::nullopt;

  void draw_to(double x, double y) {
    std::pair const to(left + x * tenth, y * tenth);
    if (at) strokes.push_back({at->first, at->second, to.first, to.second});
    at = to;
  }
  void draw_curve(std::span<double const> numbers) {
    double const turn = numbers[5] - numbers[4];
    int const pieces = std::max(2, static_cast<int>(std::ceil(std::abs(turn) / degrees_a_piece)));
    for (int i = 0; i <= pieces; ++i) {
      double const angle = (numbers[4] + turn * i / pieces) * std::numbers::pi / 180.0;
      draw_to(numbers[0] + numbers[2] * std::cos(angle), numbers[1] + numbers[3] * std::sin(angle));
    }
  }
};

void draw(std::string_view text, double left, std::vector<Stroke>& strokes) {
  Pen pen{strokes, left};
  while (!text.empty()) {
    if (text.front() == ';' || text.front() == ' ') {
      if (text.front() == ';') pen.at.reset();
      text.remove_prefix(1);
      continue;
    }
    bool const is_curve = text.front() == '@';
    if (is_curve) text.remove_prefix(1);
    std::array<double, 6> numbers{};
    std::size_t const count = is_curve ? 6 : 2;
    for (std::size_t i = 0; i < count; ++i) {
      auto const end = std::from_chars(text.data(), text.data() + text.size(), numbers[i]).ptr;
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
      if (i + 1 < count) text.remove_prefix(1);
    }
    if (is_curve)
      pen.draw_curve(numbers);
    else
      pen.draw_to(numbers[0], numbers[1]);
  }
}

Drawn const* find(char letter) {
  auto const found = std::ranges::find(drawn_letters, letter, &Drawn::letter);
  return found == drawn_letters.end() ? nullptr : &*found;
}

double squared_distance(Stroke const& stroke, double x, double y) {
  double const way_x = stroke.to_x - stroke.from_x;
  double const way_y = stroke.to_y - stroke.from_y;
  double const square = way_x * way_x + way_y * way_y;
  double const along = ((x - stroke.from_x) * way_x + (y - stroke.from_y) * way_y) / std::max(square, 1e-12);
  double const share = std::clamp(along, 0.0, 1.0);
  double const off_x = x - stroke.from_x - share * way_x;
  double const off_y = y - stroke.from_y - share * way_y;
  return off_x * off_x + off_y * off_y;
}

double left_end(Stroke const& stroke) {
  return std::min(stroke.from_x, stroke.to_x);
}

}  // namespace

bool has_letter(char letter) {
  return letter == ' ' || find(letter) != nullptr;
}

std::string known_letters() {
  std::string letters;
  for (auto const& one : drawn_letters) letters += one.letter;
  return letters;
}

LetterRow row_of_letters(std::string_view text) {
  LetterRow row;
  for (char const letter : text) {
    auto const* const drawn = find(letter);
    if (!drawn) {
      row.width += blank;
      continue;
    }
    if (row.width > 0.0) row.width += gap;
    draw(drawn->strokes, row.width, row.strokes);
    row.width += drawn->width * tenth;
  }
  std::ranges::stable_sort(row.strokes, {}, left_end);
  return row;
}

double distance_to_strokes(LetterRow const& row, double x, double y, double most) {
  // No stroke is longer than the diagonal of the widest letter, so those that end before `x` begin after this.
  constexpr double longest = 1.3;
  auto const first = std::ranges::lower_bound(row.strokes, x - most - longest, {}, left_end);
  double least = most * most;
  for (auto at = first; at != row.strokes.end() && left_end(*at) <= x + most; ++at)
    least = std::min(least, squared_distance(*at, x, y));
  return std::sqrt(least);
}

}  // namespace lapwing::sim::building
