// Telegrams of leading values on a network: what goes out comes in to the bit, and nothing else does.
#include "hmi_bridge/lcm/leading_values.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/directory.hpp"

namespace lockstep::leading_values_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kNow = 50 * kSecond;

LeadingValueLink link(const std::string& key = "") {
  return {.area = "line.main",
          .sender = "PLC_1",
          .source = "Conveyor",
          .interface = 1,
          .key = SharedKey(key.begin(), key.end())};
}

LeadingValueTelegram telegram(std::uint64_t sequence, std::int64_t time = kNow) {
  LeadingValueTelegram made;
  made.sequence = sequence;
  made.time = time;
  made.cycle = 1'000'000;
  made.delay = 4'000'000;
  made.value = {{-3, 123.456}, -7.5, 1e-3};
  made.modulo.enabled = true;
  made.modulo.length = 360.0;
  made.modulo.start = -180.0;
  made.renamed = {1.0 / 3.0, 1e-17};
  made.restarts = 2;
  made.valid = true;
  made.position_led = true;
  return made;
}

Bytes written(LeadingValueWriter& writer, const LeadingValueTelegram& one) {
  const auto bytes = writer.write(one);
  return {bytes.begin(), bytes.end()};
}

TEST(LeadingValues, ComeInAsTheyWentOut) {
  for (const char* const key : {"", "a key of sixteen bytes and more"}) {
    LeadingValueWriter writer(link(key), 99);
    LeadingValueReader reader(link(key));
    LeadingValueTelegram sent = telegram(7);
    const auto came = reader.read(written(writer, sent), kNow);
    ASSERT_TRUE(came);
    EXPECT_EQ(came->sequence, sent.sequence);
    EXPECT_EQ(came->run, 99u);
    EXPECT_EQ(came->time, sent.time);
    EXPECT_EQ(came->cycle, sent.cycle);
    EXPECT_EQ(came->delay, sent.delay);
    EXPECT_EQ(came->value.position, sent.value.position);
    EXPECT_EQ(came->value.velocity, sent.value.velocity);
    EXPECT_EQ(came->value.acceleration, sent.value.acceleration);
    EXPECT_TRUE(came->modulo.enabled && came->modulo.length == 360.0 && came->modulo.start == -180.0);
    EXPECT_EQ(came->renamed.hi, sent.renamed.hi);
    EXPECT_EQ(came->renamed.lo, sent.renamed.lo);
    EXPECT_EQ(came->restarts, 2u);
    EXPECT_TRUE(came->valid && came->position_led);
    sent = telegram(8);
    sent.valid = sent.position_led = sent.modulo.enabled = false;
    const auto next = reader.read(written(writer, sent), kNow);
    ASSERT_TRUE(next);
    EXPECT_FALSE(next->valid || next->position_led || next->modulo.enabled);
    EXPECT_EQ(reader.counters().accepted, 2u);
  }
}

TEST(LeadingValues, OfAnotherAreaSenderOrLayoutAreForeign) {
  LeadingValueReader reader(link());
  std::uint64_t foreign = 0;
  for (int part = 0; part < 4; ++part) {
    LeadingValueLink other = link();
    if (part == 0) other.area = "line.other";
    if (part == 1) other.sender = "PLC_2";
    if (part == 2) other.source = "Roll";
    if (part == 3) other.interface = 2;
    EXPECT_NE(other.layout(), link().layout()) << part;
    LeadingValueWriter writer(other, 99);
    EXPECT_FALSE(reader.read(written(writer, telegram(1)), kNow)) << part;
    EXPECT_EQ(reader.counters().foreign, ++foreign);
  }
}

TEST(LeadingValues, CountOnlyWithTheRightKey) {
  const char* const kKey = "a key of sixteen bytes and more";
  LeadingValueReader reader(link(kKey));
  LeadingValueWriter with_another(link("another key of sixteen bytes"), 99), without(link(), 99),
      right(link(kKey), 99);
  EXPECT_FALSE(reader.read(written(with_another, telegram(1)), kNow));
  EXPECT_FALSE(reader.read(written(without, telegram(1)), kNow));
  EXPECT_EQ(reader.counters().not_signed, 2u);
  const Bytes good = written(right, telegram(1));
  for (std::size_t i = 8; i < good.size(); ++i) {
    Bytes changed = good;
    changed[i] ^= 0x10;
    EXPECT_FALSE(LeadingValueReader(link(kKey)).read(changed, kNow)) << "byte " << i;
  }
  EXPECT_TRUE(reader.read(good, kNow));
  // One that asks for no code does not take a signed one either: the key is missing on one side.
  EXPECT_FALSE(LeadingValueReader(link()).read(good, kNow));
}

TEST(LeadingValues, CountOnceEach) {
  LeadingValueWriter writer(link(), 99);
  LeadingValueReader reader(link());
  std::vector<Bytes> sent;
  for (std::uint64_t i = 1; i <= 100; ++i)
    sent.push_back(written(writer, telegram(i, kNow + static_cast<std::int64_t>(i))));
  EXPECT_TRUE(reader.read(sent[69], kNow));
  EXPECT_FALSE(reader.read(sent[69], kNow)) << "doubled";
  EXPECT_TRUE(reader.read(sent[68], kNow)) << "late";
  EXPECT_FALSE(reader.read(sent[68], kNow));
  EXPECT_TRUE(reader.read(sent[6], kNow)) << "63 behind";
  EXPECT_FALSE(reader.read(sent[5], kNow)) << "64 behind: nobody knows any more";
  EXPECT_TRUE(reader.read(sent[99], kNow));
  EXPECT_FALSE(reader.read(sent[69], kNow));
  EXPECT_TRUE(reader.read(sent[70], kNow));
  EXPECT_EQ(reader.counters().repeated, 4u);
  EXPECT_EQ(reader.counters().accepted, 5u);
}

TEST(LeadingValues, CountOnlyNearTheClock) {
  LeadingValueWriter writer(link(), 99);
  LeadingValueReader reader(link());
  EXPECT_FALSE(reader.read(written(writer, telegram(1, kNow - kSecond - 1)), kNow));
  EXPECT_FALSE(reader.read(written(writer, telegram(2, kNow + kSecond + 1)), kNow));
  EXPECT_FALSE(reader.read(written(writer, telegram(3, INT64_MIN)), kNow));
  EXPECT_FALSE(reader.read(written(writer, telegram(4, INT64_MAX)), kNow));
  EXPECT_FALSE(reader.read(written(writer, telegram(0, kNow)), kNow)) << "no sequence";
  EXPECT_EQ(reader.counters().stale, 5u);
  EXPECT_TRUE(reader.read(written(writer, telegram(5, kNow - kSecond)), kNow));
}

TEST(LeadingValues, OfASenderThatHasBeenStartedAnewGoOn) {
  LeadingValueWriter before(link(), 99), after(link(), 100);
  LeadingValueReader reader(link());
  EXPECT_TRUE(reader.read(written(before, telegram(5000, kNow)), kNow));
  EXPECT_FALSE(reader.read(written(after, telegram(1, kNow)), kNow)) << "not behind what has been";
  EXPECT_TRUE(reader.read(written(after, telegram(1, kNow + 10)), kNow));
  EXPECT_TRUE(reader.read(written(after, telegram(2, kNow + 20)), kNow));
}

TEST(LeadingValues, OfTwoSendersDoNotCount) {
  LeadingValueWriter one(link(), 99), other(link(), 100);
  LeadingValueReader reader(link());
  EXPECT_TRUE(reader.read(written(one, telegram(1, kNow)), kNow));
  EXPECT_TRUE(reader.read(written(other, telegram(1, kNow + 1)), kNow));
  for (int i = 2; i < 50; ++i) {
    const std::int64_t now = kNow + i * 1'000'000;
    EXPECT_FALSE(reader.read(written(one, telegram(static_cast<std::uint64_t>(i), now)), now));
    EXPECT_FALSE(reader.read(written(other, telegram(static_cast<std::uint64_t>(i), now)), now));
  }
  EXPECT_EQ(reader.counters().ambiguous, 96u);
  const std::int64_t later = kNow + 2 * kSecond;
  EXPECT_TRUE(reader.read(written(other, telegram(1000, later)), later)) << "one of them has ended";
}

TEST(LeadingValues, OfTheFirstSenderCountAgainWhenTheSecondHasEnded) {
  LeadingValueWriter one(link(), 99), other(link(), 100);
  LeadingValueReader reader(link());
  const std::int64_t kLast = kNow + 50'000'000;  // of the other one
  std::int64_t counts_again = 0;
  for (std::uint64_t i = 1; i <= 3000; ++i) {
    const std::int64_t now = kNow + static_cast<std::int64_t>(i) * 1'000'000;
    const bool counted = reader.read(written(one, telegram(i, now)), now).has_value();
    if (i >= 10 && now <= kLast) reader.read(written(other, telegram(i, now + 1)), now + 1);
    if (now <= kLast) continue;
    if (counted && counts_again == 0) counts_again = now;
    EXPECT_EQ(counted, counts_again != 0) << "never lost again";
  }
  EXPECT_EQ(counts_again, kLast + kSecond + 1'000'000)
      << "a second behind the last telegram of the other one";
}

// One forged or broken telegram must not make all that follow it old.
TEST(LeadingValues, OfASequenceAheadOfItsTimeDoNotCount) {
  LeadingValueWriter writer(link(), 99);
  LeadingValueReader reader(link());
  EXPECT_TRUE(reader.read(written(writer, telegram(1, kNow)), kNow));
  for (const std::int64_t far : {std::int64_t{66}, std::int64_t{1000}, INT64_MAX})
    EXPECT_FALSE(reader.read(written(writer, telegram(static_cast<std::uint64_t>(far), kNow)), kNow)) << far;
  LeadingValueTelegram fast = telegram(1000, kNow + 1000);
  fast.cycle = 1;
  EXPECT_FALSE(reader.read(written(writer, fast), kNow + 1000)) << "the cycle of a run does not change";
  EXPECT_EQ(reader.counters().stale, 4u);
  EXPECT_TRUE(reader.read(written(writer, telegram(65, kNow)), kNow));
  EXPECT_TRUE(reader.read(written(writer, telegram(2, kNow + 1'000'000)), kNow + 1'000'000))
      << "the true one";
  // A network that has been away for a while, and a clock that has been set back.
  const std::int64_t later = kNow + 100 * kSecond;
  EXPECT_TRUE(reader.read(written(writer, telegram(100'001, later)), later));
  EXPECT_TRUE(reader.read(written(writer, telegram(100'002, kNow)), kNow));
  EXPECT_TRUE(reader.read(written(writer, telegram(105'002, kNow + 5 * kSecond)), kNow + 5 * kSecond));
}

TEST(LeadingValues, OfAnyOtherBytesAreMalformed) {
  LeadingValueWriter writer(link(), 99);
  const Bytes good = written(writer, telegram(1));
  LeadingValueReader reader(link());
  EXPECT_FALSE(reader.read({}, kNow));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(reader.read(std::span(good).first(size), kNow)) << size;
  Bytes longer = good;
  longer.push_back(0);
  EXPECT_FALSE(reader.read(longer, kNow));
  EXPECT_EQ(reader.counters().malformed, good.size() + 2);
  EXPECT_TRUE(reader.read(good, kNow));
}

// RFC 4231, cases 1, 2 and 6.
TEST(MessageCodes, AreThoseOfTheStandard) {
  const auto hex = [](const SharedKey& key, const std::string& text) {
    const Bytes bytes(text.begin(), text.end());
    std::string result;
    for (const std::uint8_t byte : code_of(bytes, key)) {
      char digits[3];
      std::snprintf(digits, sizeof digits, "%02x", byte);
      result += digits;
    }
    return result;
  };
  EXPECT_EQ(hex(SharedKey(20, 0x0b), "Hi There"),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(hex({'J', 'e', 'f', 'e'}, "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(hex(SharedKey(131, 0xaa), "Test Using Larger Than Block-Size Key - Hash Key First"),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
  MessageCode a{}, b{};
  EXPECT_TRUE(same_code(a, b));
  b[31] = 1;
  EXPECT_FALSE(same_code(a, b));
}

std::string refusal_of(const std::string& path) {
  try {
    read_key_file(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(KeyFiles, AreThoseThatOnlyTheirOwnerReads) {
  const test::Directory directory;
  const std::string path = directory.write("key", "0123456789abcdef\n");
  ::chmod(path.c_str(), 0640);
  EXPECT_NE(refusal_of(path).find("chmod 600"), std::string::npos) << refusal_of(path);
  ::chmod(path.c_str(), 0600);
  EXPECT_EQ(read_key_file(path).size(), 16u) << "without the end of its line";
  directory.write("key", "short");
  EXPECT_NE(refusal_of(path).find("it has 5 bytes; allowed: 16 to 1024"), std::string::npos);
  directory.write("key", std::string(1025, 'x'));
  EXPECT_NE(refusal_of(path).find("allowed: 16 to 1024"), std::string::npos);
  EXPECT_NE(refusal_of(directory.file("none")).find(directory.file("none")), std::string::npos);
  ASSERT_EQ(::mkfifo(directory.file("pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal_of(directory.file("pipe")).find("is no file but"), std::string::npos)
      << "nobody waits for it";
  EXPECT_NE(refusal_of(directory.file("")).find("is no file but"), std::string::npos);
}

}  // namespace
}  // namespace lockstep::leading_values_test
