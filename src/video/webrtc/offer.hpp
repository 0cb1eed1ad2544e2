#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace lapwing::video {

/// Of a viewer's SDP (RFC 8866) what is needed to send it one video; all else of it is left out, the addresses that it
/// names among it: who looks begins, and nothing is sent where nobody has asked from.
struct Offer {
  struct Section {
    std::string kind = {};  ///< "video", "audio"
    std::string protocol = {};
    std::string format = {};  ///< the first one
    std::string mid = {};
  };
  std::vector<Section> sections = {};  ///< as they were offered; all but the video are declined
  std::size_t video = 0;               ///< which of them
  std::string ice_user = {};
  std::string ice_password = {};
  std::string fingerprint = {};  ///< of the viewer's certificate: "sha-256 0A:1B:..."
  std::uint8_t payload_type = 0;
};

/// Larger ones are refused; a browser's has some 10 kB.
inline constexpr std::size_t largest_offer = std::size_t{64} * 1024;

/// Errors: invalid_input, it is no offer that could be answered; refused, it is one, of no video that is made here:
/// H.264, constrained baseline, in pieces (packetization mode 1, RFC 6184), over DTLS and SRTP.
[[nodiscard]] base::Result<Offer> read_offer(std::string_view sdp);

/// An offer of that video alone, in words of ours.
[[nodiscard]] std::string text_of(Offer const& offer);

/// What answers the viewer, of what answers `text_of` it: its sections in their order, the others declined.
[[nodiscard]] std::string answer_to(Offer const& offer, std::string_view video_answer);

}  // namespace lapwing::video
