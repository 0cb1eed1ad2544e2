#include "dolphin/builtin/natives.hpp"

#include <string>
#include <unordered_map>

#include "dolphin/builtin/internal/native_lists.hpp"

namespace lapwing::dolphin {
namespace {

struct Table {
  std::vector<Native> natives;
  std::unordered_map<std::string_view, int> index;

  Table() {
    for (auto const part : {internal::control_natives(), internal::math_natives(), internal::task_natives(),
                            internal::vehicle_natives()}) {
      natives.insert(natives.end(), part.begin(), part.end());
    }
    for (std::size_t i = 0; i < natives.size(); ++i) index.emplace(natives[i].name, static_cast<int>(i));
  }
};

Table const& table() {
  static Table const the_table;
  return the_table;
}

}  // namespace

std::span<Native const> natives() {
  return table().natives;
}

std::optional<int> find_native(std::string_view name) {
  auto const found = table().index.find(name);
  if (found == table().index.end()) return std::nullopt;
  return found->second;
}

}  // namespace lapwing::dolphin
