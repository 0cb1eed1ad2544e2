#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bus/cdr/cdr.hpp"
#include "scans/storage/unpack.hpp"

namespace lapwing::scans::testing {

/// A bag that a test writes, in either storage.
class WrittenBag {
 public:
  template <bus::Message M>
  void add(std::string const& topic, std::chrono::nanoseconds logged, M const& message) {
    add(topic, std::string(bus::Description<M>::name), logged, bus::encode(message));
  }
  void add(std::string const& topic, std::string const& type, std::chrono::nanoseconds logged, std::string bytes,
           std::string const& encoding = "cdr");

  /// As an MCAP file whose chunks hold so many messages each; 0: without chunks. No summary is behind them.
  [[nodiscard]] std::string mcap(Packing packing, std::size_t messages_a_chunk) const;
  void write_sqlite(std::filesystem::path const& file) const;

  /// A record of MCAP, and its fields.
  [[nodiscard]] static std::string record(int opcode, std::string const& content);
  template <class T>
  [[nodiscard]] static std::string number(T value) {
    std::string bytes;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xffU);
    return bytes;
  }
  [[nodiscard]] static std::string text(std::string const& value);
  [[nodiscard]] static std::string chunk(std::string const& records, Packing packing, std::uint32_t crc);
  static std::string const magic;

 private:
  struct Topic {
    std::string name;
    std::string type;
    std::string encoding;
  };
  struct Message {
    std::size_t topic = 0;
    std::chrono::nanoseconds logged{};
    std::string bytes;
  };
  std::vector<Topic> topics_;
  std::vector<Message> messages_;
};

}  // namespace lapwing::scans::testing
