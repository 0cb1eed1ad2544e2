#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <unordered_map>

#include "dolphin/builtin/internal/method_rows.hpp"
#include "dolphin/builtin/members.hpp"
#include "dolphin/machine/runtime.hpp"

/// The table of methods as one, and how a call finds its row.
namespace lapwing::dolphin {

Checked<std::int64_t> MethodCall::integer_argument(std::size_t index) const {
  auto const& given = arguments[index];
  if (given.is(ValueKind::integer)) return given.integer();
  return fault(fmt::format("{} takes an integer, not {}", name, kind_name(given)), "IllegalArgumentException");
}

namespace {

/// Cheap, and enough to tell some two hundred names apart: a script calls methods all the time.
struct NameHash {
  std::size_t operator()(std::string_view name) const {
    if (name.empty()) return 0;
    auto const letter = [&](std::size_t at) { return static_cast<unsigned char>(name[at]); };
    return ((name.size() * 31U + letter(0)) * 31U + letter(name.size() / 2)) * 31U + letter(name.size() - 1);
  }
};

/// What a script can write comes first, then what the prelude alone calls.
struct Table {
  struct Row {
    MethodSpec const* method;
    ArgumentCount takes;
  };
  std::vector<MethodSpec> methods;
  std::size_t words = 0;
  std::unordered_map<std::string_view, std::vector<Row>, NameHash> index;

  Table() {
    using namespace internal;
    for (auto const part : {walking_methods(), list_methods(), text_methods(), value_methods()})
      methods.insert(methods.end(), part.begin(), part.end());
    words = methods.size();
    auto const helpers = prelude_methods();
    methods.insert(methods.end(), helpers.begin(), helpers.end());
    for (auto const& one : methods) {
      if (one.call) index[one.name].push_back({&one, argument_count(one)});
    }
  }
};

Table const& table() {
  static Table const the_table;
  return the_table;
}

MethodResult looked_up(Runtime& runtime, Value const& object, std::string_view name, Arguments arguments,
                       bool is_property) {
  auto const found = table().index.find(name);
  if (found == table().index.end()) return std::nullopt;
  MethodCall const call{runtime, runtime.heap, runtime.patterns, name, arguments};
  MethodSpec const* last = nullptr;  // its result goes straight to the caller
  for (auto const& [method, takes] : found->second) {
    if (method->is_property != is_property || !takes.allows(arguments.size())) continue;
    if (last) {
      if (auto result = last->call(call, object)) return result;
    }
    last = method;
  }
  return last ? last->call(call, object) : std::nullopt;
}

bool is_getter(std::string_view name) {
  return name.size() > 3 && name.starts_with("get") && std::isupper(name[3]);
}

}  // namespace

std::span<MethodSpec const> methods() {
  return std::span(table().methods).first(table().words);
}

MethodResult property(Runtime& runtime, Value const& object, std::string_view name) {
  return looked_up(runtime, object, name, {}, true);
}

MethodResult call_method(Runtime& runtime, Value const& object, std::string_view name, Arguments arguments) {
  // A map has what was put into it and nothing that getters could get.
  bool const gets = is_getter(name) && arguments.empty() && !object.is(ValueKind::map);
  if (!gets) return looked_up(runtime, object, name, arguments, false);
  if (auto result = looked_up(runtime, object, name, arguments, false)) return result;
  std::string getter(name.substr(3));
  getter[0] = static_cast<char>(std::tolower(getter[0]));
  return member(runtime, object, getter);
}

}  // namespace lapwing::dolphin
