#pragma once

#include <optional>
#include <string_view>

#include "dolphin/syntax/ast.hpp"
#include "dolphin/value/fault.hpp"
#include "dolphin/value/value.hpp"
#include "tasks/task.hpp"

/// What operators mean for values (language spec, section 2), except those that call closures: the machine does these
/// itself. Operands are never changed, `list << x` excepted.
namespace lapwing::dolphin {

/// `origin`: where a task that this makes stands in the script.
[[nodiscard]] Checked<Value> apply(Heap& heap, ast::BinaryOp op, Value const& left, Value const& right,
                                   tasks::Origin const& origin);
[[nodiscard]] Checked<Value> negate(Value const& operand);
/// `x in container`
[[nodiscard]] Checked<bool> contains(Value const& container, Value const& item);

/// `object[index]`: list and text by position (negative from the end), map by key, `task[vehicles]`.
[[nodiscard]] Checked<Value> element(Heap& heap, Value const& object, Value const& index, tasks::Origin const& origin);
[[nodiscard]] Checked<Value> set_element(Value const& object, Value const& index, Value value);

/// `number.unit`, e.g. 10.minutes = 600; nothing when `name` is no unit. The result keeps the number's kind where it
/// can.
[[nodiscard]] std::optional<Checked<Value>> with_unit(Value const& number, std::string_view name);

/// `first..last`, `first..<last`
[[nodiscard]] Checked<Value> make_range(Heap& heap, Value const& first, Value const& last, bool is_inclusive);

/// A new task value; a fault when it is nested too deep to be run.
[[nodiscard]] Checked<Value> task_value(Heap& heap, tasks::TaskTree tree);

}  // namespace lapwing::dolphin
