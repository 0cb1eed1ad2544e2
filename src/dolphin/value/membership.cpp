#include "dolphin/value/membership.hpp"

#include "dolphin/value/equality.hpp"

namespace lapwing::dolphin::internal {

namespace {

/// Values of these kinds are equal exactly when they are the same key. Decimals are not: they are equal within a
/// tolerance.
bool is_plain(Value const& value) {
  return value.is(ValueKind::integer) || value.is(ValueKind::text) || value.is(ValueKind::boolean) ||
         value.is(ValueKind::vehicle);
}

}  // namespace

void Membership::add(Value const& item) {
  all_.push_back(item);
  if (is_plain(item)) {
    plain_.insert(item);
  } else {
    others_.push_back(item);
  }
}

bool Membership::holds(Value const& wanted) {
  if (error_) return false;
  if (is_plain(wanted) && plain_.contains(wanted)) return true;
  auto const found = find(is_plain(wanted) ? others_ : all_, wanted, compared_);
  if (!found) error_ = found.error();
  return found && found->has_value();
}

}  // namespace lapwing::dolphin::internal
