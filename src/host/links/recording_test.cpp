#include "host/links/recording.hpp"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "link/pipe_link.hpp"
#include "mavlink/wire/tlog.hpp"

namespace lapwing::host {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class RecordingTest : public ::testing::Test {
 public:
  ~RecordingTest() override { fs::remove_all(folder_); }

 protected:
  RecordingTest() {
    fs::remove_all(folder_);
    connection_.add_link(std::move(pipe_.b));
    pipe_.a->start([](link::Peer, link::Bytes) {});
  }

  base::Task<> pass(base::Duration time) { co_await loop_.sleep(time); }
  void run_for(base::Duration time) { loop_.run_until_done(pass(time)); }

  std::size_t entries(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    mavlink::TlogReader reader(in);
    std::size_t count = 0;
    while (reader.next()) ++count;
    return count;
  }

  fs::path const folder_ = fs::path(testing::TempDir()) / "lapwing-recording" / "of today";
  base::Loop loop_{{.unpaced = true, .begins_at = base::UtcTime(std::chrono::seconds(1'700'000'000))}};
  link::Pipe pipe_ = link::make_pipe(loop_);
  mavlink::Connection connection_{loop_, {}, {}};
};

TEST_F(RecordingTest, KeepsWhatIsSentAndNamesTheFileByItsTime) {
  {
    auto const recording = Recording::begin(folder_, connection_, {});
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ((*recording)->file(), folder_ / "2023-11-14T22-13-20Z.tlog");
    EXPECT_EQ((*recording)->beside(".json"), (folder_ / "2023-11-14T22-13-20Z.json").string());
    run_for(4500ms);  // five heartbeats
  }
  EXPECT_EQ(entries(folder_ / "2023-11-14T22-13-20Z.tlog"), 5U);
}

TEST_F(RecordingTest, IsOnDiskWithinASecond) {
  auto const recording = Recording::begin(folder_, connection_, {});
  ASSERT_TRUE(recording);
  run_for(10500ms);
  EXPECT_GE(entries((*recording)->file()), 10U);
}

TEST_F(RecordingTest, NeverWritesOverAnother) {
  fs::path first;
  {
    auto const recording = Recording::begin(folder_, connection_, {});
    first = (*recording)->file();
    run_for(1ms);
  }
  auto const size = fs::file_size(first);
  auto const again = Recording::begin(folder_, connection_, {});
  ASSERT_TRUE(again);
  EXPECT_NE((*again)->file(), first);
  EXPECT_EQ(fs::file_size(first), size);
  EXPECT_EQ(find_recording(folder_).value(), std::max(first, (*again)->file()));
}

TEST_F(RecordingTest, SaysWhyItCannotBegin) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "file") << "no folder";
  auto const recording = Recording::begin(folder_ / "file", connection_, {});
  ASSERT_FALSE(recording);
  EXPECT_EQ(recording.error().kind, base::ErrorKind::io);
  EXPECT_NE(recording.error().message.find("file"), std::string::npos);
}

TEST_F(RecordingTest, SaysWhatItLooksForInAFolderWithout) {
  fs::create_directories(folder_);
  EXPECT_EQ(find_recording(folder_).error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(find_recording(folder_ / "nothing").error().kind, base::ErrorKind::not_found);
}

}  // namespace
}  // namespace lapwing::host
