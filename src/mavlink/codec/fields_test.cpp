// Every message by its table of fields: filled at random within range, written, read again. A new message needs nothing
// here; an entry of a new type needs its values and their resolution.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "mavlink/codec/internal/fields_command.hpp"
#include "mavlink/codec/internal/fields_mission.hpp"
#include "mavlink/codec/internal/fields_motion.hpp"
#include "mavlink/codec/internal/fields_payload.hpp"
#include "mavlink/codec/internal/fields_state.hpp"

namespace lapwing::mavlink::internal {
namespace {

/// Values that the wire can hold and the limits let in; one of four optional ones is unknown.
class Filler {
 public:
  template <auto si, auto wire, class Conversion>
  void operator()(Field<si, wire, Conversion> const& entry, auto& m) {
    any(m.*si, entry.conversion, MemberType<wire>{});
  }
  template <auto si, auto... wires>
  void operator()(List<si, wires...> const&, auto& m) {
    for (auto& element : m.*si)
      any(element, Plain{}, typename MemberTraits<std::common_type_t<decltype(wires)...>>::Type{});
  }
  template <auto si, auto... wires>
  void operator()(Place<si, wires...> const&, auto& m) {
    if (known()) m.*si = geo::Wgs84{real(-1.57, 1.57), real(-3.14, 3.14), real(-12'000, 60'000)};
  }
  template <auto si, auto... wires>
  void operator()(Vector<si, wires...> const& entry, auto& m) {
    auto const part = entry.range.highest / 2;
    if (known()) m.*si = geo::Ned{real(-part, part), real(-part, part), real(-part, part)};
  }
  template <auto si, auto... wires>
  void operator()(WantedVector<si, wires...> const&, auto& m) {
    m.*si = {real(-1e3, 1e3), real(-1e3, 1e3), real(-1e3, 1e3)};
  }
  template <auto si, class Inner>
  void operator()(Part<si, Inner> const& entry, auto& m) {
    std::apply([&](auto const&... inner) { ((*this)(inner, m.*si), ...); }, entry.layout.fields);
  }
  template <auto member, auto value, class Entry>
  void operator()(Only<member, value, Entry> const& entry, auto& m) {
    if (known()) m.*member = value;
    if (m.*member == value) (*this)(entry.entry, m);
  }
  template <auto... wires>
  void operator()(NotTold<wires...> const&, auto&) {}
  template <class Read, class Write>
  void operator()(Both<Read, Write> const& entry, auto& m) {
    if constexpr (requires { m.voltage_v; })
      m.voltage_v = known() ? std::optional(real(0, 400)) : std::nullopt;
    else if constexpr (std::is_same_v<decltype(entry), decltype(item_place) const&>)
      place(m);
  }

 private:
  [[nodiscard]] bool known() { return random_() % 4 != 0; }
  [[nodiscard]] double real(double lowest, double highest) {
    return std::uniform_real_distribution<double>(lowest, highest)(random_);
  }
  template <class T>
  [[nodiscard]] T whole(T lowest, T highest) {
    return static_cast<T>(std::uniform_int_distribution<std::int64_t>(lowest, highest)(random_));
  }

  template <class S, class T>
  void any(S& si, Plain, T wire) {
    if constexpr (std::is_same_v<S, std::string>)
      for (auto length = random_() % (wire.size() + 1); length-- > 0;) si += static_cast<char>('a' + random_() % 26);
    else if constexpr (std::is_enum_v<S>)
      si = static_cast<S>(random_() % (known() ? 12 : 256));
    else if constexpr (std::is_same_v<S, Duration> && sizeof(T) == 4)
      si = std::chrono::milliseconds(static_cast<std::uint32_t>(random_()));
    else if constexpr (requires { si.count(); })
      si = S(static_cast<std::int64_t>(random_()));
    else if constexpr (requires { si.has_value(); })
      si = known() ? S(whole<T>(0, std::numeric_limits<T>::max() - 1)) : S();
    else if constexpr (requires { si.size(); })
      for (auto& element : si) element = static_cast<std::uint8_t>(random_());
    else if constexpr (std::floating_point<T>)
      si = static_cast<T>(real(-1e6, 1e6));
    else if constexpr (std::floating_point<S>)
      si = real(0, std::numeric_limits<T>::max());
    else
      si = static_cast<S>(random_());
  }
  template <class T>
  void any(std::optional<double>& si, Quantity<T> const& how, T) {
    auto lowest = how.range.lowest;
    auto highest = how.range.highest;
    if constexpr (std::integral<T>) {
      lowest = std::max(lowest, std::numeric_limits<T>::lowest() * how.unit);
      highest = std::min(highest, (std::numeric_limits<T>::max() - 1.0) * how.unit);
    }
    if (known()) si = real(lowest, highest);
    if constexpr (std::integral<T>)
      if (si && rounded<T>(*si / how.unit) == how.unknown) si.reset();
  }
  void any(std::optional<double>& si, Heading const&, auto) {
    if (known()) si = real(0, 2 * std::numbers::pi - 0.02);
  }
  void any(std::optional<double>& si, Accuracy, auto) {
    if (known()) si = real(0.001, 1e6);
  }
  void any(double& si, DegreesE7, auto) { si = real(-std::numbers::pi, std::numbers::pi); }
  template <class Wire>
  void any(std::vector<float>& si, Centimetres, Wire const& wire) {
    for (std::size_t i = 0; i < wire.size(); ++i)
      si.push_back(known() || i + 1 == wire.size() ? static_cast<float>(real(0, 600)) : not_a_number);
  }
  void any(std::optional<std::chrono::microseconds>& si, Utc, auto) {
    if (known()) si = std::chrono::microseconds(whole<std::int64_t>(946'684'800'000'000, 4'200'000'000'000'000));
  }
  void any(std::optional<Rotation::Quaternion>& si, Rotation, auto) {
    auto const half = real(0, std::numbers::pi);
    if (known()) si = {narrow(std::cos(half)), 0.0F, narrow(std::sin(half)), 0.0F};
  }
  void any(SecondsLeft::Seconds& si, SecondsLeft, auto) {
    if (known()) si = std::chrono::seconds(whole(1, 7 * 86'400));
  }
  void any(bool& si, CaptureResult, auto) { si = known(); }
  void any(IntervalUs::Interval& si, IntervalUs, auto) {
    if (known()) si = std::chrono::microseconds(whole(1, std::numeric_limits<std::int32_t>::max()));
  }
  void any(ItemTotal::Total& si, ItemTotal, auto) {
    if (known()) si = whole<std::uint16_t>(0, unknown16 - 1);
  }

  void place(auto& m) {
    m.frame = known() ? MavFrame::global_relative_alt_int : MavFrame::local_ned;
    m.command = known() ? MavCmd::nav_waypoint : MavCmd::do_change_speed;
    m.place.z_m = real(-100, 100);
    bool const global = has_place(m.command) && is_global(m.frame);
    (global ? m.place.lat_rad : m.place.x) = global ? real(-1.57, 1.57) : std::floor(real(-1000, 1000));
    (global ? m.place.lon_rad : m.place.y) = global ? real(-3.14, 3.14) : std::floor(real(-1000, 1000));
  }

  std::mt19937_64 random_{12};
};

/// How far what comes back may be from what went: half a step of an integer, the digits of a float.
struct Resolution {
  double step = 0.0;
  double relative = 0.0;
};
template <class T>
Resolution constexpr resolution_of(double unit = 1.0) {
  return std::floating_point<T> ? Resolution{0.0, 1e-6} : Resolution{0.5 * unit + 1e-9, 1e-12};
}
Resolution constexpr degrees{0.5e-7 * degree + 1e-12, 0.0};

template <class S>
void expect_close(S const& sent, S const& got, Resolution const& within) {
  if constexpr (requires { sent.has_value(); }) {
    ASSERT_EQ(sent.has_value(), got.has_value());
    if (sent) expect_close(*sent, *got, within);
  } else if constexpr (std::is_same_v<S, geo::Wgs84>) {
    EXPECT_NEAR(sent.lat_rad, got.lat_rad, degrees.step);
    EXPECT_NEAR(sent.lon_rad, got.lon_rad, degrees.step);
    expect_close(sent.alt_m, got.alt_m, within);
  } else if constexpr (std::is_same_v<S, geo::Ned>) {
    expect_close(sent.north, got.north, within);
    expect_close(sent.east, got.east, within);
    expect_close(sent.down, got.down, within);
  } else if constexpr (std::is_same_v<S, std::vector<float>>) {
    ASSERT_EQ(sent.size(), got.size());
    for (std::size_t i = 0; i < sent.size(); ++i)
      if (std::isnan(sent[i]))
        EXPECT_TRUE(std::isnan(got[i]));
      else
        EXPECT_NEAR(sent[i], got[i], 0.5 * centi + 1e-4);
  } else if constexpr (std::is_same_v<S, double>) {
    EXPECT_NEAR(sent, got, within.step + within.relative * std::abs(sent));
  } else {
    EXPECT_EQ(sent, got);
  }
}

template <auto si, auto wire, class Conversion>
void compare(Field<si, wire, Conversion> const& entry, auto const& sent, auto const& got) {
  SCOPED_TRACE(entry.name);
  if constexpr (std::is_same_v<Conversion, Accuracy>)
    expect_close(sent.*si, got.*si, resolution_of<std::uint32_t>(milli));
  else if constexpr (std::is_same_v<Conversion, DegreesE7>)
    expect_close(sent.*si, got.*si, degrees);
  else if constexpr (requires { entry.conversion.unit; })
    expect_close(sent.*si, got.*si, resolution_of<MemberType<wire>>(entry.conversion.unit));
  else
    expect_close(sent.*si, got.*si, resolution_of<MemberType<wire>>());
}
template <auto si, auto... wires>
void compare(List<si, wires...> const&, auto const& sent, auto const& got) {
  EXPECT_EQ(sent.*si, got.*si);
}
template <auto si, auto lat, auto lon, auto alt>
void compare(Place<si, lat, lon, alt> const&, auto const& sent, auto const& got) {
  expect_close(sent.*si, got.*si, resolution_of<MemberType<alt>>(milli));
}
template <auto si, auto... wires>
void compare(Vector<si, wires...> const& entry, auto const& sent, auto const& got) {
  expect_close(sent.*si, got.*si, resolution_of<typename Vector<si, wires...>::Number>(entry.unit));
}
template <auto si, auto... wires>
void compare(WantedVector<si, wires...> const&, auto const& sent, auto const& got) {
  expect_close(sent.*si, got.*si, resolution_of<float>());
}
template <auto si, class Inner>
void compare(Part<si, Inner> const& entry, auto const& sent, auto const& got) {
  std::apply([&](auto const&... inner) { (compare(inner, sent.*si, got.*si), ...); }, entry.layout.fields);
}
template <auto member, auto value, class Entry>
void compare(Only<member, value, Entry> const& entry, auto const& sent, auto const& got) {
  compare(entry.entry, sent, got);
}
template <auto... wires>
void compare(NotTold<wires...> const&, auto const&, auto const&) {}
template <class Read, class Write>
void compare(Both<Read, Write> const& entry, auto const& sent, auto const& got) {
  if constexpr (requires { sent.voltage_v; }) {
    expect_close(sent.voltage_v, got.voltage_v, resolution_of<std::uint16_t>(milli));
  } else if constexpr (std::is_same_v<decltype(entry), decltype(item_place) const&>) {
    bool floating = false;
    if constexpr (requires { sent.form; }) floating = sent.form == ItemForm::floating;
    auto const angle = floating ? resolution_of<float>() : degrees;
    expect_close(sent.place.lat_rad, got.place.lat_rad, angle);
    expect_close(sent.place.lon_rad, got.place.lon_rad, angle);
    expect_close(sent.place.x, got.place.x, resolution_of<float>());
    expect_close(sent.place.y, got.place.y, resolution_of<float>());
    expect_close(sent.place.z_m, got.place.z_m, resolution_of<float>());
  }
}

/// Calls `check(layout, a message of its kind)` for each layout.
void for_each_layout(auto check) {
  auto const each = [&]<auto const & layout>() {
    typename std::remove_cvref_t<decltype(layout)>::Si m;
    if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(layout)>::Wire, dialect::MISSION_ITEM>)
      m.form = ItemForm::floating;
    check(layout, m);
  };
  StateLayouts::each(each);
  MotionLayouts::each(each);
  PayloadLayouts::each(each);
  CommandLayouts::each(each);
  MissionLayouts::each(each);
}

template <class M>
void expect_carried(auto const& layout, M const& sent) {
  using Wire = std::remove_cvref_t<decltype(layout)>::Wire;
  SCOPED_TRACE(Wire::NAME);
  auto const frame = encode(sent, {1, 1}, 0);
  EXPECT_EQ(frame.message_id, Wire::MSG_ID);
  std::vector<ImpossibleField> impossible;
  auto const decoded = decode(frame, impossible);
  for (auto const& field : impossible) ADD_FAILURE() << field.name << " = " << field.value << " was left out";
  auto const& got = std::get<M>(decoded.value());
  EXPECT_EQ(target_of(Message(sent)), target_of(*decoded));
  std::apply([&](auto const&... entries) { (compare(entries, sent, got), ...); }, layout.fields);
}

TEST(Fields, SurviveTheWireForEveryMessageWithinItsResolution) {
  Filler fill;
  for_each_layout([&](auto const& layout, auto const& blank) {
    for (int i = 0; i < 200 && !::testing::Test::HasFailure(); ++i) {
      auto m = blank;
      if constexpr (requires { m.target; }) m.target = {static_cast<std::uint8_t>(i), 7};
      std::apply([&](auto const&... entries) { (fill(entries, m), ...); }, layout.fields);
      if constexpr (requires { m.mavlink_version; }) m.mavlink_version = 3;  // the dialect writes its own
      expect_carried(layout, m);
    }
  });
}

TEST(Fields, SurviveTheWireWhenNothingIsKnown) {
  for_each_layout([](auto const& layout, auto m) {
    if constexpr (requires { m.progress; }) m.result = MavResult::in_progress;
    expect_carried(layout, m);
  });
}

TEST(Fields, HaveTheNamesOfTheDialect) {
  EXPECT_EQ(name_of<&dialect::ATTITUDE::rollspeed>(), "rollspeed");
  EXPECT_EQ(name_of<&WithOpaqueId<dialect::MISSION_ACK>::opaque_id>(), "opaque_id");
}

}  // namespace
}  // namespace lapwing::mavlink::internal
