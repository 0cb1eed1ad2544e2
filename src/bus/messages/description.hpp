#pragma once

#include <string_view>
#include <tuple>

/// How messages of ROS 2 are written down here: one table a message, from which the wire format, the type's name and
/// the reference page follow. Units are SI and radians, as REP 103 has them.
namespace lapwing::bus {

/// A member of a message under its name in ROS.
template <class Owner, class Value>
struct Field {
  std::string_view name;
  Value Owner::* member;
};
template <class Owner, class Value>
Field(char const*, Value Owner::*) -> Field<Owner, Value>;

/// Specialised for each message: `name`, "std_msgs/msg/Header", and `fields`, in the order of its definition.
template <class M>
struct Description;

template <class M>
concept Message = requires {
  Description<M>::name;
  Description<M>::fields;
};

}  // namespace lapwing::bus
