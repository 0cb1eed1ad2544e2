#pragma once

#include <array>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include <ardupilotmega/ardupilotmega.hpp>
#include <development/mavlink_msg_available_modes.hpp>
#include <development/mavlink_msg_available_modes_monitor.hpp>
#include <development/mavlink_msg_current_mode.hpp>

#include "base/text/printable.hpp"
#include "mavlink/codec/messages.hpp"
#include "mavlink/wire/intake.hpp"
#include "mavlink/wire/wire.hpp"

/// What a table of fields is made of. A `Layout` says once how a message in SI units and its struct of the dialect
/// belong together, an entry a field; reading and writing both follow it. The tables are in fields_*.hpp:
///
///     template <class M = Wind, class W = dialect::WIND>
///     inline constexpr auto wind = layout<M, W>(std::tuple{
///         field<&M::from_rad, &W::direction>(limit::angle_rad, degree),
///         field<&M::speed_m_s, &W::speed>(limit::wind_speed_m_s),
///     });
///
/// M and W are parameters for their short names, and for messages that look alike. `target` is in no table: a message
/// that has one is read and written with it.
namespace lapwing::mavlink::internal {

/// The generated structs of all dialects that we read.
namespace dialect {
using namespace ::mavlink::minimal::msg;
using namespace ::mavlink::standard::msg;
using namespace ::mavlink::common::msg;
using namespace ::mavlink::ardupilotmega::msg;
using namespace ::mavlink::development::msg;
}  // namespace dialect

// ---- how one number of the wire becomes one in SI units

/// As the two types say: enumerations, numbers, texts, times; the greatest number of the wire is an optional's unknown.
struct Plain {
  template <class S, class T>
  static void read(S& si, T const& wire) {
    if constexpr (std::is_same_v<S, std::string>)
      si = text(wire);
    else if constexpr (std::is_same_v<S, bool>)
      si = wire > 0;
    else if constexpr (std::is_same_v<S, Duration> && std::is_same_v<T, std::uint32_t>)
      si = std::chrono::milliseconds(wire);  // since boot
    else if constexpr (requires { si.count(); })
      si = S(static_cast<std::int64_t>(wire));
    else if constexpr (requires { si.has_value(); })
      si = wire == std::numeric_limits<T>::max() ? S() : S(wire);
    else
      si = static_cast<S>(wire);
  }
  template <class S, class T>
  static void write(T& wire, S const& si) {
    if constexpr (std::is_same_v<S, std::string>)
      std::copy_n(si.data(), std::min(wire.size(), si.size()), wire.data());
    else if constexpr (std::is_same_v<S, Duration> && std::is_same_v<T, std::uint32_t>)
      wire = static_cast<T>(std::chrono::duration_cast<std::chrono::milliseconds>(si).count());
    else if constexpr (requires { si.count(); })
      wire = static_cast<T>(si.count());
    else if constexpr (requires { si.has_value(); })
      wire = si ? rounded<T>(*si) : std::numeric_limits<T>::max();
    else if constexpr (std::is_same_v<S, double> && std::integral<T>)
      wire = rounded<T>(si);
    else
      wire = static_cast<T>(si);
  }

  static void read(auto& si, auto const& wire, std::string_view, Intake&) { read(si, wire); }

 private:
  /// Texts end at the first NUL, or fill their field. What a terminal or a file would take for more than text is not
  /// let in. The standard keeps the names of cameras in bytes.
  static std::string text(auto const& field) {
    auto const* const begin = reinterpret_cast<char const*>(field.data());
    return base::printable({begin, strnlen(begin, field.size())});
  }
};

/// A measurement within `range`, in steps of `unit`. NaN is the unknown of floats.
template <class T>
struct Quantity {
  Range const& range;
  double unit;
  T unknown;

  void read(std::optional<double>& si, T wire, std::string_view name, Intake& in) const {
    if (std::floating_point<T> || wire != unknown) si = in(name, range, static_cast<double>(wire) * unit);
  }
  void write(T& wire, std::optional<double> si) const {
    if constexpr (std::floating_point<T>)
      wire = narrow(si, unit);
    else
      wire = rounded_or(unknown, si, unit);
  }
};

/// A direction within the full circle; the greatest number is the unknown.
struct Heading {
  Range const& range;
  double unit;

  template <class T>
  void read(std::optional<double>& si, T wire, std::string_view name, Intake& in) const {
    Quantity<T>{range, unit, std::numeric_limits<T>::max()}.read(si, wire, name, in);
  }
  template <class T>
  void write(T& wire, std::optional<double> si) const {
    wire = si ? heading<T>(*si, unit) : std::numeric_limits<T>::max();
  }
};

/// In mm. 0 is how those say it who do not know; the receivers' own word is the greatest number.
struct Accuracy {
  static void read(std::optional<double>& si, std::uint32_t wire, std::string_view name, Intake& in) {
    if (wire != 0 && wire != std::numeric_limits<std::uint32_t>::max()) si = in(name, limit::accuracy_m, wire * milli);
  }
  static void write(std::uint32_t& wire, std::optional<double> si) { wire = rounded_or<std::uint32_t>(0, si, milli); }
};
inline constexpr Accuracy accuracy;

/// A latitude or longitude that counts whatever it is.
struct DegreesE7 {
  static void read(double& si, std::int32_t wire, std::string_view, Intake&) { si = radians_e7(wire); }
  static void write(std::int32_t& wire, double si) { wire = degrees_e7(si); }
};
inline constexpr DegreesE7 in_degrees_e7;

/// Distances in whole centimetres, without what is unknown at the end of them; the greatest number is the unknown.
struct Centimetres {
  template <std::size_t size>
  static void read(std::vector<float>& si, std::array<std::uint16_t, size> const& wire, std::string_view, Intake&) {
    auto used = size;
    while (used > 0 && wire[used - 1] == unknown16) --used;
    si.resize(used);
    for (std::size_t i = 0; i < used; ++i)
      si[i] = wire[i] == unknown16 ? not_a_number : narrow(static_cast<double>(wire[i]) * centi);
  }
  template <std::size_t size>
  static void write(std::array<std::uint16_t, size>& wire, std::vector<float> const& si) {
    wire.fill(unknown16);
    for (std::size_t i = 0; i < std::min(size, si.size()); ++i)
      if (!std::isnan(si[i])) wire[i] = rounded<std::uint16_t>(double{si[i]} / centi);
  }
};
inline constexpr Centimetres in_centimetres;

/// Of the world's clock. Zero: the vehicle does not know.
struct Utc {
  static void read(std::optional<std::chrono::microseconds>& si, std::uint64_t wire, std::string_view name,
                   Intake& in) {
    si = in.utc(name, wire);
  }
  static void write(std::uint64_t& wire, std::optional<std::chrono::microseconds> si) {
    wire = si ? static_cast<std::uint64_t>(si->count()) : 0;
  }
};
inline constexpr Utc utc;

struct Rotation {
  using Quaternion = std::array<float, 4>;
  static void read(std::optional<Quaternion>& si, Quaternion const& wire, std::string_view name, Intake& in) {
    si = in.rotation(name, wire);
  }
  static void write(Quaternion& wire, std::optional<Quaternion> const& si) {
    wire = si.value_or(Quaternion{not_a_number, not_a_number, not_a_number, not_a_number});
  }
};
inline constexpr Rotation rotation;

// ---- entries: members of a message, and where they are on the wire

template <class Member>
struct MemberTraits;
template <class Owner, class T>
struct MemberTraits<T Owner::*> {
  using Type = T;
};
template <auto member>
using MemberType = MemberTraits<decltype(member)>::Type;

/// As the dialect spells it. The compiler knows, and nothing has to be said twice.
template <auto member>
consteval std::string_view name_of() {
  std::string_view const signature = __PRETTY_FUNCTION__;
  auto const begin = signature.find("member = ");
  auto const whole = signature.substr(begin, signature.find_first_of(";])", begin) - begin);
  return whole.substr(whole.rfind(':') + 1);
}

template <auto si, auto wire, class Conversion>
struct Field {
  static constexpr auto name = name_of<wire>();
  Conversion conversion;

  void read(auto& m, auto const& w, Intake& in) const { conversion.read(m.*si, w.*wire, name, in); }
  void write(auto const& m, auto& w) const { conversion.write(w.*wire, m.*si); }
};
template <auto si, auto wire, class Conversion = Plain>
constexpr Field<si, wire, Conversion> field(Conversion conversion = {}) {
  return {conversion};
}
template <auto si, auto wire, class T = MemberType<wire>>
constexpr Field<si, wire, Quantity<T>> field(Range const& range, double unit = 1.0,
                                             std::type_identity_t<T> unknown = std::numeric_limits<T>::max()) {
  return {{range, unit, unknown}};
}

/// An array of which every element has a field of its own, as parameters and channels have.
template <auto si, auto... wires>
struct List {
  static void read(auto& m, auto const& w, Intake&) {
    std::size_t i = 0;
    (Plain::read((m.*si)[i++], w.*wires), ...);
  }
  static void write(auto const& m, auto& w) {
    std::size_t i = 0;
    (Plain::write(w.*wires, (m.*si)[i++]), ...);
  }
};
template <auto si, auto... wires>
inline constexpr List<si, wires...> list;

/// A place from lat and lon in 1e-7 degrees and alt in mm, or in metres where it is a float. All three or none.
template <auto si, auto lat, auto lon, auto alt>
struct Place {
  static void read(auto& m, auto const& w, Intake& in) {
    m.*si = in.place({name_of<lat>(), name_of<lon>(), name_of<alt>()}, w.*lat, w.*lon, w.*alt);
  }
  static void write(auto const& m, auto& w) {
    auto const& place = m.*si;
    w.*lat = place ? degrees_e7(place->lat_rad) : unknown32;
    w.*lon = place ? degrees_e7(place->lon_rad) : unknown32;
    if constexpr (std::same_as<MemberType<alt>, float>)
      w.*alt = place ? narrow(place->alt_m) : not_a_number;
    else
      w.*alt = place ? rounded<std::int32_t>(place->alt_m / milli) : unknown32;
  }
};
template <auto si, auto lat, auto lon, auto alt>
inline constexpr Place<si, lat, lon, alt> place;

/// Three numbers that are one vector, known or unknown together.
template <auto si, auto... wires>
struct Vector {
  using Number = std::common_type_t<MemberType<wires>...>;
  static constexpr auto unknown = std::numeric_limits<Number>::max();
  Range const& range;
  double unit;

  void read(auto& m, auto const& w, Intake& in) const {
    if (std::integral<Number> && ((w.*wires == unknown) || ...)) return;
    m.*si = in.vector({name_of<wires>()...}, range, w.*wires * unit...);
  }
  void write(auto const& m, auto& w) const {
    auto const& vector = m.*si;
    auto const parts = vector ? std::array<std::optional<double>, 3>{vector->north, vector->east, vector->down}
                              : std::array<std::optional<double>, 3>{};
    std::size_t i = 0;
    (Quantity<Number>{range, unit, unknown}.write(w.*wires, parts[i++]), ...);
  }
};
template <auto si, auto north, auto east, auto down>
constexpr Vector<si, north, east, down> vector(Range const& range, double unit = 1.0) {
  return {range, unit};
}

/// A vector that counts whatever it is, as a setpoint's.
template <auto si, auto north, auto east, auto down>
struct WantedVector {
  static void read(auto& m, auto const& w, Intake&) { m.*si = {w.*north, w.*east, w.*down}; }
  static void write(auto const& m, auto& w) {
    w.*north = narrow((m.*si).north);
    w.*east = narrow((m.*si).east);
    w.*down = narrow((m.*si).down);
  }
};
template <auto si, auto north, auto east, auto down>
inline constexpr WantedVector<si, north, east, down> wanted_vector;

/// A struct within the message, by a layout of its own.
template <auto si, class Inner>
struct Part {
  Inner layout;
  void read(auto& m, auto const& w, Intake& in) const { layout.read(m.*si, w, in); }
  void write(auto const& m, auto& w) const { layout.write(m.*si, w); }
};
template <auto si, class Inner>
constexpr Part<si, Inner> part(Inner layout) {
  return {layout};
}

/// An entry that counts only while `member` is `value`; on the wire it is zero otherwise.
template <auto member, auto value, class Entry>
struct Only {
  Entry entry;
  void read(auto& m, auto const& w, Intake& in) const {
    if (m.*member == value) entry.read(m, w, in);
  }
  void write(auto const& m, auto& w) const {
    if (m.*member == value) entry.write(m, w);
  }
};
template <auto member, auto value, class Entry>
constexpr Only<member, value, Entry> only(Entry entry) {
  return {entry};
}

/// Floats of which we know nothing to say, and which nobody asks for.
template <auto... wires>
struct NotTold {
  static void read(auto&, auto const&, Intake&) {}
  static void write(auto const&, auto& w) { (fill(w.*wires), ...); }

 private:
  static void fill(float& wire) { wire = not_a_number; }
  template <std::size_t size>
  static void fill(std::array<float, size>& wire) {
    wire.fill(not_a_number);
  }
};
template <auto... wires>
inline constexpr NotTold<wires...> not_told;

/// What has a rule of its own: two functions, `read(m, w, in)` and `write(m, w)`.
template <class Read, class Write>
struct Both {
  Read read;
  Write write;
};
template <class Read, class Write>
Both(Read, Write) -> Both<Read, Write>;

// ---- layouts

template <class M, class W, class... Fields>
struct Layout {
  using Si = M;
  using Wire = W;
  std::tuple<Fields...> fields;

  void read(M& m, W const& w, Intake& in) const {
    if constexpr (targeted) m.target = {w.target_system, w.target_component};
    std::apply([&](auto const&... field) { (field.read(m, w, in), ...); }, fields);
  }
  void write(M const& m, W& w) const {
    if constexpr (targeted) {
      w.target_system = m.target.system;
      w.target_component = m.target.component;
    }
    std::apply([&](auto const&... field) { (field.write(m, w), ...); }, fields);
  }

 private:
  static constexpr bool targeted = requires(M m) { m.target; };
};

template <class M, class W, class... Fields>
constexpr Layout<M, W, Fields...> layout(std::tuple<Fields...> fields) {
  return {fields};
}

/// A group of messages.
template <auto const&... layouts>
struct Layouts {
  /// Calls `f.template operator()<layout>()` for each.
  static constexpr void each(auto&& f) { (f.template operator()<layouts>(), ...); }
};

}  // namespace lapwing::mavlink::internal
