#pragma once

#include <string>
#include <string_view>

/// What people write who come from Python, JavaScript, Kotlin, Java or a ground station, and what it is called here.
/// Each function gives a hint such as "write true", or nothing for a word that it does not know.
namespace lapwing::dolphin {

/// A name that is no variable: `True`, `None`, `undefined`, `self`.
[[nodiscard]] std::string hint_for_name(std::string_view name);

/// Something that is called and does not exist: `len(x)`, `sleep 5`, `arm v`.
[[nodiscard]] std::string hint_for_call(std::string_view name);

/// A word where a mission wants a command: `land`, `goto`, `rtl`, `waypoint`.
[[nodiscard]] std::string hint_for_mission_word(std::string_view word);

/// A method that other languages give to texts, lists, maps or numbers: `append`, `upper`, `forEach`.
[[nodiscard]] std::string hint_for_method(std::string_view name);

/// The unit that an abbreviation or another spelling means: `s` is seconds; empty when there is none. The units' own
/// names stand for themselves.
[[nodiscard]] std::string_view unit_meant(std::string_view word);

/// The type of vehicle that a word of people means: `copter` is UAV; empty when there is none.
[[nodiscard]] std::string_view vehicle_type_meant(std::string_view word);

/// Words that begin a declaration in other languages: `var x = 1`, `function f(x) { }`.
[[nodiscard]] bool declares_variable(std::string_view word);
[[nodiscard]] bool declares_function(std::string_view word);

}  // namespace lapwing::dolphin
