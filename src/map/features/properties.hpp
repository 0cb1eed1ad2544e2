#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "base/error.hpp"
#include "map/features/feature.hpp"

/// The one table of what features have beside their geometry. Messages, columns of the store, fields of GIS files, the
/// types of the web app and the reference are all made from it: a new property is a member and a line here.
namespace lapwing::map {

enum class PropertyKind { boolean, integer, real, text, time };

/// Nothing: the feature does not have it.
using PropertyValue = std::variant<std::monostate, bool, std::int64_t, double, std::string, base::UtcTime>;

struct Property {
  std::string_view name;  ///< with its unit: "thickness_m"
  PropertyKind kind;
  std::string_view doc;
  PropertyValue (*get)(Content const&);
  /// Nothing takes it away. Properties may be set in any order. Errors, invalid_input: another kind of value, a word
  /// that is none of those that it may be; the message goes on after the name of the property ("takes a number").
  base::Result<> (*set)(Content&, PropertyValue const&);
  std::span<std::string_view const> words = {};  ///< what a text may be; empty: any
};

[[nodiscard]] std::span<Property const> properties_of(LayerKind layer);
[[nodiscard]] std::string_view name_of(PropertyKind kind);
/// Null when the layer has none of that name.
[[nodiscard]] Property const* property_named(LayerKind layer, std::string_view name);
/// A content of that layer with this geometry and nothing else. Error, invalid_input: a geometry of another kind.
[[nodiscard]] base::Result<Content> content_at(LayerKind layer, Geometry geometry);

}  // namespace lapwing::map
