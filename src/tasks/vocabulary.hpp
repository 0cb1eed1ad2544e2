#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "geo/area.hpp"
#include "geo/position.hpp"

/// What a platform adds to the mission language: block words with their commands (`mission { takeOff ... }`), and
/// instructions for vehicles (`sendMessage v, ...`). The checker, the editor's services and the reference page know
/// them by this value alone; what they do is the platform's.
namespace lapwing::tasks {

/// A layer of the map by its name: "slots". Whether there is such a layer, who draws on it and what it shows are the
/// platform's to know.
struct LayerName {
  std::string text;
  friend bool operator==(LayerName const&, LayerName const&) = default;
};

/// One value of a list.
using Item = std::variant<std::monostate, bool, std::int64_t, double, std::string, geo::Wgs84, geo::Ned>;
using List = std::vector<Item>;

/// A script value as a platform receives it. Units are already SI (angles that users write in degrees stay degrees only
/// where the parameter says so); a vehicle set never reaches a builder.
using Argument = std::variant<std::monostate, bool, std::int64_t, double, std::string, geo::Wgs84, geo::Ned, List,
                              geo::Area, LayerName>;

[[nodiscard]] Argument argument_of(Item const& item);
/// Nothing for a list, an area and a layer, which no list holds.
[[nodiscard]] std::optional<Item> item_of(Argument const& argument);
/// An area, or the one whose corners are in the list; nothing for anything else. It may have a fault.
[[nodiscard]] std::optional<geo::Area> area_from(Argument const& argument);

enum class Type {
  number,
  integer,
  text,
  boolean,
  position,
  displacement,
  list,   ///< of items of one type
  area,   ///< written `centre ^ radius`, or as the list of its corners
  layer,  ///< written as a text, its name
};
/// What a number means, for the checker: `timeout 2.km` is wrong before anything flies.
enum class Dimension { none, length, angle, time, speed, ratio };

struct Parameter {
  std::string_view name;
  Type type = Type::number;
  Dimension dimension = Dimension::none;            ///< of a list: of its items
  std::optional<Argument> fallback = std::nullopt;  ///< present: the argument may be left out (trailing ones only)
  std::string_view doc = {};
  std::vector<std::string_view> choices = {};  ///< text parameters with a fixed set of values
  Type items = Type::number;  ///< what a list holds; number, integer, text, boolean, position or displacement

  friend bool operator==(Parameter const&, Parameter const&) = default;
};

struct Overload {
  std::vector<Parameter> parameters;
  friend bool operator==(Overload const&, Overload const&) = default;
};

/// One word that may stand inside a builder's block: `takeOff pos, 15`.
struct CommandSpec {
  std::string_view name;
  std::vector<Overload> overloads;
  std::string_view doc;
  /// The types of vehicle ("UAV") that can carry it out; empty: every type.
  std::vector<std::string_view> vehicle_types = {};

  /// False when no vehicle of that type can carry it out: `takeOff` for a "UGV".
  [[nodiscard]] bool suits(std::string_view vehicle_type) const {
    return vehicle_types.empty() || std::ranges::find(vehicle_types, vehicle_type) != vehicle_types.end();
  }
  friend bool operator==(CommandSpec const&, CommandSpec const&) = default;
};

class PlatformTask;

/// Something in a block, or between two, that hardly makes sense. For warnings: what may be meant all the same runs.
struct Doubt {
  std::optional<std::size_t> call;  ///< which `add` of the block, counted from 0; nothing: the block as a whole
  std::string what;
  std::string hint = {};
};

/// Collects the commands of one block. Arguments arrive complete (fallbacks filled in) and of the declared types.
class BuilderSession {
 public:
  virtual ~BuilderSession() = default;
  /// `command` and `overload` index the builder's table.
  virtual base::Result<> add(std::size_t command, std::size_t overload, std::span<Argument const> arguments) = 0;
  virtual base::Result<std::shared_ptr<PlatformTask const>> finish() = 0;
  /// What of the commands so far hardly makes sense, whatever vehicle carries them out.
  [[nodiscard]] virtual std::vector<Doubt> doubts() const { return {}; }
};

/// A block word of the language that a platform adds, e.g. `mission { ... }`.
struct BuilderSpec {
  std::string_view name;
  std::vector<CommandSpec> commands;
  std::string_view doc;
  std::function<std::unique_ptr<BuilderSession>()> begin;
};

/// An instruction that a platform adds, e.g. `sendMessage v, 'COMMAND_LONG', command: 400`. Given to each vehicle of a
/// set, all of which must be picked; done at once, without a value. `Platform::perform` carries it out.
struct VehicleInstruction {
  std::string_view name;
  std::vector<Parameter> parameters;  ///< behind the vehicles
  bool takes_values = false;          ///< also any number of `name: value`: numbers, texts, true and false
  std::string_view doc;
  std::string_view usage;         ///< behind its name, for who has given it wrongly: "takes vehicles and ..."
  std::string_view example = {};  ///< a script that checks

  friend bool operator==(VehicleInstruction const&, VehicleInstruction const&) = default;
};

struct Vocabulary {
  std::vector<BuilderSpec> builders;
  std::vector<VehicleInstruction> instructions;
};

/// Puts the words of `more` beside those of `into`. A word that both have is one word when both say the same of it, and
/// then what it builds is built by the first; else the error, invalid_input, names it and `into` stays as it is.
[[nodiscard]] base::Result<> join(Vocabulary& into, Vocabulary const& more);

}  // namespace lapwing::tasks
