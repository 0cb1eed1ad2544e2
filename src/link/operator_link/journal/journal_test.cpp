#include "link/operator_link/journal/journal.hpp"

#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/assert.hpp"
#include "base/async/notifier.hpp"
#include "base/testing/temporary_folder.hpp"
#include "link/operator_link/testing/memory_disk.hpp"
#include "link/operator_link/wire/byte_order.hpp"

namespace lapwing::link::operator_link {
namespace {

using namespace std::chrono_literals;
using testing::MemoryDisk;
using testing::Platter;

struct JournalTest : ::testing::Test {
  std::unique_ptr<Journal> open(JournalLimits limits = {.bytes = 100'000, .segment_bytes = 500}) {
    auto journal = Journal::open(std::make_unique<MemoryDisk>(loop, platter), limits, 1000 + ++opened);
    LAPWING_ASSERT(journal.has_value());
    (*journal)->listen({.ready = [this] { ++ready; }, .fault = [this](std::string what) { faults.push_back(what); }});
    return *std::move(journal);
  }
  void settle() {
    loop.run_until_done([](base::Loop& on) -> base::Task<int> {
      for (int i = 0; i < 10; ++i) co_await on.turn();
      co_return 0;
    }(loop));
  }
  static std::string text(std::uint64_t number) {
    return fmt::format("message {} {}", number, std::string(number % 50, 'x'));
  }
  /// All that is not acknowledged, read one after the other.
  static std::vector<std::uint64_t> numbers(Journal& journal) {
    std::vector<std::uint64_t> found;
    for (std::uint64_t next = journal.first();;) {
      auto const entry = journal.read(next);
      if (!entry || !*entry) return found;
      EXPECT_EQ((*entry)->text, text((*entry)->number));
      EXPECT_EQ((*entry)->key, "key");
      found.push_back((*entry)->number);
      next = found.back() + 1;
    }
  }
  static std::vector<std::uint64_t> range(std::uint64_t first, std::uint64_t last) {
    std::vector<std::uint64_t> all;
    for (auto number = first; number <= last; ++number) all.push_back(number);
    return all;
  }

  base::Loop loop{{.unpaced = true}};
  Platter platter;
  int ready = 0;
  std::vector<std::string> faults;
  std::uint64_t opened = 0;
};

TEST_F(JournalTest, GivesBackWhatItTook) {
  auto const journal = open();
  for (std::uint64_t i = 1; i <= 100; ++i) EXPECT_EQ(journal->append("key", text(i)), i);
  EXPECT_EQ(numbers(*journal), range(1, 100));
  EXPECT_EQ(numbers(*journal), range(1, 100)) << "from the beginning again";
  EXPECT_EQ((*journal->read(57))->number, 57u);
  EXPECT_EQ((*journal->read(3))->number, 3u);
  EXPECT_FALSE(*journal->read(101));
  EXPECT_EQ(journal->append("key", text(101)), 101u);
  EXPECT_EQ((*journal->read(101))->number, 101u) << "a file that has grown";
}

TEST_F(JournalTest, IsReadyOnceItIsOnTheDisk) {
  auto const journal = open();
  settle();
  EXPECT_TRUE(journal->append("key", text(1)));
  EXPECT_EQ(journal->ready(), 0u);
  for (std::uint64_t i = 2; i <= 50; ++i) EXPECT_TRUE(journal->append("key", text(i)));
  auto const syncs = platter.syncs;
  settle();
  EXPECT_EQ(journal->ready(), 50u);
  EXPECT_LE(platter.syncs, syncs + 1) << "many share one wait for the disk";
  EXPECT_GT(ready, 0);
}

TEST_F(JournalTest, OutlivesTheProcess) {
  auto journal = open();
  auto const stream = journal->stream();
  for (std::uint64_t i = 1; i <= 100; ++i) EXPECT_TRUE(journal->append("key", text(i)));
  journal->acknowledge(30);
  journal->note_taken({77, 12});
  journal.reset();
  journal = open();
  EXPECT_EQ(journal->stream(), stream);
  EXPECT_EQ(journal->first(), 31u);
  EXPECT_EQ(journal->next(), 101u);
  EXPECT_EQ(journal->taken(), (DurableQueue::Mark{77, 12}));
  EXPECT_EQ(journal->ready(), 0u) << "nobody knows yet whether it is on the disk";
  settle();
  EXPECT_EQ(journal->ready(), 100u);
  EXPECT_EQ(numbers(*journal), range(31, 100));
}

TEST_F(JournalTest, RemovesWhatHasBeenTaken) {
  auto const journal = open();
  for (std::uint64_t i = 1; i <= 1000; ++i) {
    EXPECT_TRUE(journal->append("key", text(i)));
    journal->acknowledge(i);
  }
  EXPECT_LE(platter.files.size(), 2u);
  EXPECT_LT(journal->bytes(), 1500u);
}

TEST_F(JournalTest, KeepsItsStateWhenOnlyMarksAreWritten) {
  auto journal = open();
  auto const stream = journal->stream();
  EXPECT_TRUE(journal->append("key", text(1)));
  journal->acknowledge(1);
  for (std::uint64_t i = 1; i <= 1000; ++i) journal->note_taken({5, i});
  EXPECT_LE(platter.files.size(), 2u);
  journal = open();
  EXPECT_EQ(journal->stream(), stream);
  EXPECT_EQ(journal->next(), 2u);
  EXPECT_EQ(journal->taken(), (DurableQueue::Mark{5, 1000}));
}

/// The process dies at each byte that is written: what was accepted before is there, whole, and it goes on.
TEST_F(JournalTest, IsRecoveredFromATearAtEachByte) {
  for (std::size_t byte = 0; byte < 1500; ++byte) {
    platter = {};
    platter.dies_after = byte;
    std::uint64_t accepted = 0;
    {
      auto const journal = open();
      while (platter.dies_after > 0) {
        ASSERT_TRUE(journal->append("key", text(accepted + 1)));
        if (platter.dies_after > 0) ++accepted;  // the last may be torn
        if (accepted == 10) journal->acknowledge(4);
      }
    }
    platter.dies_after = std::numeric_limits<std::size_t>::max();
    auto journal = open();
    ASSERT_GE(journal->next(), accepted + 1) << "torn after byte " << byte;
    ASSERT_LE(journal->next(), accepted + 2);
    ASSERT_EQ(journal->damaged_bytes(), 0u);
    auto const next = journal->next();
    ASSERT_EQ(numbers(*journal), range(journal->first(), next - 1));
    ASSERT_EQ(journal->append("key", text(next)), next);
    journal = open();
    ASSERT_EQ(numbers(*journal), range(journal->first(), next)) << "torn after byte " << byte;
  }
}

TEST_F(JournalTest, HasWhatWasReadyAfterLossOfPower) {
  auto journal = open();
  for (std::uint64_t i = 1; i <= 20; ++i) EXPECT_TRUE(journal->append("key", text(i)));
  settle();
  EXPECT_EQ(journal->ready(), 20u);
  for (std::uint64_t i = 21; i <= 30; ++i) EXPECT_TRUE(journal->append("key", text(i)));
  platter.lose_power();
  journal = open();
  EXPECT_EQ(numbers(*journal), range(1, 20));
}

TEST_F(JournalTest, RefusesOnAFullDiskAndGoesOnWithRoom) {
  auto const journal = open({.bytes = 1'000'000, .segment_bytes = 500});
  platter.room = 5000;
  std::uint64_t accepted = 0;
  base::Result<std::uint64_t> last;
  while ((last = journal->append("key", text(accepted + 1)))) ++accepted;
  EXPECT_EQ(last.error().kind, base::ErrorKind::io);
  EXPECT_NE(last.error().message.find("No space left"), std::string::npos);
  EXPECT_EQ(journal->next(), accepted + 1);
  EXPECT_FALSE(journal->append("key", text(accepted + 1))) << "and goes on saying so";
  settle();
  EXPECT_EQ(numbers(*journal), range(1, accepted)) << "what was accepted is all there";
  journal->acknowledge(accepted / 2);  // which frees files, without writing first
  EXPECT_EQ(journal->append("key", text(accepted + 1)), accepted + 1);
  platter.room = std::numeric_limits<std::size_t>::max();
  EXPECT_TRUE(journal->append("key", text(accepted + 2)));
  EXPECT_EQ(numbers(*journal), range(accepted / 2 + 1, accepted + 2));
  EXPECT_EQ(numbers(*open()), range(accepted / 2 + 1, accepted + 2));
}

TEST_F(JournalTest, HasABound) {
  auto const journal = open({.bytes = 2000, .segment_bytes = 500});
  std::uint64_t accepted = 0;
  base::Result<std::uint64_t> last;
  while ((last = journal->append("key", text(accepted + 1)))) ++accepted;
  EXPECT_EQ(last.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(last.error().message, fmt::format("{} messages wait in memory, which has its 2000 bytes", accepted));
  EXPECT_LT(journal->bytes(), 2100u);
}

TEST_F(JournalTest, ReadsOnPastWhatADiskHasLost) {
  {
    auto const journal = open();
    for (std::uint64_t i = 1; i <= 50; ++i) EXPECT_TRUE(journal->append("key", text(i)));
  }
  auto& second = std::next(platter.files.begin())->second;
  second[second.size() / 2] ^= 1;
  auto const journal = open();
  EXPECT_GT(journal->damaged_bytes(), 0u);
  auto const left = numbers(*journal);
  EXPECT_LT(left.size(), 50u);
  EXPECT_EQ(left.front(), 1u);
  EXPECT_EQ(left.back(), 50u);
}

TEST_F(JournalTest, WritesNothingBehindWhatADiskHasLost) {
  std::uint64_t accepted = 0;
  {
    auto const journal = open();
    while (platter.files.size() < 2) EXPECT_TRUE(journal->append("key", text(++accepted)));
  }
  // Of the last file not even the head was written, and the end of the one before is damaged.
  auto& first = platter.files.begin()->second;
  first[first.size() - 1] ^= 1;
  std::prev(platter.files.end())->second.resize(3);
  auto journal = open();
  auto const number = journal->append("key", text(journal->next()));
  ASSERT_TRUE(number);
  journal = open();
  EXPECT_EQ(numbers(*journal).back(), *number);
}

TEST_F(JournalTest, NeverUsesAnAcknowledgedNumberAgain) {
  // A head with the right CRC whose oldest message comes after its next one.
  std::vector<std::uint8_t> body;
  ByteWriter head(body);
  head.number(std::uint8_t{1});
  for (std::uint64_t const number : {7U, 40U, 30U, 0U, 0U}) head.number(number);
  auto& file = platter.files["0000000000000001.segment"];
  ByteWriter writer(file);
  writer.bytes("LWjrnl1\n");
  writer.number(static_cast<std::uint32_t>(body.size()));
  writer.number(crc32(body));
  file.insert(file.end(), body.begin(), body.end());
  auto journal = open();
  EXPECT_EQ(journal->append("key", text(40)), 40U);
  journal = open();
  EXPECT_EQ(numbers(*journal), range(40, 40));
}

TEST_F(JournalTest, SaysWhenTheDiskFailsAndTriesAgain) {
  auto const journal = open();
  settle();
  platter.sync_fails = true;
  EXPECT_TRUE(journal->append("key", text(1)));
  settle();
  EXPECT_EQ(journal->ready(), 0u);
  EXPECT_EQ(faults.size(), 1u);
  platter.sync_fails = false;
  EXPECT_TRUE(journal->append("key", text(2)));
  settle();
  EXPECT_EQ(journal->ready(), 2u);
}

TEST_F(JournalTest, SkipsNumbersThatTheFarEndHas) {
  auto journal = open();
  EXPECT_TRUE(journal->append("key", text(1)));
  journal->skip_to(10);
  EXPECT_EQ(journal->append("key", text(10)), 10u);
  EXPECT_EQ(numbers(*open()), (std::vector<std::uint64_t>{1, 10}));
}

/// A real folder and a real kill -9 of a process that appends as fast as it can.
TEST(FolderDisk, KeepsWhatWasAcceptedWhenTheProcessIsKilled) {
  base::testing::TemporaryFolder const folder;
  std::uint64_t accepted_before = 0;
  for (int round = 0; round < 5; ++round) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    auto const child = ::fork();
    if (child == 0) {
      base::Loop loop;
      auto disk = open_folder(loop, folder.path());
      auto journal = Journal::open(*std::move(disk), {.bytes = 50'000'000, .segment_bytes = 20'000}, 1);
      for (;;) {
        auto const number = (*journal)->append("key", std::string(100, 'x'));
        if (::write(pipe[1], &*number, sizeof(*number)) != sizeof(*number)) ::_exit(1);
      }
    }
    ::close(pipe[1]);
    std::uint64_t accepted = 0;
    for (int i = 0; i < 2000 + round * 777; ++i) ASSERT_EQ(::read(pipe[0], &accepted, sizeof(accepted)), 8);
    ::kill(child, SIGKILL);
    while (::read(pipe[0], &accepted, sizeof(accepted)) == 8) {
    }
    ::close(pipe[0]);
    ::waitpid(child, nullptr, 0);
    EXPECT_GT(accepted, accepted_before);
    accepted_before = accepted;

    base::Loop loop;
    auto disk = open_folder(loop, folder.path());
    ASSERT_TRUE(disk) << disk.error().message;
    auto journal = Journal::open(*std::move(disk), {.bytes = 50'000'000, .segment_bytes = 20'000}, 1);
    ASSERT_TRUE(journal);
    EXPECT_GE((*journal)->next(), accepted + 1);
    std::uint64_t expected = 1;
    while (auto const entry = *(*journal)->read(expected)) {
      ASSERT_EQ(entry->number, expected++);
      ASSERT_EQ(entry->text, std::string(100, 'x'));
    }
    EXPECT_EQ(expected, (*journal)->next());
  }
}

TEST(FolderDisk, IsForOneProgramAlone) {
  base::testing::TemporaryFolder const folder;
  base::Loop loop;
  auto const first = open_folder(loop, folder.path());
  ASSERT_TRUE(first);
  auto const second = open_folder(loop, folder.path());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().message, fmt::format("another program uses {}", folder.path().string()));
}

TEST(FolderDisk, WaitsForTheDiskBesideTheLoop) {
  base::testing::TemporaryFolder const folder;
  base::Loop loop;
  auto journal = Journal::open(*open_folder(loop, folder.path()), {}, 1);
  base::Notifier became_ready(loop);
  (*journal)->listen({.ready = [&] { became_ready.notify_all(); }, .fault = {}});
  EXPECT_TRUE((*journal)->append("key", "text"));
  EXPECT_EQ((*journal)->ready(), 0u);
  EXPECT_TRUE(loop.run_until_done(became_ready.wait_for([&] { return (*journal)->ready() == 1; }, 10s)));
  journal = std::unexpected(base::Error{});
}

}  // namespace
}  // namespace lapwing::link::operator_link
