#include "vision/signs/room_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <vector>

namespace lapwing::vision {

namespace {

struct Kind {
  std::string_view word;
  std::string_view kind;
};

/// Whole words, in capitals.
constexpr std::array kinds{Kind{"WOMEN", "women"},
                           Kind{"WOMAN", "women"},
                           Kind{"LADIES", "women"},
                           Kind{"MEN", "men"},
                           Kind{"GENTLEMEN", "men"},
                           Kind{"RESTROOM", "toilet"},
                           Kind{"RESTROOMS", "toilet"},
                           Kind{"TOILET", "toilet"},
                           Kind{"TOILETS", "toilet"},
                           Kind{"WC", "toilet"},
                           Kind{"OFFICE", "office"},
                           Kind{"LAB", "laboratory"},
                           Kind{"LABORATORY", "laboratory"},
                           Kind{"STAIRS", "stairs"},
                           Kind{"STAIR", "stairs"},
                           Kind{"STAIRWAY", "stairs"},
                           Kind{"EXIT", "exit"},
                           Kind{"ELEVATOR", "elevator"},
                           Kind{"LIFT", "elevator"},
                           Kind{"KITCHEN", "kitchen"},
                           Kind{"SERVER", "server room"},
                           Kind{"MEETING", "meeting room"},
                           Kind{"CONFERENCE", "meeting room"},
                           Kind{"STORAGE", "storage"},
                           Kind{"ELECTRICAL", "electrical"},
                           Kind{"LECTURE", "lecture hall"},
                           Kind{"CLASSROOM", "classroom"},
                           Kind{"LIBRARY", "library"},
                           Kind{"FLOOR", "floor"}};

/// Many things look like a letter and a digit.
constexpr double least_of_short = 0.6;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

bool is_between(char c) {
  return c == '-' || c == '.';
}

/// Capitals; the many dashes and raised dots of Unicode become '-'; what is neither letter, digit, '-' nor '.' becomes
/// a blank.
std::string plain(std::string_view line) {
  constexpr std::array<std::string_view, 12> dashes{"\u2010", "\u2011", "\u2012", "\u2013", "\u2014", "\u2212",
                                                    "\u00B7", "\u2022", "\u30FB", "\uFF0D", "\u4E00", "~"};
  std::string text;
  while (!line.empty()) {
    auto const dash = std::ranges::find_if(dashes, [&](auto one) { return line.starts_with(one); });
    if (dash != dashes.end()) {
      text += '-';
      line.remove_prefix(dash->size());
      continue;
    }
    char const c = line.front();
    bool const is_ascii = static_cast<unsigned char>(c) < 0x80U;
    char const capital = is_ascii ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : ' ';
    text += is_digit(capital) || is_capital(capital) || is_between(capital) ? capital : (c == '|' ? 'I' : ' ');
    line.remove_prefix(1);
  }
  return text;
}

std::vector<std::string> words_of(std::string const& text) {
  std::vector<std::string> words(1);
  for (char const c : text) {
    if (c == ' ') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  for (auto& word : words) {
    while (!word.empty() && is_between(word.front())) word.erase(0, 1);
    while (!word.empty() && is_between(word.back())) word.pop_back();
  }
  std::erase(words, "");
  return words;
}

std::optional<char> digit_alike(char c) {
  switch (c) {
    case 'O':
    case 'Q':
    case 'D': return '0';
    case 'I':
    case 'L': return '1';
    case 'Z': return '2';
    case 'S': return '5';
    case 'B': return '8';
    default: return std::nullopt;
  }
}

/// A letter with digits on both sides, or after a dash and before a digit where the rest is digits, is a digit that was
/// misread.
std::string with_digits(std::string word) {
  for (std::size_t k = 1; k + 1 < word.size(); ++k) {
    if (auto const digit = digit_alike(word[k]); digit && is_digit(word[k - 1]) && is_digit(word[k + 1]))
      word[k] = *digit;
  }
  return word;
}

/// Up to three letters, digits, up to two letters.
bool is_number_part(std::string_view part) {
  std::size_t at = 0;
  while (at < part.size() && is_capital(part[at])) ++at;
  std::size_t const first = at;
  while (at < part.size() && is_digit(part[at])) ++at;
  std::size_t const digits = at - first;
  while (at < part.size() && is_capital(part[at])) ++at;
  std::size_t const last = at - first - digits;
  return at == part.size() && first <= 3 && digits >= 1 && digits <= 4 && last <= 2;
}

/// One part, or two and three with something between; the first of several may be letters alone ("ITB-221").
bool is_number(std::string_view word) {
  std::size_t digits = static_cast<std::size_t>(std::ranges::count_if(word, is_digit));
  if (digits < 2 || digits > 8 || word.size() > 12) return false;
  std::size_t parts = 0;
  std::size_t begin = 0;
  while (begin <= word.size()) {
    auto const end = std::min(word.find_first_of("-.", begin), word.size());
    auto const part = word.substr(begin, end - begin);
    bool const are_letters = !part.empty() && part.size() <= 4 && std::ranges::all_of(part, is_capital);
    if (!is_number_part(part) && !(parts == 0 && are_letters && end < word.size())) return false;
    ++parts;
    begin = end + 1;
  }
  return parts <= 3;
}

/// "A1", "2B": too little to be told from what only looks like letters, where it does not stand alone.
bool is_short_number(std::string_view word) {
  return word.size() >= 2 && word.size() <= 3 && std::ranges::count_if(word, is_digit) == 1 && is_number_part(word);
}

/// One letter more, less or another.
bool is_almost(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  if (b.size() - a.size() > 1) return false;
  std::size_t at = 0;
  while (at < a.size() && a[at] == b[at]) ++at;
  return b.size() == a.size() ? a.substr(std::min(at + 1, a.size())) == b.substr(std::min(at + 1, b.size()))
                              : a.substr(at) == b.substr(at + 1);
}

std::optional<std::string> kind_of(std::string_view word) {
  constexpr std::size_t long_word = 5;
  for (auto const& [name, kind] : kinds) {
    if (word == name) return std::string(kind);
  }
  for (auto const& [name, kind] : kinds) {
    if (name.size() >= long_word && is_almost(word, name)) return std::string(kind);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> joined_number(std::string const& building, std::string const& room) {
  bool const is_building = is_number_part(building) && building.size() <= 3;
  bool const is_wing = building.size() == 1 && is_capital(building.front());
  bool const is_room = room.size() >= 3 && is_number_part(room) && is_digit(room.front());
  if (!is_room || !(is_building || is_wing)) return std::nullopt;
  return building + "-" + room;
}

RoomText room_text(std::string_view line) {
  RoomText found;
  auto words = words_of(plain(line));
  for (auto& word : words) word = with_digits(word);
  for (auto const& word : words) {
    if (!found.kind) found.kind = kind_of(word);
  }
  for (std::size_t k = 0; k < words.size() && !found.number; ++k) {
    if (k + 1 < words.size()) found.number = joined_number(words[k], words[k + 1]);
    if (!found.number && is_number(words[k])) found.number = words[k];
  }
  if (!found.number && words.size() == 1 && is_short_number(words.front())) found.number = words.front();
  return found;
}

std::optional<Vote> vote_on_number(std::span<Reading const> readings) {
  std::map<std::string, double> votes;
  double all = 0.0;
  for (auto const& reading : readings) {
    all += reading.confidence;
    if (auto const text = room_text(reading.text); text.number) votes[*text.number] += reading.confidence;
  }
  auto const best = std::ranges::max_element(votes, {}, [](auto const& vote) { return vote.second; });
  if (best == votes.end() || all <= 0.0) return std::nullopt;
  Vote const vote{best->first, best->second / static_cast<double>(readings.size())};
  if (is_short_number(vote.number) && vote.confidence < least_of_short) return std::nullopt;
  return vote;
}

}  // namespace lapwing::vision
