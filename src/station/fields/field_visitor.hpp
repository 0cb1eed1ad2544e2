#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "vehicle/aged.hpp"

/// How a table of fields is written down once and read in several ways: as a message, as what to compare with the last
/// message, as types of the web app, as a page of the reference. For .cpp files.
namespace lapwing::station::internal {

/// What a number is in, to how many decimals it is worth telling (below 0: to tens, hundreds), and what it can be.
struct Unit {
  std::string_view name = {};  ///< empty for what only counts
  int decimals = 0;
  double low = 0.0;
  double high = 0.0;

  [[nodiscard]] constexpr Unit within(double from, double to) const { return {name, decimals, from, to}; }
};

constexpr Unit count{.high = 9'007'199'254'740'991};  // the largest that a browser counts to
constexpr Unit metres(int decimals) {
  return {"m", decimals, -1e7, 1e7};
}
constexpr Unit metres_a_second(int decimals) {
  return {"m/s", decimals, -1000, 1000};
}
constexpr Unit degrees(int decimals) {
  return {"degrees", decimals, -180, 180};
}
constexpr Unit radians(int decimals) {
  return {"rad", decimals, -1000, 1000};
}
constexpr Unit seconds(int decimals) {
  return {"s", decimals, 0, 1e9};
}
constexpr Unit share(int decimals) {
  return {"0 to 1", decimals, 0, 1};
}
constexpr Unit ratio(int decimals) {
  return {{}, decimals, -1e6, 1e6};
}
constexpr Unit volts(int decimals) {
  return {"V", decimals, 0, 1e4};
}
constexpr Unit amperes(int decimals) {
  return {"A", decimals, -1e4, 1e4};
}
constexpr Unit ampere_hours(int decimals) {
  return {"Ah", decimals, 0, 1e6};
}
constexpr Unit a_second(int decimals) {
  return {"1/s", decimals, 0, 1e9};
}

/// As many decimals as the unit has; a number that is none stays none.
[[nodiscard]] double rounded(double value, Unit const& unit);

/// A text that is one of few.
struct Words {
  std::string_view type;  ///< what the web app calls them
  std::span<std::string_view const> words;
  std::string_view otherwise = {};  ///< which of them is meant by a word that is not known yet; empty: none
};

/// What an object is called in the web app.
struct Type {
  std::string_view name = {};
  std::string_view doc = {};
};

/// By what the entries of a list differ.
enum class Unique { no, by_value, by_name, by_id };

/// One line of a table.
struct Member {
  std::string_view key = {};
  std::string_view doc = {};
  std::string_view from = {};  ///< which message of the vehicle tells it
  bool is_optional = false;
  bool has_age = false;
  std::optional<base::TimePoint> heard = {};
};

/// Is shown the lines of a table with their values, in order. Members of objects and entries of lists come between
/// `begin_...` and `end`; entries have no key.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;

  /// Also what has no value now, and one entry of each list: for who describes them.
  [[nodiscard]] virtual bool wants_all() const { return false; }
  /// Asked first; nothing of the line comes when it says no.
  [[nodiscard]] virtual bool wants(Member const&) { return true; }
  /// Without a value: null, as an entry of a list.
  virtual void number(Member const& member, std::optional<double> value, Unit const& unit) = 0;
  virtual void flag(Member const& member, bool value) = 0;
  virtual void text(Member const& member, std::string_view value) = 0;
  virtual void word(Member const& member, std::string_view value, Words const& words) = 0;
  virtual void begin_object(Member const& member, Type const& type) = 0;
  virtual void begin_list(Member const& member, Unique unique) = 0;
  virtual void end() = 0;
};

/// A value that may be missing, and when it was heard, where that counts.
template <class T>
struct Told {
  T const* value = nullptr;
  bool is_optional = false;
  bool has_age = false;
  std::optional<base::TimePoint> heard = {};
};

template <class T>
Told<T> told(T const& value) {
  return {.value = &value};
}
template <class T>
Told<T> told(std::optional<T> const& value) {
  return {.value = value ? &*value : nullptr, .is_optional = true};
}
template <class T>
Told<T> told(vehicle::Aged<T> const& aged) {
  auto const& value = aged.value;
  return {.value = value ? &*value : nullptr, .is_optional = true, .has_age = true, .heard = aged.heard};
}
template <class T>
Told<T> told(Told<T> const& value) {
  return value;
}
/// One with an age, where `Aged` does not hold it; without `heard` it has none just now.
template <class T>
Told<T> told_at(T const& value, std::optional<base::TimePoint> heard) {
  return {.value = &value, .has_age = true, .heard = heard};
}
/// The same, missing when it is empty.
template <class T>
Told<T> told_if_any(T const& list, std::optional<base::TimePoint> heard) {
  return {.value = list.empty() ? nullptr : &list, .is_optional = true, .has_age = true, .heard = heard};
}

inline double to_number(base::Duration time) {
  return base::to_seconds(time);
}
template <class Number>
double to_number(Number number) {
  return static_cast<double>(number);
}

/// Shows a visitor a table, line by line. An object's own lines are in `members(FieldTable&, T const&)`.
class FieldTable {
 public:
  using Text = std::string_view;

  explicit FieldTable(FieldVisitor& visitor) : visitor_(visitor) {}

  template <class Value>
  void number(Text key, Value const& value, Unit const& unit, Text doc = {}, Text from = {}) {
    show(key, told(value), doc, from,
         [&](Member const& member, auto const& known) { visitor_.number(member, to_number(known), unit); });
  }

  template <class Value>
  void flag(Text key, Value const& value, Text doc = {}, Text from = {}) {
    show(key, told(value), doc, from, [&](Member const& member, bool known) { visitor_.flag(member, known); });
  }

  template <class Value>
  void text(Text key, Value const& value, Text doc = {}, Text from = {}) {
    show(key, told(value), doc, from, [&](Member const& member, Text known) { visitor_.text(member, known); });
  }

  void word(Text key, Text value, Words const& words, Text doc = {}, Text from = {}) {
    show(key, told(value), doc, from, [&](Member const& member, Text known) { visitor_.word(member, known, words); });
  }

  template <class Value>
  void object(Text key, Value const& value, Type const& type, Text doc = {}, Text from = {}) {
    show(key, told(value), doc, from, [&](Member const& member, auto const& known) { entry(member, known, type); });
  }

  /// Of objects.
  template <class List>
  void list(Text key, List const& entries, Unique unique, Type const& type, Text doc = {}, Text from = {}) {
    show_list(key, told(entries), unique, doc, from, [&](auto const& known) { entry({}, known, type); });
  }

  template <class List>
  void texts(Text key, List const& entries, Unique unique, Text doc = {}, Text from = {}) {
    show_list(key, told(entries), unique, doc, from, [&](Text known) { visitor_.text({}, known); });
  }

  /// Null for those without a value.
  template <class List>
  void numbers(Text key, List const& entries, Unit const& unit, Text doc = {}, Text from = {}) {
    show_list(key, told(entries), Unique::no, doc, from, [&](auto const& known) {
      auto const value = known ? std::optional(to_number(*known)) : std::nullopt;
      visitor_.number({.is_optional = true}, value, unit);
    });
  }

 private:
  template <class T, class Show>
  void show(Text key, Told<T> const& value, Text doc, Text from, Show show_value) {
    if (!value.value && !visitor_.wants_all()) return;
    Member const member{.key = key,
                        .doc = doc,
                        .from = from,
                        .is_optional = value.is_optional,
                        .has_age = value.has_age,
                        .heard = value.heard};
    if (!visitor_.wants(member)) return;
    if (value.value) return show_value(member, *value.value);
    show_value(member, T{});
  }

  template <class List, class ShowEntry>
  void show_list(Text key, Told<List> const& entries, Unique unique, Text doc, Text from, ShowEntry show_entry) {
    show(key, entries, doc, from, [&](Member const& member, List const& known) {
      visitor_.begin_list(member, unique);
      for (auto const& one : known) show_entry(one);
      if (known.empty() && visitor_.wants_all()) show_entry(typename List::value_type{});
      visitor_.end();
    });
  }

  template <class T>
  void entry(Member const& member, T const& value, Type const& type) {
    visitor_.begin_object(member, type);
    members(*this, value);
    visitor_.end();
  }

  FieldVisitor& visitor_;
};

}  // namespace lapwing::station::internal
