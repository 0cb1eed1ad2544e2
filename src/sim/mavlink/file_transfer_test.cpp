#include "sim/mavlink/file_transfer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <string>

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;

constexpr mavlink::Address self{7, 1};
enum Opcode : std::uint8_t { terminate = 1, reset = 2, open_to_read = 4, read = 5, create = 6, burst = 15 };

struct Asked {
  std::uint8_t opcode = 0;
  std::uint8_t session = 0;
  std::uint32_t offset = 0;
  std::string data = {};
  std::uint8_t size = 0;
  std::uint16_t sequence = 0x01FF;
};

mavlink::Frame request(Asked const& asked) {
  mavlink::Frame frame;
  frame.source = {255, 190};
  frame.message_id = 110;
  frame.payload[1] = 7;
  frame.payload[2] = 1;
  frame.payload[3] = static_cast<std::uint8_t>(asked.sequence & 0xFFU);
  frame.payload[4] = static_cast<std::uint8_t>(asked.sequence >> 8U);
  frame.payload[5] = asked.session;
  frame.payload[6] = asked.opcode;
  frame.payload[7] = asked.data.empty() ? asked.size : static_cast<std::uint8_t>(asked.data.size());
  std::memcpy(frame.payload.data() + 11, &asked.offset, 4);
  std::ranges::copy(asked.data, frame.payload.begin() + 15);
  return frame;
}

int result(std::vector<mavlink::Frame> const& answers) {
  EXPECT_EQ(answers.size(), 1u);
  return answers.front().payload[6] == 128 ? 0 : answers.front().payload[15];
}

/// A vehicle with the file and one without.
struct Vehicle {
  std::vector<mavlink::Frame> ask(Asked const& asked) { return transfer.answer(request(asked), self, now); }
  int result_of(Asked const& asked) { return result(ask(asked)); }

  base::Duration now{};
  ParameterTable parameters{Kind{}, 7};
  FileTransfer transfer{&parameters};
};
struct WithoutFiles {
  std::vector<mavlink::Frame> ask(Asked const& asked) { return transfer.answer(request(asked), self, {}); }
  int result_of(Asked const& asked) { return result(ask(asked)); }

  FileTransfer transfer{nullptr};
};

using Bytes = std::vector<std::uint8_t>;

/// Reads the file with bursts of parts of that size, as a ground station does.
Bytes download(Vehicle& vehicle, std::string const& path, std::uint8_t size) {
  EXPECT_EQ(vehicle.result_of({.opcode = open_to_read, .data = path}), 0);
  Bytes file;
  for (auto const& part : vehicle.ask({.opcode = burst, .size = size})) {
    if (part.payload[6] != 128) {
      EXPECT_EQ(part.payload[15], 6) << "the end of the file";
      continue;
    }
    std::uint32_t offset = 0;
    std::memcpy(&offset, part.payload.data() + 11, 4);
    EXPECT_EQ(offset, file.size());
    auto const data = part.payload.begin() + 15;
    file.insert(file.end(), data, data + part.payload[7]);
  }
  EXPECT_EQ(vehicle.result_of({.opcode = terminate}), 0);
  return file;
}

struct Entry {
  int type;
  float value;
  std::optional<float> standard = std::nullopt;
  std::size_t value_at = 0;
};

/// An independent reading of the format that ArduPilot documents.
std::map<std::string, Entry> unpack(Bytes const& file) {
  std::map<std::string, Entry> entries;
  std::string last;
  std::size_t at = 6;
  auto const value_of = [&](int type) {
    float real = 0;
    std::int32_t whole = 0;
    if (type == 1) whole = std::int32_t{static_cast<std::int8_t>(file[at])};
    if (type == 2) whole = static_cast<std::int16_t>(file[at] | file[at + 1] << 8U);
    if (type == 3) std::memcpy(&whole, &file[at], 4);
    if (type == 4) std::memcpy(&real, &file[at], 4);
    at += static_cast<std::size_t>(type == 1 ? 1 : type == 2 ? 2 : 4);
    return type == 4 ? real : static_cast<float>(whole);
  };
  while (at < file.size()) {
    if (file[at] == 0) {
      ++at;
      continue;
    }
    int const type = file[at] & 0x0F;
    bool const has_default = (file[at] & 0x10) != 0;
    auto const common = static_cast<std::size_t>(file[at + 1] & 0x0F);
    auto const own = static_cast<std::size_t>(file[at + 1] >> 4) + 1;
    at += 2;
    last = last.substr(0, common) + std::string(file.begin() + static_cast<std::ptrdiff_t>(at),
                                                file.begin() + static_cast<std::ptrdiff_t>(at + own));
    at += own;
    Entry entry{.type = type, .value = 0, .value_at = at};
    entry.value = value_of(type);
    if (has_default) entry.standard = value_of(type);
    entries.emplace(last, entry);
  }
  return entries;
}

TEST(FileTransfer, HasNoOtherFileToOpen) {
  Vehicle vehicle;
  auto const answers = vehicle.ask({.opcode = open_to_read, .data = "logs/1.bin"});
  ASSERT_EQ(answers.size(), 1u);
  auto const& told = answers.front().payload;
  EXPECT_EQ(told[1], 255);
  EXPECT_EQ(told[2], 190);
  EXPECT_EQ(told[3], 0x00) << "one more than was asked";
  EXPECT_EQ(told[4], 0x02);
  EXPECT_EQ(told[6], 129);
  EXPECT_EQ(told[7], 1);
  EXPECT_EQ(told[8], 4);
  EXPECT_EQ(told[15], 10);
  EXPECT_GT(mavlink::serialize(answers.front()).bytes().size(), 20u) << "the answer travels whole";
  EXPECT_EQ(WithoutFiles().result_of({.opcode = open_to_read, .data = "@PARAM/param.pck"}), 10);
}

TEST(FileTransfer, RefusesWhatNeedsASessionAndWhatItDoesNotKnow) {
  EXPECT_EQ(Vehicle().result_of({.opcode = read}), 10);
  EXPECT_EQ(WithoutFiles().result_of({.opcode = read}), 4);
  EXPECT_EQ(WithoutFiles().result_of({.opcode = create}), 1);
  EXPECT_EQ(WithoutFiles().result_of({.opcode = 77}), 7);
}

TEST(FileTransfer, IsAlwaysReset) {
  auto const answers = Vehicle().ask({.opcode = reset});
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers.front().payload[6], 128);
  EXPECT_EQ(answers.front().payload[7], 0);
}

TEST(FileTransfer, AnswersNeitherAnswersNorWhatIsForOthers) {
  Vehicle vehicle;
  EXPECT_TRUE(vehicle.ask({.opcode = 128}).empty());
  EXPECT_TRUE(vehicle.ask({.opcode = 129}).empty());
  EXPECT_TRUE(vehicle.transfer.answer(request({.opcode = open_to_read}), {8, 1}, {}).empty());
  auto other = request({.opcode = open_to_read});
  other.message_id = 0;
  EXPECT_TRUE(vehicle.transfer.answer(other, self, {}).empty());
}

TEST(ParameterFile, HoldsEveryParameterWithItsTypeAndValue) {
  Vehicle vehicle;
  vehicle.parameters.set("WPNAV_SPEED", 777.0F);
  for (auto const size : {std::uint8_t{80}, std::uint8_t{239}}) {
    auto const file = download(vehicle, "@PARAM/param.pck", size);
    auto const count = vehicle.parameters.all().size();
    EXPECT_EQ(file[0] | file[1] << 8, 0x671b);
    EXPECT_EQ(static_cast<std::size_t>(file[2] | file[3] << 8), count);
    EXPECT_EQ(static_cast<std::size_t>(file[4] | file[5] << 8), count);
    auto const entries = unpack(file);
    ASSERT_EQ(entries.size(), count);
    for (auto const& parameter : vehicle.parameters.all()) {
      EXPECT_FLOAT_EQ(entries.at(parameter.name).value, parameter.value) << parameter.name;
      auto const& entry = entries.at(parameter.name);
      auto const bytes = static_cast<std::size_t>(entry.type == 1 ? 1 : entry.type == 2 ? 2 : 4);
      EXPECT_EQ(entry.value_at / size, (entry.value_at + bytes - 1) / size) << parameter.name << " is read in one part";
    }
    EXPECT_EQ(entries.at("FENCE_TYPE").type, 1);
    EXPECT_EQ(entries.at("WPNAV_SPEED").type, 4);
  }
}

TEST(ParameterFile, TellsDefaultsOfWhatIsSetOtherwise) {
  Vehicle vehicle;
  vehicle.parameters.set("WPNAV_SPEED", 777.0F);
  auto const file = download(vehicle, "@PARAM/param.pck?withdefaults=1", 239);
  EXPECT_EQ(file[0] | file[1] << 8, 0x671c);
  auto const entries = unpack(file);
  EXPECT_EQ(entries.at("WPNAV_SPEED").standard, 1000.0F);
  EXPECT_EQ(entries.at("WPNAV_ACCEL").standard, std::nullopt);
}

TEST(ParameterFile, CanBeReadInAPartOfIt) {
  Vehicle vehicle;
  auto const file = download(vehicle, "@PARAM/param.pck?start=10&count=3", 239);
  auto const entries = unpack(file);
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_TRUE(entries.contains(vehicle.parameters.all()[10].name));
  EXPECT_EQ(vehicle.result_of({.opcode = open_to_read, .data = "@PARAM/param.pck?count=x"}), 10);
}

TEST(ParameterFile, IsReadPartByPartTooAndMissingPartsAgain) {
  Vehicle vehicle;
  auto const whole = download(vehicle, "@PARAM/param.pck", 100);
  EXPECT_EQ(vehicle.result_of({.opcode = open_to_read, .data = "@PARAM/param.pck"}), 0);
  Bytes file;
  for (;;) {
    auto const answers = vehicle.ask({.opcode = read, .offset = static_cast<std::uint32_t>(file.size()), .size = 100});
    ASSERT_EQ(answers.size(), 1u);
    auto const& part = answers.front().payload;
    if (part[6] == 129) {
      EXPECT_EQ(part[15], 6);
      break;
    }
    file.insert(file.end(), part.begin() + 15, part.begin() + 15 + part[7]);
  }
  EXPECT_EQ(file, whole);
  EXPECT_EQ(vehicle.result_of({.opcode = read, .size = 50}), 2) << "the size of parts stays";
}

TEST(ParameterFile, IsOpenForOneSessionAtATimeUntilItFallsSilent) {
  Vehicle vehicle;
  EXPECT_EQ(vehicle.result_of({.opcode = open_to_read, .session = 1, .data = "@PARAM/param.pck"}), 0);
  EXPECT_EQ(vehicle.result_of({.opcode = open_to_read, .session = 2, .data = "@PARAM/param.pck"}), 1);
  EXPECT_EQ(vehicle.result_of({.opcode = read, .session = 2, .size = 100}), 4);
  vehicle.now += 4s;
  EXPECT_EQ(vehicle.result_of({.opcode = open_to_read, .session = 2, .data = "@PARAM/param.pck"}), 0);
}

}  // namespace
}  // namespace lapwing::sim
