#include "host/station/web_access.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::host {
namespace {

namespace fs = std::filesystem;
using base::testing::TemporaryFolder;

constexpr auto token = "0123456789abcdef-._~";

TEST(TokenFile, IsReadWithoutBlanksAroundIt) {
  TemporaryFolder const folder;
  EXPECT_EQ(read_token(folder.write("t", std::string("  ") + token + "\n")).value(), token);
}

TEST(TokenFile, MustNotBeReadableByOthers) {
  TemporaryFolder const folder;
  auto const path = folder.write("t", token);
  for (auto const other :
       {fs::perms::group_read, fs::perms::others_read, fs::perms::group_write, fs::perms::others_exec}) {
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | other);
    auto const read = read_token(path);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find("others can read it"), std::string::npos);
    EXPECT_EQ(read.error().hint, "chmod 600 " + path);
  }
}

TEST(TokenFile, MustHoldOneWordThatIsHardToGuess) {
  TemporaryFolder const folder;
  for (std::string const& text : {std::string(""), std::string("short"), std::string("two words of some length"),
                                  std::string("0123456789abcde#"), std::string(257, 'a'), std::string(5000, 'a')}) {
    auto const read = read_token(folder.write("t", text));
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().kind, base::ErrorKind::invalid_input);
    if (!text.empty()) {
      EXPECT_EQ((read.error().message + read.error().hint).find(text), std::string::npos) << "it is secret";
    }
  }
}

TEST(TokenFile, SaysHowToMakeOneThatIsMissing) {
  TemporaryFolder const folder;
  auto const read = read_token((folder.path() / "absent").string());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, base::ErrorKind::not_found);
  EXPECT_NE(read.error().hint.find("openssl rand -hex 24"), std::string::npos);
  EXPECT_FALSE(read_token(folder.path().string()));
}

TEST(NewToken, IsLongAndAnotherEachTime) {
  EXPECT_EQ(new_token().size(), 48U);
  EXPECT_NE(new_token(), new_token());
  TemporaryFolder const folder;
  auto const made = new_token();
  EXPECT_EQ(read_token(folder.write("t", made)).value(), made) << "one may be put into a file";
}

TEST(TokenFor, IsNotNeededOnLoopback) {
  for (auto const* bind : {"127.0.0.1", "127.0.0.2", "::1"}) EXPECT_EQ(token_for({.bind = bind}).value(), "") << bind;
}

TEST(TokenFor, IsDemandedBeyondLoopback) {
  for (auto const* bind : {"0.0.0.0", "::", "192.168.1.5"}) {
    auto const refused = token_for({.bind = bind});
    ASSERT_FALSE(refused) << bind;
    EXPECT_EQ(refused.error().kind, base::ErrorKind::invalid_input);
    EXPECT_NE(refused.error().hint.find("--generate-token"), std::string::npos);
    EXPECT_NE(refused.error().hint.find("--token-file"), std::string::npos);
  }
}

TEST(TokenFor, ComesFromTheFileOrIsMade) {
  TemporaryFolder const folder;
  EXPECT_EQ(token_for({.bind = "0.0.0.0", .token_file = folder.write("t", token)}).value(), token);
  EXPECT_EQ(token_for({.bind = "0.0.0.0", .generate_token = true})->size(), 48U);
  EXPECT_EQ(token_for({.generate_token = true})->size(), 48U) << "on loopback, too, when asked for";
}

TEST(WebArguments, GoBeforeTheFile) {
  WebAccess access{.bind = "0.0.0.0", .port = 1, .token_file = "f"};
  apply({.bind = "127.0.0.1", .port = 2, .generate_token = true}, access);
  EXPECT_EQ(access.bind, "127.0.0.1");
  EXPECT_EQ(access.port, 2);
  EXPECT_TRUE(access.generate_token);
  EXPECT_EQ(access.token_file, "");
  apply({}, access);
  EXPECT_EQ(access.port, 2);
  apply({.token_file = "g"}, access);
  EXPECT_EQ(access.token_file, "g");
  EXPECT_FALSE(access.generate_token);
}

TEST(MapAddresses, HoldTheTokenBehindTheHash) {
  EXPECT_EQ(map_addresses("127.0.0.1", 8080, ""), (std::vector<std::string>{"http://127.0.0.1:8080/"}));
  EXPECT_EQ(map_addresses("::1", 80, "abc"), (std::vector<std::string>{"http://[::1]:80/#token=abc"}));
}

TEST(MapAddresses, OfAWildcardCanBeOpened) {
  auto const addresses = map_addresses("0.0.0.0", 8080, "abc");
  EXPECT_EQ(addresses.back(), "http://127.0.0.1:8080/#token=abc");
  EXPECT_TRUE(
      std::ranges::none_of(addresses, [](auto const& address) { return address.find("0.0.0.0") != address.npos; }));
}

}  // namespace
}  // namespace lapwing::host
