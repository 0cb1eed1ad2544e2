#include "mavlink/signing/key_store.hpp"

#include <gtest/gtest.h>

namespace lapwing::mavlink {
namespace {

std::string const digits(64, 'a');

std::string complaint(std::string const& text) {
  auto const ring = parse_key_store("fleet.keys", text);
  EXPECT_FALSE(ring) << text;
  return ring ? "" : ring.error().message;
}

TEST(KeyStore, ReadsWhatPeopleWrite) {
  auto const ring =
      parse_key_store("fleet.keys", "[keys]\nfleet = '" + digits + "'\nnew-one = '" + std::string(64, '0') +
                                        "'\n[use]\neverybody = 'fleet'\n[use.vehicles]\n7 = ['new-one', "
                                        "'fleet']\n'north/7' = 'fleet'\n[use.links]\n'udpin://0.0.0.0:14550' = "
                                        "'new-one'\n[unsigned]\nlocal-links = true\nsystems = [51]\nmessages "
                                        "= ['ADSB_VEHICLE', 0]\n");
  ASSERT_TRUE(ring) << ring.error().message;
  EXPECT_EQ(ring->keys.at("fleet")[31], 0xAA);
  EXPECT_EQ(ring->everybody, KeyRing::Use{"fleet"});
  EXPECT_EQ(ring->vehicles.at(7), (KeyRing::Use{"new-one", "fleet"}));
  EXPECT_EQ(ring->networks.at("north").at(7), KeyRing::Use{"fleet"});
  EXPECT_EQ(ring->links.at("udpin://0.0.0.0:14550"), KeyRing::Use{"new-one"});
  EXPECT_TRUE(ring->unsigned_frames.local_links);
  EXPECT_EQ(ring->unsigned_frames.systems, std::set<std::uint8_t>{51});
  EXPECT_EQ(ring->unsigned_frames.messages, (std::set<std::uint32_t>{0, 246}));
  EXPECT_EQ(parse_key_store("again", to_text(*ring)).value(), *ring);
}

TEST(KeyStore, SaysWhereItIsWrong) {
  auto const keys = "[keys]\na = '" + digits + "'\n";
  EXPECT_EQ(complaint("[keys]\na = 'abc'\n"), "fleet.keys:2:5: a key is a text of 64 hexadecimal digits");
  EXPECT_EQ(complaint("[keys]\n'a b' = '" + digits + "'\n"),
            "fleet.keys:2:1: a key's name has 1 to 40 letters, digits, - and _");
  EXPECT_EQ(complaint(keys + "[use]\neverybody = 'b'\n"), "fleet.keys:4:13: expected the name of a key of [keys]");
  EXPECT_EQ(complaint(keys + "[use]\neverybody = []\n"), "fleet.keys:4:13: expected at least one key's name");
  EXPECT_EQ(complaint(keys + "[use.vehicles]\n256 = 'a'\n"),
            "fleet.keys:4:1: a vehicle is named by its system id, 1 to 255, or network/id");
  EXPECT_EQ(complaint(keys + "[unsigned]\nlinks = true\n"),
            "fleet.keys:4:1: expected local-links, systems or messages");
  EXPECT_EQ(complaint(keys + "[unsigned]\nmessages = ['HEARTBEET']\n"),
            "fleet.keys:4:13: expected a message's name, such as ADSB_VEHICLE, or number");
  EXPECT_EQ(complaint("# \xEF\xBB\xB7\n"), "fleet.keys:1:3: only ASCII characters belong here");
  EXPECT_EQ(complaint("[key]\n"), "fleet.keys:1:2: expected keys, use or unsigned");
}

TEST(KeyStore, TellsNoSecretWhenItIsWrong) {
  std::string const secret(63, 'b');
  for (auto const& text : {"[keys]\na = '" + secret + "'\n", "[keys]\na = " + secret + "\n", "[keys]\na = '" + secret,
                           "[keys]\n" + secret + " = 1\n", "[use]\neverybody = '" + secret + "'\n"})
    EXPECT_EQ(complaint(text).find("bbb"), std::string::npos) << text;
}

TEST(KeyStore, TakesOnly64HexadecimalDigitsForAKey) {
  EXPECT_TRUE(parse_key(digits));
  EXPECT_FALSE(parse_key(digits.substr(1)));
  EXPECT_FALSE(parse_key(digits + "a"));
  EXPECT_FALSE(parse_key(std::string(63, 'a') + "g"));
}

}  // namespace
}  // namespace lapwing::mavlink
