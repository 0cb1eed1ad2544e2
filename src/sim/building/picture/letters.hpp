#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The letters of signs: our own, drawn as strokes of one width, so that they are sharp at any distance.
namespace lapwing::sim::building {

/// A straight piece of a letter; letters' own plane, x to the right from the row's left end, y up from its foot line,
/// capitals 1 high.
struct Stroke {
  double from_x = 0.0;
  double from_y = 0.0;
  double to_x = 0.0;
  double to_y = 0.0;
};

inline constexpr double stroke_width = 0.15;  ///< of capitals' height

struct LetterRow {
  std::vector<Stroke> strokes;  ///< from left to right by their left ends
  double width = 0.0;
};

/// Letters, digits and what stands on signs of rooms; blanks, too.
[[nodiscard]] bool has_letter(char letter);
/// For people: every letter that there is.
[[nodiscard]] std::string known_letters();

/// One row. Letters that there are none of are left out as blanks.
[[nodiscard]] LetterRow row_of_letters(std::string_view text);

/// From a point to the middle of the nearest stroke; at most `most`.
[[nodiscard]] double distance_to_strokes(LetterRow const& row, double x, double y, double most);

}  // namespace lapwing::sim::building
