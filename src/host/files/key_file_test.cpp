#include "host/files/key_file.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"
#include "link/pipe_link.hpp"
#include "mavlink/signing/key_store.hpp"

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;
using base::testing::TemporaryFolder;

mavlink::KeyRing ring_in(std::string const& path) {
  return read_signing(path).value().ring.value();
}

TEST(SigningKeyFile, HoldsTheKeyInHexadecimalDigits) {
  TemporaryFolder const folder;
  auto const ring = ring_in(folder.write("k", "00ff" + std::string(58, '1') + "aB\n"));
  auto const key = mavlink::key_for(ring, 1).value();
  EXPECT_EQ(key[0], 0x00);
  EXPECT_EQ(key[1], 0xFF);
  EXPECT_EQ(key[2], 0x11);
  EXPECT_EQ(key[31], 0xAB);
}

TEST(SigningKeyFile, IsNotNeeded) {
  EXPECT_FALSE(read_signing("").value().ring);
}

TEST(SigningKeyFile, HoldsAPassPhrase) {
  TemporaryFolder const folder;
  EXPECT_EQ(ring_in(folder.write("k", "correct horse battery\n")),
            mavlink::ring_of(mavlink::key_from_passphrase("correct horse battery")));
  // 63 digits are no key, so they are words.
  EXPECT_EQ(ring_in(folder.write("k", std::string(63, 'a'))),
            mavlink::ring_of(mavlink::key_from_passphrase(std::string(63, 'a'))));
}

TEST(SigningKeyFile, RefusesWhatCanBeGuessedAndDoesNotRepeatIt) {
  TemporaryFolder const folder;
  for (std::string const& text : {std::string(), std::string("short one")}) {
    auto const read = read_signing(folder.write("k", text));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, base::ErrorKind::invalid_input);
    EXPECT_EQ(read.error().message.find("short one"), std::string::npos);
  }
}

TEST(SigningKeyFile, MustNotBeReadableByOthers) {
  TemporaryFolder const folder;
  auto const path = folder.write("k", std::string(64, 'a'));
  std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::group_read);
  auto const read = read_signing(path);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().hint, "chmod 600 " + path);
  EXPECT_FALSE(read_key_store(path));
}

TEST(SigningKeyFile, SaysHowToMakeOneThatIsMissing) {
  TemporaryFolder const folder;
  auto const read = read_signing((folder.path() / "absent").string());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, base::ErrorKind::not_found);
  EXPECT_NE(read.error().hint.find("lapwing signing new"), std::string::npos);
}

TEST(KeyStoreFile, IsReadBackAndNobodyElses) {
  TemporaryFolder const folder;
  auto const path = (folder.path() / "fleet.keys").string();
  auto ring = mavlink::ring_of(random_key().value());
  ring.vehicles[7] = {"key"};
  ASSERT_TRUE(write_key_store(path, ring));
  EXPECT_EQ(std::filesystem::status(path).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_EQ(read_key_store(path).value(), ring);
  EXPECT_EQ(ring_in(path), ring) << "for --signing-key";
  EXPECT_NE(random_key().value(), random_key().value());
}

TEST(KeyStoreFile, IsNoSingleKey) {
  TemporaryFolder const folder;
  auto const read = read_key_store(folder.write("k", std::string(64, 'a')));
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().hint.find("--import"), std::string::npos);
}

TEST(KeyStoreFile, SaysThatItCannotBeWritten) {
  TemporaryFolder const folder;
  auto const written = write_key_store((folder.path() / "absent/fleet.keys").string(), {});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, base::ErrorKind::io);
}

base::Task<> pass(base::Loop& loop, base::Duration time) {
  co_await loop.sleep(time);
}

std::unique_ptr<SigningTimeKeeper> keeper_of(mavlink::Connection& connection, std::string const& file) {
  return std::make_unique<SigningTimeKeeper>(
      connection.loop(), [&connection] { return connection.signing()->signed_until(); }, file, base::Logger());
}

TEST(SigningTime, GoesOnInTheNextLifeHoweverTheLastOneEnded) {
  TemporaryFolder const folder;
  auto const path = folder.write("k", std::string(64, 'a'));
  base::UtcTime const now = std::chrono::sys_days{std::chrono::year{2026} / 11 / 21};
  base::Loop loop({.unpaced = true, .begins_at = now});
  mavlink::SigningTime killed_with = 0;
  {
    auto const signing = read_signing(path).value();
    EXPECT_EQ(signing.signed_until, 0u);
    mavlink::Connection connection(loop, {.keys = signing.ring, .signed_until = signing.signed_until}, {});
    auto pipe = link::make_pipe(loop);
    connection.add_link(std::move(pipe.b));
    auto const keeper = keeper_of(connection, signing.time_file);
    loop.run_until_done(pass(loop, 25s));
    killed_with = read_signing(path).value().signed_until;
    EXPECT_GT(killed_with, mavlink::signing_time(now + 25s)) << "if it were killed now";
  }
  // The end was orderly, and the clock is a day behind.
  base::Loop late({.unpaced = true, .begins_at = now - 24h});
  auto const signing = read_signing(path).value();
  EXPECT_LT(signing.signed_until, killed_with) << "exact";
  EXPECT_GE(signing.signed_until, mavlink::signing_time(now + 24s));
  mavlink::Connection connection(late, {.keys = signing.ring, .signed_until = signing.signed_until}, {});
  EXPECT_GE(connection.signing()->signed_until(), signing.signed_until);
  {
    auto const keeper = keeper_of(connection, signing.time_file);
    late.run_until_done(pass(late, 1s));
  }
  EXPECT_GE(read_signing(path).value().signed_until, signing.signed_until);
}

TEST(SigningTime, IsNotTakenBackFromAnotherProgramWithTheKey) {
  TemporaryFolder const folder;
  auto const path = folder.write("k", std::string(64, 'a'));
  base::Loop loop({.unpaced = true});
  auto const signing = read_signing(path).value();
  mavlink::Connection connection(loop, {.keys = signing.ring}, {});
  auto keeper = keeper_of(connection, signing.time_file);
  std::ofstream(signing.time_file) << "200000000000000\n";
  keeper.reset();
  EXPECT_EQ(read_signing(path).value().signed_until, 200000000000000u);
  std::ofstream(signing.time_file) << "281474976710656\n";
  EXPECT_FALSE(read_signing(path)) << "has more than 48 bits";
}

}  // namespace
}  // namespace lapwing::host
