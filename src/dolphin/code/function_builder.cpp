#include "dolphin/code/internal/function_builder.hpp"

#include <ranges>

namespace lapwing::dolphin::internal {

int FunctionBuilder::emit(Op op, int a, int b) {
  function_.code.push_back({op, b, a});
  function_.lines.push_back(line_);
  return here() - 1;
}

void FunctionBuilder::emit_constant(Value value) {
  function_.constants.push_back(std::move(value));
  emit(Op::constant, static_cast<int>(function_.constants.size()) - 1);
}

int FunctionBuilder::name(std::string_view text) {
  auto const found = name_index_.find(text);
  if (found != name_index_.end()) return found->second;
  function_.names.emplace_back(text);
  auto const index = static_cast<int>(function_.names.size()) - 1;
  name_index_.emplace(text, index);
  return index;
}

int FunctionBuilder::new_slot() {
  is_captured_.push_back(false);
  return function_.locals++;
}

int FunctionBuilder::declare(std::string const& variable, std::string_view type) {
  int const slot = new_slot();
  if (!type.empty()) types_.emplace(slot, type);
  scopes_.back()[variable] = slot;
  return slot;
}

std::optional<int> FunctionBuilder::find_local(std::string const& variable) const {
  for (auto const& scope : scopes_ | std::views::reverse) {
    if (auto const found = scope.find(variable); found != scope.end()) return found->second;
  }
  return std::nullopt;
}

std::string_view FunctionBuilder::type_of(std::string const& variable) const {
  auto const local = find_local(variable);
  if (!local) return enclosing_ ? enclosing_->type_of(variable) : std::string_view();
  auto const found = types_.find(*local);
  return found == types_.end() ? std::string_view() : found->second;
}

std::optional<int> FunctionBuilder::capture(std::string const& variable) {
  if (!enclosing_) return std::nullopt;
  Capture wanted;
  if (auto const local = enclosing_->find_local(variable)) {
    enclosing_->is_captured_[static_cast<std::size_t>(*local)] = true;
    wanted = {true, *local};
  } else if (auto const outer = enclosing_->capture(variable)) {
    wanted = {false, *outer};
  } else {
    return std::nullopt;
  }
  auto const [place, is_new] =
      capture_index_.try_emplace({wanted.is_local, wanted.index}, static_cast<int>(function_.captures.size()));
  if (is_new) function_.captures.push_back(wanted);
  return place->second;
}

std::shared_ptr<Function const> FunctionBuilder::finish() {
  for (auto& instruction : function_.code) {
    auto const in_cell = [&] { return is_captured_[static_cast<std::size_t>(instruction.a)]; };
    switch (instruction.op) {
      case Op::load_local:
        if (in_cell()) instruction.op = Op::load_cell;
        break;
      case Op::store_local:
        if (in_cell()) instruction.op = Op::store_cell;
        break;
      case Op::declare_local: instruction.op = in_cell() ? Op::declare_cell : Op::store_local; break;
      case Op::adopt_parameter:
        if (in_cell()) instruction.op = Op::adopt_cell;
        break;
      default: break;
    }
  }
  return std::make_shared<Function const>(std::move(function_));
}

}  // namespace lapwing::dolphin::internal
