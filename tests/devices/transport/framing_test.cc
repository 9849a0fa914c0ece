// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/framing.h"

#include <gmock/gmock.h>

#include <deque>

#include "text_of_bytes.h"

namespace lightcal::devices {
namespace {

using test::Text;

using std::chrono::milliseconds;
using testing::HasSubstr;

// Gives these pieces, each cut to what was asked; then is silent.
class Pieces final : public Transport {
 public:
  explicit Pieces(std::deque<std::string> pieces) : pieces_(std::move(pieces)) {}
  Result<void> Write(std::span<const std::byte>, milliseconds) override { return {}; }
  Result<Bytes> Read(std::size_t max, milliseconds timeout) override {
    waits.push_back(timeout);
    if (pieces_.empty()) return Failed(std::string(fault::kTimeout), "pieces", "silent");
    std::string& next = pieces_.front();
    const std::string given = next.substr(0, max);
    next.erase(0, given.size());
    if (next.empty()) pieces_.pop_front();
    const auto bytes = AsBytes(given);
    return Bytes(bytes.begin(), bytes.end());
  }
  [[nodiscard]] std::string Name() const override { return "pieces"; }
  std::vector<milliseconds> waits;

 private:
  std::deque<std::string> pieces_;
};

constexpr milliseconds kWait{1000};

TEST(Framing, MessagesAreCutAtTheirEndWhateverThePieces) {
  Pieces line({"1", "2\r", "\n3\r\n4", "\r\n"});
  StreamReader reader(line);
  EXPECT_EQ(Text(*reader.ReadUntil("\r\n", 32, kWait)), "12\r\n");
  EXPECT_EQ(Text(*reader.ReadUntil("\r\n", 32, kWait)), "3\r\n");
  EXPECT_EQ(Text(*reader.ReadUntil("\r\n", 32, kWait)), "4\r\n");
  EXPECT_EQ(reader.ReadUntil("\r\n", 32, kWait).error().code, fault::kTimeout);
}

TEST(Framing, ACountOfBytesIsThatCountWhateverThePieces) {
  Pieces line({"abcdefgh", "ij"});
  StreamReader reader(line);
  EXPECT_EQ(Text(*reader.ReadExactly(3, kWait)), "abc");
  EXPECT_EQ(Text(*reader.ReadExactly(6, kWait)), "defghi");
  EXPECT_EQ(Text(*reader.ReadUntil("j", 1, kWait)), "j");
}

TEST(Framing, AMessageOfExactlyTheBoundPassesAndOneMoreDoesNot) {
  Pieces fits({"123\n"});
  EXPECT_EQ(Text(*StreamReader(fits).ReadUntil("\n", 4, kWait)), "123\n");
  Pieces exceeds({"1234\n"});
  const auto too_long = StreamReader(exceeds).ReadUntil("\n", 4, kWait);
  ASSERT_FALSE(too_long);
  EXPECT_EQ(too_long.error().code, kBadReply);
  EXPECT_THAT(too_long.error().message, HasSubstr("4 bytes"));
}

TEST(Framing, ABrokenOffMessageIsABadReplyThatShowsItsBytes) {
  Pieces line(
      {"\x02"
       "00"});
  StreamReader reader(line);
  const auto broken = reader.ReadExactly(14, kWait);
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().code, kBadReply);
  EXPECT_THAT(broken.error().message, HasSubstr("3 bytes: \\x0200"));
  EXPECT_EQ(reader.ReadExactly(14, kWait).error().code, fault::kTimeout);
}

TEST(Framing, OnlyTheFirstByteIsWaitedForLong) {
  Pieces line({"1", "2", "\n"});
  StreamReader reader(line, milliseconds(7));
  ASSERT_TRUE(reader.ReadUntil("\n", 8, kWait));
  EXPECT_THAT(line.waits, testing::ElementsAre(kWait, milliseconds(7), milliseconds(7)));
}

TEST(Framing, ADrainForgetsWhatIsHeldAndEndsOnALineThatNeverStops) {
  std::deque<std::string> endless(100, "x");
  endless.front() = "a\nb";
  Pieces line(endless);
  StreamReader reader(line);
  ASSERT_TRUE(reader.ReadUntil("\n", 8, kWait));
  reader.Drain(milliseconds(5));
  EXPECT_EQ(line.waits.size(), 1U + StreamReader::kLongestDrain);
  EXPECT_EQ(Text(*reader.ReadExactly(1, kWait)), "x");
}

}  // namespace
}  // namespace lightcal::devices
