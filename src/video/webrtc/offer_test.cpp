#include "video/webrtc/offer.hpp"

#include <gtest/gtest.h>

#include "video/webrtc/testing/browser_offer.hpp"

namespace lapwing::video {
namespace {

using testing::browser_offer;
using testing::with;
using testing::without;

TEST(Offer, IsReadForWhatIsNeededOfIt) {
  auto const offer = read_offer(browser_offer());
  ASSERT_TRUE(offer) << offer.error().message;
  EXPECT_EQ(offer->payload_type, 108) << "the one of H.264 that is constrained and comes in pieces";
  EXPECT_EQ(offer->ice_user, "79Q+");
  EXPECT_EQ(offer->ice_password, "CZz2g9XhzBH7opNBXFIqGD0e");
  EXPECT_TRUE(offer->fingerprint.starts_with("sha-256 B6:F7:"));
  ASSERT_EQ(offer->sections.size(), 1U);
  EXPECT_EQ(offer->sections.front().mid, "0");
}

TEST(Offer, IsWrittenAnewWithoutTheAddressesThatItNames) {
  auto const text = text_of(read_offer(browser_offer()).value());
  EXPECT_EQ(text.find("candidate"), std::string::npos);
  EXPECT_EQ(text.find("192.0.2.7"), std::string::npos);
  auto const again = read_offer(text);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(text_of(*again), text);
}

TEST(Offer, MayEndItsLinesWithoutCarriageReturns) {
  auto bare = browser_offer();
  std::erase(bare, '\r');
  EXPECT_EQ(text_of(read_offer(bare).value()), text_of(read_offer(browser_offer()).value()));
}

TEST(Offer, MayHaveItsKeysForAllSections) {
  std::string const keys = "a=ice-ufrag:79Q+\r\na=ice-pwd:CZz2g9XhzBH7opNBXFIqGD0e\r\n";
  auto moved = without(without(browser_offer(), "a=ice-ufrag:"), "a=ice-pwd:");
  moved.insert(moved.find("m="), keys);
  auto const offer = read_offer(moved);
  ASSERT_TRUE(offer) << offer.error().message;
  EXPECT_EQ(offer->ice_user, "79Q+");
}

TEST(Offer, OfSoundAndVideoIsAnsweredForTheVideoInItsPlace) {
  auto both = browser_offer();
  both.insert(both.find("m=video"), "m=audio 9 UDP/TLS/RTP/SAVPF 111 63\r\na=mid:sound\r\na=ice-ufrag:other\r\n");
  auto const offer = read_offer(both);
  ASSERT_TRUE(offer) << offer.error().message;
  EXPECT_EQ(offer->video, 1U);
  EXPECT_EQ(offer->ice_user, "79Q+") << "that of the video";
  auto const answer = answer_to(*offer, "v=0\r\na=group:BUNDLE 0\r\nm=video 9 UDP/TLS/RTP/SAVPF 108\r\na=mid:0\r\n");
  EXPECT_EQ(answer,
            "v=0\r\na=group:BUNDLE 0\r\nm=audio 0 UDP/TLS/RTP/SAVPF 111\r\nc=IN IP4 0.0.0.0\r\na=inactive\r\n"
            "a=mid:sound\r\nm=video 9 UDP/TLS/RTP/SAVPF 108\r\na=mid:0\r\n");
}

TEST(Offer, ThatIsNoneIsTold) {
  auto const sound = browser_offer();
  auto many = sound;
  for (int i = 0; i < 8; ++i) many += "m=audio 9 UDP/TLS/RTP/SAVPF 0\r\na=mid:1\r\n";
  for (auto const& bad : {
           std::string(),
           std::string("{\"type\":\"offer\"}"),
           sound.substr(3),
           std::string("v=0\r\n") + std::string(largest_offer, 'x'),
           std::string("v=0\r\na=") + std::string(5000, 'x'),
           without(sound, "a=ice-ufrag:"),
           without(sound, "a=ice-pwd:"),
           without(sound, "a=fingerprint:"),
           without(sound, "a=mid:"),
           with(sound, "a=ice-ufrag:79Q+", "a=ice-ufrag:79Q+ x"),
           with(sound, "a=ice-pwd:CZz2g9XhzBH7opNBXFIqGD0e", "a=ice-pwd:short"),
           with(sound, "a=fingerprint:sha-256 B6", "a=fingerprint:sha-256 XX"),
           with(sound, "a=fingerprint:sha-256 B6:F7", "a=fingerprint:sha-1 B6"),
           with(sound, "a=mid:0", "a=mid:0 1"),
           with(sound, "m=video 51123", "m="),
           many,
       }) {
    auto const offer = read_offer(bad);
    ASSERT_FALSE(offer) << bad.substr(0, 300);
    EXPECT_EQ(offer.error().kind, base::ErrorKind::invalid_input) << offer.error().message;
  }
}

TEST(Offer, OfWhatIsNotMadeHereIsRefused) {
  auto const sound = browser_offer();
  for (auto const& [bad, why] : {
           std::pair{with(sound, "profile-level-id=42e01f", "profile-level-id=64001f"), "no H.264"},
           std::pair{without(sound, "a=rtpmap:108"), "no H.264"},
           std::pair{with(sound, "a=recvonly", "a=sendonly"), "does not receive"},
           std::pair{with(sound, "UDP/TLS/RTP/SAVPF", "RTP/AVP"), "DTLS"},
           std::pair{with(sound, "m=video", "m=audio"), "no video"},
           std::pair{sound + sound.substr(sound.find("m=")), "several videos"},
       }) {
    auto const offer = read_offer(bad);
    ASSERT_FALSE(offer) << why;
    EXPECT_EQ(offer.error().kind, base::ErrorKind::refused) << offer.error().message;
    EXPECT_NE(offer.error().message.find(why), std::string::npos) << offer.error().message;
  }
}

}  // namespace
}  // namespace lapwing::video
