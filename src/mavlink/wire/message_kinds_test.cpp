#include "mavlink/wire/message_kinds.hpp"

#include <gtest/gtest.h>

#include "mavlink/wire/dialect_names.hpp"

namespace lapwing::mavlink {
namespace {

TEST(MessageKinds, HaveTheNamesThatTheDialectGivesThem) {
  int known = 0;
  for (auto const& row : message_kinds()) {
    auto const name = message_name(row.id);
    if (name.empty()) continue;  // newer than the dialect that is built in
    EXPECT_EQ(name, row.name) << row.id;
    ++known;
  }
  EXPECT_GT(known, 90);
}

TEST(MessageKinds, DoNotContradictEachOther) {
  for (auto const& row : message_kinds()) {
    EXPECT_NE(row.kinds, 0) << row.name;
    EXPECT_FALSE(is(row.id, Kind::bulk) && is(row.id, Kind::single)) << row.name;
    EXPECT_FALSE(is(row.id, Kind::state) && is(row.id, Kind::event)) << row.name;
    EXPECT_FALSE(is(row.id, Kind::order) && is(row.id, Kind::perishable)) << row.name << " would be thrown away";
    if (is(row.id, Kind::setpoint)) {
      EXPECT_TRUE(is(row.id, Kind::perishable) && is(row.id, Kind::replaced))
          << row.name << ": the next one says it anew";
    }
  }
}

TEST(MessageKinds, AreNoneForWhatIsNotInTheTable) {
  for (auto const kind : {Kind::bulk, Kind::state, Kind::order}) EXPECT_FALSE(is(16'000'000, kind));
  EXPECT_EQ(traffic_of(16'000'000), Traffic::command);
}

}  // namespace
}  // namespace lapwing::mavlink
