#include "apps/secret_file.hpp"

#include <gtest/gtest.h>

#include "apps/testing/temporary_folder.hpp"

namespace lapwing::apps {
namespace {

using testing::TemporaryFolder;

TEST(SigningKeyFile, HoldsTheKeyInHexadecimalDigits) {
  TemporaryFolder const folder;
  auto const key = read_signing_key(folder.write("k", "00ff" + std::string(58, '1') + "aB\n")).value().value();
  EXPECT_EQ(key[0], 0x00);
  EXPECT_EQ(key[1], 0xFF);
  EXPECT_EQ(key[2], 0x11);
  EXPECT_EQ(key[31], 0xAB);
}

TEST(SigningKeyFile, IsNotNeeded) {
  EXPECT_EQ(read_signing_key("").value(), std::nullopt);
}

TEST(SigningKeyFile, HoldsAPassPhrase) {
  TemporaryFolder const folder;
  EXPECT_EQ(read_signing_key(folder.write("k", "correct horse battery\n")).value(),
            mavlink::key_from_passphrase("correct horse battery"));
  // 63 digits are no key, so they are words.
  EXPECT_EQ(read_signing_key(folder.write("k", std::string(63, 'a'))).value(),
            mavlink::key_from_passphrase(std::string(63, 'a')));
}

TEST(SigningKeyFile, RefusesWhatCanBeGuessedAndDoesNotRepeatIt) {
  TemporaryFolder const folder;
  for (std::string const& text : {std::string(), std::string("short one")}) {
    auto const read = read_signing_key(folder.write("k", text));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, base::ErrorKind::invalid_input);
    EXPECT_EQ(read.error().message.find("short one"), std::string::npos);
  }
}

TEST(SigningKeyFile, MustNotBeReadableByOthers) {
  TemporaryFolder const folder;
  auto const path = folder.write("k", std::string(64, 'a'));
  std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::group_read);
  auto const read = read_signing_key(path);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().hint, "chmod 600 " + path);
}

TEST(SigningKeyFile, SaysHowToMakeOneThatIsMissing) {
  TemporaryFolder const folder;
  auto const read = read_signing_key((folder.path() / "absent").string());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, base::ErrorKind::not_found);
  EXPECT_NE(read.error().hint.find("openssl rand -hex 32"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::apps
