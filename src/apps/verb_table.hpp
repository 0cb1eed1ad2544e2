#pragma once

#include <span>
#include <string_view>

namespace lapwing::apps {

/// The program that people start. What it cannot do itself it hands over to others of its folder, as git does, so that
/// who only writes scripts neither installs nor loads what vehicles, maps and cameras need.
inline constexpr std::string_view front_program = "lapwing";

struct Verb {
  std::string_view name;
  std::string_view about;    ///< one line for help
  std::string_view program;  ///< the executable that has it
};

/// Every verb of every program, in the order in which help shows them.
[[nodiscard]] std::span<Verb const> all_verbs();
/// Null when there is none of that name.
[[nodiscard]] Verb const* find_verb(std::string_view name);

}  // namespace lapwing::apps
