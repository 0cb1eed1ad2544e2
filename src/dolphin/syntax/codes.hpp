#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "base/text/diagnostic.hpp"

/// Every kind of mistake that the language's reader, checker and compiler tell apart. The one table: editors, `--json`
/// and docs/reference/diagnostics.md take it from here, and each entry has its examples in tests/golden/codes.
namespace lapwing::dolphin {

namespace codes_detail {
using base::DiagnosticKind;
inline constexpr auto error = base::Severity::error;
inline constexpr auto warning = base::Severity::warning;
inline constexpr auto note = base::Severity::note;
}  // namespace codes_detail

// clang-format off: one line an entry reads as the table that it is
inline constexpr auto diagnostic_kinds = std::to_array<base::DiagnosticKind>({
    // ---- reading
    {"syntax", codes_detail::error, "Something else is expected here."},
    {"invalid-character", codes_detail::error, "A character that no script has: typographic quotes, dashes, control characters."},
    {"invalid-number", codes_detail::error, "Letters that cannot follow a number; a unit is written with a point."},
    {"number-too-large", codes_detail::error, "A number that does not fit: whole numbers have 64 bits."},
    {"invalid-escape", codes_detail::error, "A backslash that begins nothing known."},
    {"unclosed-string", codes_detail::error, "A string without its closing quotes."},
    {"unclosed-interpolation", codes_detail::error, "A `${` in a string without its `}`."},
    {"unclosed-comment", codes_detail::error, "A `/*` without its `*/`."},
    {"nested-comment", codes_detail::error, "A `/*` inside a comment: comments do not nest."},
    {"wrong-encoding", codes_detail::error, "A file that is not saved as UTF-8."},
    {"foreign-operator", codes_detail::error, "An operator of another language."},
    {"invalid-pattern", codes_detail::error, "A regular expression that cannot be read."},
    {"unclosed-bracket", codes_detail::error, "A bracket without its partner."},
    {"unmatched-bracket", codes_detail::error, "A closing bracket that closes nothing."},
    {"nested-too-deeply", codes_detail::error, "More levels, or operators after each other, than are read."},
    {"script-too-long", codes_detail::error, "More bytes or words than are read."},
    {"incomplete-chain", codes_detail::error, "`waitFor`, `when`, `until`, `during` or `watch` without its closure or its second word."},
    {"unsupported-statement", codes_detail::error, "A statement of Groovy or Java that the language does not have."},
    {"not-assignable", codes_detail::error, "A value is assigned to something that cannot hold one."},
    {"nested-function", codes_detail::error, "A function is declared within other code."},
    {"needless-import", codes_detail::note, "Imports are accepted and do nothing."},
    {"whole-argument", codes_detail::warning, "`execute (a) | b`: all that follows is taken as the argument."},
    {"legacy-spelling", codes_detail::warning, "An old spelling, which is still understood."},
    {"missing-parentheses", codes_detail::error, "`move -5, 0`: a subtraction where a negative argument is meant."},
    // ---- names
    {"unknown-name", codes_detail::error, "A variable that nothing gives a value."},
    {"unknown-instruction", codes_detail::error, "A call of something that does not exist, or not here."},
    {"unknown-unit", codes_detail::error, "A number has no such unit."},
    {"unknown-member", codes_detail::error, "The value has no such member or method."},
    {"unknown-type", codes_detail::error, "There is no such type."},
    {"hidden-variable", codes_detail::error, "A local variable is used outside the code that sees it."},
    {"used-before-value", codes_detail::error, "A variable is used before it gets its first value."},
    {"redeclared-variable", codes_detail::error, "A variable is declared a second time in the same code."},
    {"duplicate-function", codes_detail::error, "Two functions have the same name and number of parameters."},
    {"duplicate-key", codes_detail::error, "A key stands twice in one call or map."},
    {"instruction-as-value", codes_detail::error, "An instruction is used as if it were a variable."},
    {"label", codes_detail::error, "`name:` where it does nothing."},
    {"hidden-instruction", codes_detail::warning, "A function has the name of an instruction, which is then no longer there."},
    {"assigned-field", codes_detail::warning, "`type = 'UAV'` inside a block makes a variable and sets no field."},
    // ---- calls and values
    {"argument-count", codes_detail::error, "Too many or too few arguments."},
    {"argument-type", codes_detail::error, "An argument of a kind that the instruction does not take."},
    {"argument-dimension", codes_detail::error, "A length where a time is needed, and the like."},
    {"argument-choice", codes_detail::error, "A word that is not one of those that can be chosen."},
    {"argument-value", codes_detail::error, "A number that the instruction refuses, whatever else happens."},
    {"named-arguments", codes_detail::error, "`name: value` where none is taken, or together with values without a name."},
    {"declared-type", codes_detail::error, "A value that the declared type of a variable or parameter does not take."},
    {"operand-type", codes_detail::error, "An operator that does not join values of these kinds."},
    {"mixed-dimensions", codes_detail::error, "A sum of a length and a time, and the like."},
    {"compared-dimensions", codes_detail::warning, "A length is compared with a time, and the like."},
    {"never-equal", codes_detail::warning, "Values of different kinds are compared with == or !=."},
    {"battery-ratio", codes_detail::warning, "A battery is compared with more than 1; full is 1, or 100.percent."},
    {"radians", codes_detail::warning, "`new Position` takes radians."},
    {"not-a-task", codes_detail::error, "Something that is no task where one is needed."},
    {"not-vehicles", codes_detail::error, "Something that is no set of vehicles where one is needed."},
    {"halting-value", codes_detail::warning, "A value with which the instruction halts the script."},
    {"misspelt-type", codes_detail::warning, "A type that no vehicle has, and that is nearly one."},
    {"imc-plan", codes_detail::error, "Plans in the form of IMC are not supported."},
    {"invalid-mission", codes_detail::error, "A mission that cannot be flown, for example a relative move without `home`."},
    {"implausible-mission", codes_detail::warning, "A mission that hardly makes sense, wherever it is flown; before a flight more is known, and more is said."},
    // ---- flow
    {"misplaced-break", codes_detail::error, "`break` or `continue` outside a loop."},
    {"misplaced-when", codes_detail::error, "`when` outside `oneOf`, `choose` and `allOf`."},
    {"unreachable-code", codes_detail::warning, "Code that nothing reaches."},
    {"never-executed", codes_detail::warning, "A task is made and thrown away."},
    {"endless-loop", codes_detail::warning, "A loop without an end, in which nothing waits."},
    {"no-branches", codes_detail::warning, "A choice without `when`: it halts the script."},
    {"nested-execute", codes_detail::warning, "`execute` in code that a running task calls; it fails there."},
    {"consume-in-guard", codes_detail::warning, "A guard takes a signal that is lost when the task round it is stopped."},
    {"unused-value", codes_detail::warning, "A value is worked out and thrown away."},
    {"duplicate-case", codes_detail::warning, "A value stands in two cases of one switch."},
    {"unposted-signal", codes_detail::warning, "A signal is waited for that nothing in the script posts."},
    {"never-called", codes_detail::warning, "A closure is written and thrown away."},
    // ---- vehicles
    {"used-after-release", codes_detail::error, "Released vehicles are used."},
    {"maybe-released", codes_detail::warning, "Vehicles are used that have been released on some way to here."},
    {"vehicle-used-twice", codes_detail::error, "Tasks that run at once need the same vehicle."},
    {"too-few-vehicles", codes_detail::error, "Tasks that run at once need more vehicles than there are."},
    {"no-vehicle", codes_detail::warning, "A task that needs a vehicle, and the script has picked none."},
    {"several-vehicles", codes_detail::warning, "A set of several vehicles where one is needed; the script halts there."},
    {"unsuited-vehicle", codes_detail::error, "A task that vehicles of the picked type cannot carry out."},
    {"missing-payload", codes_detail::warning, "A task that needs a payload which was not asked for."},
    {"internal", codes_detail::error, "A mistake of Lapwing itself; please report it."},
});
// clang-format on

/// The kind of that code; a code that is not in the table does not compile.
consteval base::DiagnosticKind const& code(std::string_view name) {
  return *std::ranges::find(diagnostic_kinds, name, &base::DiagnosticKind::code);
}

}  // namespace lapwing::dolphin
