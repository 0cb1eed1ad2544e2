#include "vision/image/internal/jpeg_segments.hpp"

namespace lapwing::vision::internal {

std::vector<JpegSegment> jpeg_segments(Bytes file) {
  std::vector<JpegSegment> segments;
  std::size_t at = 2;
  while (at + 4 <= file.size()) {
    if (byte_at(file, at) != 0xFF) break;
    auto const marker = byte_at(file, at + 1);
    if (marker == 0xFF) {  // filling
      ++at;
      continue;
    }
    if (marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) {  // these stand alone
      at += 2;
      continue;
    }
    std::size_t const length = big_endian(file, at + 2, 2);
    if (length < 2 || at + 2 + length > file.size()) break;
    if (marker == jpeg_coded_data) {
      segments.push_back({marker, file.subspan(at)});
      break;
    }
    segments.push_back({marker, file.subspan(at + 4, length - 2)});
    at += 2 + length;
  }
  return segments;
}

}  // namespace lapwing::vision::internal
