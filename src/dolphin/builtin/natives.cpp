#include "dolphin/builtin/natives.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <unordered_map>

#include "dolphin/builtin/internal/native_lists.hpp"

namespace lapwing::dolphin {
namespace {

/// What a script can write comes first, then the words of handlers, then the helpers.
struct Table {
  std::vector<InstructionSpec> rows;
  std::size_t instructions = 0;
  std::size_t handler_words = 0;
  std::unordered_map<std::string_view, int> index;

  Table() {
    using namespace internal;
    for (auto const words : {vehicle_words, place_words, control_words, task_words, signal_words, maths_words})
      add(words());
    instructions = rows.size();
    add(internal::handler_words());
    handler_words = rows.size() - instructions;
    for (auto const helpers : {vehicle_helpers, task_helpers, signal_helpers}) add(helpers());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].call || rows[i].start) index.emplace(rows[i].name, static_cast<int>(i));
    }
  }

 private:
  void add(std::vector<InstructionSpec> some) { std::ranges::move(some, std::back_inserter(rows)); }
};

Table const& table() {
  static Table const the_table;
  return the_table;
}

}  // namespace

std::span<InstructionSpec const> natives() {
  return table().rows;
}

std::span<InstructionSpec const> instructions() {
  return natives().first(table().instructions);
}

std::span<InstructionSpec const> handler_words() {
  return natives().subspan(table().instructions, table().handler_words);
}

std::optional<int> find_native(std::string_view name) {
  auto const found = table().index.find(name);
  if (found == table().index.end()) return std::nullopt;
  return found->second;
}

}  // namespace lapwing::dolphin
