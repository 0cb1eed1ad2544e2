// Seeds for fuzz_frame, fuzz_tlog, fuzz_decode and fuzz_fleet: frame_seeds TARGET DIRECTORY writes one file for each
// message.
#include <cstdint>
#include <fstream>
#include <span>
#include <string>

#include "mavlink/wire/tlog.hpp"
#include "messages.hpp"

using namespace lapwing;

namespace {

void write(std::ofstream& file, std::span<std::uint8_t const> bytes) {
  file.write(reinterpret_cast<char const*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  std::string const target = arguments[1];
  auto const& samples = fuzz::sample_frames();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::ofstream file(std::string(arguments[2]) + "/message" + std::to_string(i), std::ios::binary);
    auto frame = samples[i];
    auto const payload = std::span(frame.payload).first(std::max<std::size_t>(frame.payload_size, 1));
    if (target == "frame") {
      file.put(static_cast<char>(255));
      write(file, mavlink::serialize(frame).bytes());
      if (frame.message_id < 256) {
        frame.version = 1;
        write(file, mavlink::serialize(frame).bytes());
      }
    } else if (target == "tlog") {
      std::vector<std::uint8_t> entries;
      for (int s = 0; s < 2; ++s) mavlink::append_tlog(entries, base::UtcTime(std::chrono::seconds(s)), frame);
      write(file, entries);
    } else {
      file.put(static_cast<char>(i));
      if (target == "fleet") file.put(static_cast<char>(payload.size()));
      write(file, payload);
    }
  }
  return 0;
}
