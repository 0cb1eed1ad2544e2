#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "bus/messages/description.hpp"

/// Messages as they go over the wire: XCDR version 1 behind the four bytes that tell its byte order (DDS-RTPS 2.5,
/// section 10; DDS-XTypes 1.3, section 7.4), which ROS 2 speaks whatever its middleware.
namespace lapwing::bus {

namespace cdr {

/// Fast CDR's stream, with sequences that claim no more than can be there.
class Writer {
 public:
  Writer();
  Writer(Writer const&) = delete;
  Writer& operator=(Writer const&) = delete;
  ~Writer();
  template <class T>
  void numbers(T const* first, std::size_t count);
  void text(std::string const& value);
  [[nodiscard]] std::string bytes() const;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

/// Everything fails once anything has failed.
class Reader {
 public:
  explicit Reader(std::string_view bytes);
  Reader(Reader const&) = delete;
  Reader& operator=(Reader const&) = delete;
  ~Reader();
  template <class T>
  void numbers(T* first, std::size_t count);
  void text(std::string& value);
  /// How many elements follow, of which each takes `least_bytes` or more.
  [[nodiscard]] std::size_t length(std::size_t least_bytes);
  [[nodiscard]] bool is_good() const { return is_good_; }

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
  bool is_good_ = true;
};

template <class T>
concept Number = std::is_arithmetic_v<T>;
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t count>
struct IsArray<std::array<T, count>> : std::true_type {};

/// The least that a value takes, without what goes before it so that it lies evenly.
template <class T>
[[nodiscard]] constexpr std::size_t least_bytes() {
  if constexpr (Number<T>) {
    return sizeof(T);
  } else if constexpr (std::same_as<T, std::string> || IsVector<T>::value) {
    return sizeof(std::uint32_t);
  } else if constexpr (IsArray<T>::value) {
    return std::tuple_size_v<T> * least_bytes<typename T::value_type>();
  } else {
    return std::apply(
        [](auto const&... field) {
          return (least_bytes<std::remove_cvref_t<decltype(std::declval<T&>().*field.member)>>() + ...);
        },
        Description<T>::fields);
  }
}

template <class T>
void write(Writer& to, T const& value) {
  if constexpr (Number<T>) {
    to.numbers(&value, 1);
  } else if constexpr (std::same_as<T, std::string>) {
    to.text(value);
  } else if constexpr (IsVector<T>::value || IsArray<T>::value) {
    if constexpr (IsVector<T>::value) write(to, static_cast<std::uint32_t>(value.size()));
    if constexpr (Number<typename T::value_type>) {
      to.numbers(value.data(), value.size());
    } else {
      for (auto const& one : value) write(to, one);
    }
  } else {
    std::apply([&](auto const&... field) { (write(to, value.*field.member), ...); }, Description<T>::fields);
  }
}

template <class T>
void read(Reader& from, T& value) {
  if constexpr (Number<T>) {
    from.numbers(&value, 1);
  } else if constexpr (std::same_as<T, std::string>) {
    from.text(value);
  } else if constexpr (IsVector<T>::value || IsArray<T>::value) {
    using Element = T::value_type;
    if constexpr (IsVector<T>::value) value.resize(from.length(least_bytes<Element>()));
    if constexpr (Number<Element>) {
      from.numbers(value.data(), value.size());
    } else {
      for (auto& one : value) {
        if (!from.is_good()) return;
        read(from, one);
      }
    }
  } else {
    std::apply([&](auto const&... field) { (read(from, value.*field.member), ...); }, Description<T>::fields);
  }
}

}  // namespace cdr

template <Message M>
[[nodiscard]] std::string encode(M const& message) {
  cdr::Writer to;
  cdr::write(to, message);
  return to.bytes();
}

/// Error: invalid_input when it is too short for what it claims to hold. What is behind the message does not count:
/// newer versions of a type may have more.
template <Message M>
[[nodiscard]] base::Result<M> decode(std::string_view bytes) {
  cdr::Reader from(bytes);
  M message;
  cdr::read(from, message);
  if (!from.is_good())
    return base::fail(base::ErrorKind::invalid_input, std::string("not a whole ") + std::string(Description<M>::name));
  return message;
}

}  // namespace lapwing::bus
