#include "map/live/merge.hpp"

#include <algorithm>
#include <random>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "map/features/properties.hpp"
#include "map/testing/random_features.hpp"

namespace lapwing::map {
namespace {

using namespace std::chrono_literals;
using Heard = std::variant<Feature, Account>;  ///< the second: of a removal

constexpr auto noon = base::UtcTime(1'795'255'972s);

Known known_after(std::vector<Heard> const& heard) {
  Known known;
  for (auto const& one : heard) std::visit([&](auto const& account) { take(known, account); }, one);
  return known;
}

Account account(std::string writer, int seconds) {
  return {.writer = std::move(writer), .at = noon + std::chrono::seconds(seconds)};
}

Feature slot(Account told, std::string name, std::optional<int> seen_s = {}, SlotState state = SlotState::unknown) {
  Slot slot{.outline = {{{{0.0, 0.0}, {5.0, 0.0}, {5.0, 2.0}}}}, .state = state, .name = std::move(name)};
  if (seen_s) slot.seen_at = noon + std::chrono::seconds(*seen_s);
  return {.id = "s1", .site = "yard", .account = std::move(told), .content = slot};
}

Slot const& slot_of(Known const& known) {
  return std::get<Slot>(known.feature->content);
}

/// Accounts of one thing by a few writers at a few moments, many of them the same, and removals among them.
class Accounts {
 public:
  explicit Accounts(LayerKind layer) : layer_(layer) {}

  Heard next() {
    if (random_.number(6) == 0) return some_account();
    auto feature = random_.feature(layer_, "one", "yard");
    feature.account = some_account();
    if (auto* slot = std::get_if<Slot>(&feature.content); slot && slot->seen_at)
      slot->seen_at = feature.account.at - std::chrono::seconds(random_.number(3));
    if (auto* picture = std::get_if<Picture>(&feature.content)) picture->image = std::string(64, 'a');
    if (auto* track = std::get_if<Track>(&feature.content)) take_samples_before(*track, feature.account.at);
    EXPECT_EQ(feature_fault(feature), std::nullopt);
    return feature;
  }

 private:
  Account some_account() { return account(fmt::format("writer {}", random_.number(3)), random_.number(5)); }
  /// All within the second before it, so that a removal takes all or none of them.
  void take_samples_before(Track& track, base::UtcTime at) {
    track.thinning = 0;
    track.samples.resize(2);
    track.samples.front().at = at - std::chrono::milliseconds(500 + random_.number(4));
    track.samples.back().at = at - std::chrono::milliseconds(random_.number(4));
  }

  LayerKind layer_;
  testing::RandomFeatures random_{static_cast<std::uint64_t>(layer_) + 20};
};

class MergeRule : public ::testing::TestWithParam<LayerKind> {};

INSTANTIATE_TEST_SUITE_P(OfEachLayer, MergeRule, ::testing::ValuesIn(all_layers),
                         [](auto const& layer) { return std::string(name_of(layer.param)); });

TEST_P(MergeRule, DoesNotDependOnTheOrder) {
  Accounts accounts(GetParam());
  std::mt19937_64 order(30);
  for (int i = 0; i < 400; ++i) {
    std::vector<Heard> heard;
    for (int k = 0; k < 2 + i % 5; ++k) heard.push_back(accounts.next());
    auto const expected = known_after(heard);
    if (expected.feature) {
      EXPECT_EQ(feature_fault(*expected.feature), std::nullopt);
    }
    for (int k = 0; k < 12; ++k) {
      std::ranges::shuffle(heard, order);
      auto again = heard;
      again.push_back(heard[static_cast<std::size_t>(k) % heard.size()]);  // and what comes twice changes nothing
      ASSERT_EQ(known_after(again), expected) << "case " << i;
    }
  }
}

/// What was merged elsewhere, as it comes from a store or another station, is an account, too.
TEST_P(MergeRule, JoinsWhatWasMergedElsewhere) {
  Accounts accounts(GetParam());
  for (int i = 0; i < 200; ++i) {
    std::vector<Heard> heard;
    while (heard.size() < 6)
      if (auto one = accounts.next(); std::holds_alternative<Feature>(one)) heard.push_back(std::move(one));
    auto const here = known_after({heard.begin(), heard.begin() + 3});
    auto const there = known_after({heard.begin() + 3, heard.end()});
    ASSERT_EQ(known_after({*here.feature, *there.feature}), known_after(heard)) << "case " << i;
  }
}

TEST(Merge, TakesTheNewerAccountWhole) {
  Feature early{.id = "w",
                .site = "yard",
                .account = account("a", 1),
                .content = Wall{.line = {{{}, {1.0, 0.0}}}, .height_m = 3.0}};
  Feature late = early;
  late.account = account("a", 2);
  late.content = Wall{.line = {{{}, {2.0, 0.0}}}};
  EXPECT_EQ(known_after({early, late}).feature, late);
  Known known{.feature = late};
  EXPECT_FALSE(take(known, early));
  EXPECT_FALSE(take(known, late));
}

TEST(Merge, TakesTheGreaterWriterAtOneTime) {
  EXPECT_EQ(known_after({slot(account("b", 1), "of b"), slot(account("a", 1), "of a")}).feature->account.writer, "b");
}

TEST(Merge, KeepsANameThatALaterLookCouldNotRead) {
  auto known = known_after({slot(account("a", 1), "12"), slot(account("b", 5), "")});
  EXPECT_EQ(slot_of(known).name, "12");
  EXPECT_EQ(known.feature->account, account("b", 5));
  EXPECT_EQ(known.feature->held_over, (std::vector<HeldOver>{{"name", account("a", 1)}}));
  EXPECT_TRUE(take(known, slot(account("c", 3), "13"))) << "older than the slot, and newer than its name";
  EXPECT_EQ(slot_of(known).name, "13");
  EXPECT_TRUE(take(known, slot(account("a", 6), "14")));
  EXPECT_TRUE(known.feature->held_over.empty());
}

TEST(Merge, TakesTheLastLookAtASlotWhole) {
  auto known =
      known_after({slot(account("a", 5), "", 5, SlotState::taken), slot(account("a", 9), "", 3, SlotState::free)});
  EXPECT_EQ(slot_of(known).state, SlotState::taken) << "the later account tells of an earlier look";
  EXPECT_TRUE(take(known, slot(account("operator", 20), "12")));
  EXPECT_EQ(slot_of(known).state, SlotState::taken) << "who has not looked knows nothing of the state";
  EXPECT_TRUE(take(known, slot(account("operator", 21), "", {}, SlotState::free)));
  EXPECT_EQ(slot_of(known).state, SlotState::free);
  EXPECT_EQ(slot_of(known).seen_at, noon + 21s) << "a state without a time is one of the account's time";
}

TEST(Merge, DoesNotBringBackWhatWasRemovedLater) {
  auto known = known_after({slot(account("a", 1), "12"), account("operator", 5)});
  EXPECT_EQ(known.feature, std::nullopt);
  EXPECT_FALSE(take(known, slot(account("a", 4), "12")));
  EXPECT_TRUE(take(known, slot(account("a", 6), "")));
  EXPECT_EQ(slot_of(known).name, "") << "what was known before is gone";
}

TEST(Merge, TakesAwayWhatIsOlderThanARemovalThatComesLate) {
  auto known = known_after({slot(account("a", 1), "12", 1, SlotState::taken), slot(account("a", 6), "")});
  EXPECT_EQ(slot_of(known).name, "12");
  EXPECT_TRUE(take(known, account("operator", 5)));
  EXPECT_EQ(slot_of(known).name, "");
  EXPECT_EQ(slot_of(known).state, SlotState::unknown);
  EXPECT_FALSE(take(known, account("operator", 4)));
}

TEST(Merge, KnowsThatAPictureDoesNotChange) {
  Feature const one{
      .id = "p", .site = "yard", .account = account("a", 1), .content = Picture{.image = std::string(64, 'a')}};
  auto other = one;
  std::get<Picture>(other.content).image = std::string(64, 'b');
  EXPECT_EQ(conflict(one, one), std::nullopt);
  EXPECT_EQ(conflict(one, other),
            "another image is known by this id: a picture does not change; give the new one an id of its own");
}

Feature track(Account told, int from_ms, int count, int step_ms) {
  Track track;
  for (int i = 0; i < count; ++i)
    track.samples.push_back(
        {.position = {0.1 * i, 0.0}, .at = noon + std::chrono::milliseconds(from_ms + i * step_ms)});
  return {.id = "t", .site = "yard", .account = std::move(told), .content = track};
}

TEST(Merge, JoinsTheSamplesOfTracks) {
  auto const known = known_after({track(account("a", 10), 0, 5, 1000), track(account("a", 4), 2500, 3, 500)});
  auto const& samples = std::get<Track>(known.feature->content).samples;
  EXPECT_EQ(samples.size(), 7U) << "at 0, 1, 2, 2.5, 3, 3.5 and 4 s";
}

TEST(Merge, KnowsThatATrackStaysInItsSite) {
  auto const here = track(account("a", 10), 0, 5, 1000);
  auto there = here;
  there.site = "office";
  EXPECT_EQ(conflict(here, there),
            "the track lies in the site yard: a track stays in its site; give the new one an id of its own");
}

TEST(Merge, ThinsLongTracksAlikeInAnyOrder) {
  std::mt19937_64 order(31);
  std::vector<Heard> pieces;
  for (int i = 0; i < 12; ++i) pieces.push_back(track(account("a", 1000 + i), 90'000 * i + 7 * i, 1000 + 50 * i, 83));
  auto const expected = known_after(pieces);
  auto const& joined = std::get<Track>(expected.feature->content);
  EXPECT_LE(joined.samples.size(), most_track_samples);
  EXPECT_GT(joined.samples.size(), most_track_samples / 2 - 1);
  EXPECT_GT(joined.thinning, 0);
  EXPECT_EQ(joined.samples.front().at, noon) << "the first stays";
  EXPECT_EQ(joined.samples.back().at, std::get<Track>(std::get<Feature>(pieces.back()).content).samples.back().at);
  for (int i = 0; i < 20; ++i) {
    std::ranges::shuffle(pieces, order);
    ASSERT_EQ(known_after(pieces), expected);
  }
}

}  // namespace
}  // namespace lapwing::map
