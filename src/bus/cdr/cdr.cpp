#include "bus/cdr/cdr.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/exceptions/Exception.h>
#include <fastcdr/FastBuffer.h>

namespace lapwing::bus::cdr {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

// ---- writing

struct Writer::Stream {
  FastBuffer buffer;  // grows as it is written to
  Cdr cdr{buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR};
};

Writer::Writer() : stream_(std::make_unique<Stream>()) {
  stream_->cdr.serialize_encapsulation();
}

Writer::~Writer() = default;

template <class T>
void Writer::numbers(T const* first, std::size_t count) {
  if (count > 0) stream_->cdr.serializeArray(first, count);
}

void Writer::text(std::string const& value) {
  stream_->cdr.serialize(value);
}

std::string Writer::bytes() const {
  return {stream_->buffer.getBuffer(), stream_->cdr.getSerializedDataLength()};
}

// ---- reading

struct Reader::Stream {
  explicit Stream(std::string_view bytes)
      : buffer(const_cast<char*>(bytes.data()), bytes.size()),  // it is only read from
        cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR),
        size(bytes.size()) {}
  [[nodiscard]] std::size_t left() const { return size - cdr.getSerializedDataLength(); }

  FastBuffer buffer;
  Cdr cdr;
  std::size_t size;
};

namespace {

/// Fast CDR says by exceptions that there is no more.
bool succeeds(auto const& reading) {
  try {
    reading();
    return true;
  } catch (eprosima::fastcdr::exception::Exception const&) {
    return false;
  }
}

}  // namespace

Reader::Reader(std::string_view bytes) : stream_(std::make_unique<Stream>(bytes)) {
  is_good_ = succeeds([&] { stream_->cdr.read_encapsulation(); });
}

Reader::~Reader() = default;

template <class T>
void Reader::numbers(T* first, std::size_t count) {
  if (is_good_ && count > 0) is_good_ = succeeds([&] { stream_->cdr.deserializeArray(first, count); });
}

void Reader::text(std::string& value) {
  if (is_good_) is_good_ = succeeds([&] { stream_->cdr.deserialize(value); });
}

std::size_t Reader::length(std::size_t least_bytes) {
  std::uint32_t count = 0;
  numbers(&count, 1);
  if (is_good_ && count > stream_->left() / least_bytes) is_good_ = false;
  return is_good_ ? count : 0;
}

// A type is no expression that parentheses could hold together.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define LAPWING_CDR_NUMBER(T)                              \
  template void Writer::numbers<T>(T const*, std::size_t); \
  template void Reader::numbers<T>(T*, std::size_t)
// NOLINTEND(bugprone-macro-parentheses)
LAPWING_CDR_NUMBER(bool);
LAPWING_CDR_NUMBER(std::int8_t);
LAPWING_CDR_NUMBER(std::uint8_t);
LAPWING_CDR_NUMBER(std::int16_t);
LAPWING_CDR_NUMBER(std::uint16_t);
LAPWING_CDR_NUMBER(std::int32_t);
LAPWING_CDR_NUMBER(std::uint32_t);
LAPWING_CDR_NUMBER(std::int64_t);
LAPWING_CDR_NUMBER(std::uint64_t);
LAPWING_CDR_NUMBER(float);
LAPWING_CDR_NUMBER(double);
#undef LAPWING_CDR_NUMBER

}  // namespace lapwing::bus::cdr
