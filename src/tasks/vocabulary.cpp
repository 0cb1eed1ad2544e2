#include "tasks/vocabulary.hpp"

#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace lapwing::tasks {
namespace {

template <class Word>
Word const* find(std::vector<Word> const& words, std::string_view name) {
  auto const found = std::ranges::find(words, name, &Word::name);
  return found == words.end() ? nullptr : &*found;
}

/// Sessions cannot be compared; what a script sees of them can.
bool is_same(BuilderSpec const& a, BuilderSpec const& b) {
  return a.commands == b.commands && a.doc == b.doc;
}
bool is_same(VehicleInstruction const& a, VehicleInstruction const& b) {
  return a == b;
}

std::unexpected<base::Error> taken(std::string_view kind, std::string_view name) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("the {} {} has two meanings", kind, name),
                    "give it one name on one platform and another on the other");
}

}  // namespace

Argument argument_of(Item const& item) {
  return std::visit([](auto const& one) { return Argument(one); }, item);
}

std::optional<Item> item_of(Argument const& argument) {
  return std::visit(
      [](auto const& one) -> std::optional<Item> {
        using Held = std::remove_cvref_t<decltype(one)>;
        constexpr bool is_item =
            !std::is_same_v<Held, List> && !std::is_same_v<Held, geo::Area> && !std::is_same_v<Held, LayerName>;
        if constexpr (is_item) return Item(one);
        return std::nullopt;
      },
      argument);
}

std::optional<geo::Area> area_from(Argument const& argument) {
  if (auto const* area = std::get_if<geo::Area>(&argument)) return *area;
  auto const* list = std::get_if<List>(&argument);
  if (!list) return std::nullopt;
  geo::Outline outline;
  for (auto const& item : *list) {
    auto const* corner = std::get_if<geo::Wgs84>(&item);
    if (!corner) return std::nullopt;
    outline.corners.push_back(*corner);
  }
  return outline;
}

base::Result<> join(Vocabulary& into, Vocabulary const& more) {
  auto joined = into;
  for (auto const& builder : more.builders) {
    auto const* known = find(into.builders, builder.name);
    bool const is_taken = (known && !is_same(*known, builder)) || find(into.instructions, builder.name);
    if (is_taken) return taken("block word", builder.name);
    if (!known) joined.builders.push_back(builder);
  }
  for (auto const& instruction : more.instructions) {
    auto const* known = find(into.instructions, instruction.name);
    bool const is_taken = (known && !is_same(*known, instruction)) || find(into.builders, instruction.name);
    if (is_taken) return taken("instruction", instruction.name);
    if (!known) joined.instructions.push_back(instruction);
  }
  into = std::move(joined);
  return {};
}

}  // namespace lapwing::tasks
