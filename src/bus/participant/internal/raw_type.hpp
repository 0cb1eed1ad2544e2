#pragma once

#include <cstring>
#include <functional>
#include <string>

#include <fastdds/dds/topic/TopicDataType.hpp>

namespace lapwing::bus::internal {

/// Bytes under a type's name: what they mean is settled on the loop, not on the middleware's threads.
class RawType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
  /// Larger ones are somebody's mistake; a picture of 20 megapixels is smaller.
  static constexpr std::uint32_t most_bytes = 64U << 20U;

  explicit RawType(std::string const& name) {
    constexpr std::uint32_t usual_bytes = 1024;  // buffers grow from here
    setName(name.c_str());
    m_typeSize = usual_bytes;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }

  bool serialize(void* data, Payload* payload) override {
    auto const& bytes = *static_cast<std::string*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(Payload* payload, void* data) override {
    if (payload->length > most_bytes) return false;
    static_cast<std::string*>(data)->assign(reinterpret_cast<char const*>(payload->data), payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<std::string*>(data)->size()); };
  }
  void* createData() override { return new std::string; }
  void deleteData(void* data) override { delete static_cast<std::string*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace lapwing::bus::internal
