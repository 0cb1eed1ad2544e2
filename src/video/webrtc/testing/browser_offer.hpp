#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace lapwing::video::testing {

/// As browsers offer to receive a video, with fewer kinds of it.
inline std::string browser_offer() {
  return "v=0\r\no=- 4611 2 IN IP4 127.0.0.1\r\ns=-\r\nt=0 0\r\na=group:BUNDLE 0\r\na=extmap-allow-mixed\r\n"
         "a=msid-semantic: WMS\r\nm=video 51123 UDP/TLS/RTP/SAVPF 96 102 114 108 109\r\nc=IN IP4 192.0.2.7\r\n"
         "a=rtcp:9 IN IP4 0.0.0.0\r\na=candidate:1 1 udp 2113937151 192.0.2.7 51123 typ host generation 0\r\n"
         "a=ice-ufrag:79Q+\r\na=ice-pwd:CZz2g9XhzBH7opNBXFIqGD0e\r\na=ice-options:trickle\r\n"
         "a=fingerprint:sha-256 "
         "B6:F7:59:92:43:1D:62:97:AC:B5:89:42:16:EC:38:C8:38:9B:7C:0F:64:AD:E7:9B:FE:37:61:56:12:E0:5C:2A\r\n"
         "a=setup:actpass\r\na=mid:0\r\na=recvonly\r\na=rtcp-mux\r\na=rtcp-rsize\r\na=rtpmap:96 VP8/90000\r\n"
         "a=rtpmap:102 H264/90000\r\n"
         "a=fmtp:102 level-asymmetry-allowed=1;packetization-mode=1;profile-level-id=42001f\r\n"
         "a=rtpmap:114 H264/90000\r\n"
         "a=fmtp:114 level-asymmetry-allowed=1;packetization-mode=0;profile-level-id=42e01f\r\n"
         "a=rtpmap:108 H264/90000\r\na=rtcp-fb:108 nack pli\r\n"
         "a=fmtp:108 level-asymmetry-allowed=1;packetization-mode=1;profile-level-id=42e01f\r\n"
         "a=rtpmap:109 rtx/90000\r\na=fmtp:109 apt=108\r\n";
}

/// Every `what` replaced.
inline std::string with(std::string text, std::string_view what, std::string_view instead) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + instead.size()))
    text.replace(at, what.size(), instead);
  return text;
}

/// Without the first line that begins so.
inline std::string without(std::string text, std::string_view beginning) {
  auto const at = text.find(beginning);
  return at == std::string::npos ? text : text.erase(at, text.find('\n', at) + 1 - at);
}

}  // namespace lapwing::video::testing
