#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "hmi_bridge/lcm/messages.hpp"
#include "tests/hmi_bridge/trace_samples.hpp"
#include "tests/support/property.hpp"

namespace lockstep::lcm_messages_test {
namespace {

using Message = LcmDecoder::Message;

std::vector<std::uint8_t> copy(std::span<const std::uint8_t> bytes) {
  return {bytes.begin(), bytes.end()};
}

struct Sample {
  LcmEncoder encoder{{"rotary_knife", "KNIFE", 2'000'000, 1'700'000'000'000'000}, sample_signals()};
  std::vector<std::uint8_t> header = copy(encoder.header());
  std::vector<Value> values = sample_rows(1, 5)[0];
  std::vector<std::uint8_t> row = copy(encoder.row({2'000'000, 3, 1, values}));
};

TEST(LcmMessages, AStrangerReadsTheValuesWithTheGeneratedTypesAlone) {
  const std::vector<TraceSignal> signals = {
      {"on", Type::BOOL, ""}, {"after", Type::TIME, "s"}, {"x", Type::LREAL, "u"}};
  const std::vector<Value> values = {integer(1), integer(1'500'000'000), real(0.1)};
  LcmEncoder encoder({"sample", "SAMPLE", 2'000'000, 1'000}, signals);

  trace_header_t header;
  const auto header_bytes = copy(encoder.header());
  ASSERT_EQ(header.decode(header_bytes.data(), 0, static_cast<int>(header_bytes.size())),
            header_bytes.size());
  EXPECT_EQ(header.project, "sample");
  EXPECT_EQ(header.channel, "SAMPLE");
  EXPECT_EQ(header.period, 2'000'000);
  EXPECT_EQ(header.names, (std::vector<std::string>{"on", "after", "x"}));
  EXPECT_EQ(header.types, (std::vector<std::string>{"BOOL", "TIME", "LREAL"}));
  EXPECT_EQ(header.units, (std::vector<std::string>{"", "s", "u"}));
  EXPECT_EQ(header.exact_index, (std::vector<std::int32_t>{-1, 0, -1}));

  trace_row_t row;
  const auto row_bytes = copy(encoder.row({4'000'000, 4, 7, values}));
  ASSERT_EQ(row.decode(row_bytes.data(), 0, static_cast<int>(row_bytes.size())), row_bytes.size());
  EXPECT_EQ(row.utime, 5'000);
  EXPECT_EQ(row.header_id, header.id);
  EXPECT_EQ(row.t, 4'000'000);
  EXPECT_EQ(row.tick, 4);
  EXPECT_EQ(row.number, 0);
  EXPECT_EQ(row.dropped, 7);
  EXPECT_EQ(row.values, (std::vector<double>{1.0, 1.5, 0.1}));
  EXPECT_EQ(row.exact, (std::vector<std::int64_t>{1'500'000'000}));
  const auto next = encoder.row({8'000'000, 8, 7, values});
  ASSERT_EQ(row.decode(next.data(), 0, static_cast<int>(next.size())), next.size());
  EXPECT_EQ(row.number, 1) << "however many ticks the run has missed";
}

TEST(LcmMessages, AStringOfAnImpossibleLengthIsDamage) {
  Sample sample;
  constexpr std::size_t kProjectLength = 8 + 4 + 8;
  const std::size_t channel_length = kProjectLength + 4 + std::string("rotary_knife").size() + 1;
  for (const std::size_t place : {kProjectLength, channel_length}) {
    for (const std::uint32_t length : {0u, 0x80000000u, 0x80000001u, 0xFFFFFFFFu, 0x7FFFFFFFu, 12345u, 2u}) {
      std::vector<std::uint8_t> bytes = sample.header;
      for (std::size_t i = 0; i < 4; ++i)
        bytes[place + i] = static_cast<std::uint8_t>(length >> (24 - 8 * i));
      LcmDecoder decoder;
      EXPECT_EQ(decoder.accept(bytes), Message::kDamaged) << length;
    }
  }
}

TEST(LcmMessages, NoValueOfAnyTypeLosesABit) {
  Sample sample;
  LcmDecoder decoder;
  ASSERT_EQ(decoder.accept(sample.header), Message::kHeader);
  EXPECT_EQ(decoder.signals(), sample_signals());
  for (const std::vector<Value>& values : sample_rows(1000, test::seed_of_test(99))) {
    ASSERT_EQ(decoder.accept(sample.encoder.row({-5, 1, 0, values})), Message::kRow);
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_EQ(decoder.row().values[i].u, values[i].u) << "signal " << i;
  }
  EXPECT_EQ(decoder.row().t, -5);
}

TEST(LcmMessages, TheIdOfAHeaderIsThatOfItsContent) {
  const auto id = [](const LcmTraceIdentity& identity, const std::vector<TraceSignal>& signals) {
    LcmEncoder encoder(identity, signals);
    LcmDecoder decoder;
    decoder.accept(encoder.header());
    return decoder.header().id;
  };
  const std::int64_t first = id({"p", "C", 1000, 0}, {{"ab", Type::BOOL, ""}, {"c", Type::BOOL, ""}});
  EXPECT_EQ(first, id({"p", "C", 1000, 77}, {{"ab", Type::BOOL, ""}, {"c", Type::BOOL, ""}}));
  EXPECT_NE(first, id({"p", "C", 1000, 0}, {{"a", Type::BOOL, ""}, {"bc", Type::BOOL, ""}}));
  EXPECT_NE(first, id({"p", "C", 1000, 0}, {{"ab", Type::BOOL, ""}, {"c", Type::BYTE, ""}}));
  EXPECT_NE(first, id({"p", "C", 2000, 0}, {{"ab", Type::BOOL, ""}, {"c", Type::BOOL, ""}}));
}

TEST(LcmMessages, ARowBeforeItsHeaderIsEarlyAndOtherMessagesAreForeign) {
  Sample sample;
  LcmEncoder other({"other", "KNIFE", 1, 0}, sample_signals());
  LcmDecoder decoder;
  EXPECT_EQ(decoder.accept(sample.row), Message::kEarly);
  EXPECT_EQ(decoder.accept(other.header()), Message::kHeader);
  EXPECT_EQ(decoder.accept(sample.row), Message::kEarly);
  EXPECT_EQ(decoder.accept(sample.header), Message::kHeader);
  EXPECT_EQ(decoder.accept(sample.row), Message::kRow);
  EXPECT_EQ(decoder.accept({}), Message::kForeign);
  EXPECT_EQ(decoder.accept(std::vector<std::uint8_t>(100, 0x5a)), Message::kForeign);
}

TEST(LcmMessages, AMessageThatIsTooShortOrTooLongIsDamaged) {
  Sample sample;
  LcmDecoder decoder;
  ASSERT_EQ(decoder.accept(sample.header), Message::kHeader);
  for (auto* bytes : {&sample.header, &sample.row}) {
    for (std::size_t size = 8; size < bytes->size(); ++size)
      ASSERT_EQ(decoder.accept(std::span(*bytes).first(size)), Message::kDamaged) << size;
    bytes->push_back(0);
    ASSERT_EQ(decoder.accept(*bytes), Message::kDamaged);
  }
}

// A count of two thousand million elements must not make room for them.
TEST(LcmMessages, CountsAndLengthsThatAMessageCannotHoldAreRefused) {
  Sample sample;
  for (const std::uint8_t high : std::initializer_list<std::uint8_t>{0x7f, 0x80, 0xff}) {
    LcmDecoder decoder;
    ASSERT_EQ(decoder.accept(sample.header), Message::kHeader);
    for (std::size_t offset = 8; offset + 4 <= sample.header.size(); ++offset) {
      auto header = sample.header;
      header[offset] = high;
      decoder.accept(header);
    }
    ASSERT_EQ(decoder.accept(sample.header), Message::kHeader);
    auto row = sample.row;
    row[56] = high;
    EXPECT_EQ(decoder.accept(row), Message::kDamaged);
    row = sample.row;
    row[60 + 8 * sample_signals().size()] = high;
    EXPECT_EQ(decoder.accept(row), Message::kDamaged);
  }
}

TEST(LcmMessages, AnIntegerOutsideItsTypeIsDamaged) {
  LcmEncoder encoder({"p", "C", 1, 0}, std::vector<TraceSignal>{{"n", Type::SINT, ""}});
  LcmEncoder wide({"p", "C", 1, 0}, std::vector<TraceSignal>{{"n", Type::INT, ""}});
  LcmDecoder decoder;
  ASSERT_EQ(decoder.accept(encoder.header()), Message::kHeader);
  trace_row_t row{};
  row.header_id = decoder.header().id;
  row.n = 1;
  for (const double value : {128.0, -129.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    row.values = {value};
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(row.getEncodedSize()));
    row.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    EXPECT_EQ(decoder.accept(bytes), Message::kDamaged) << value;
  }
}

TEST(LcmMessages, BytesAtRandomDoNoHarm) {
  std::mt19937_64 random(test::seed_of_test(31));
  Sample sample;
  LcmDecoder decoder;
  for (int i = 0; i < test::cases(20'000, 2'000'000); ++i) {
    auto bytes = i % 2 == 0 ? sample.header : sample.row;
    for (int k = 0; k < 3; ++k)
      bytes[8 + random() % (bytes.size() - 8)] = static_cast<std::uint8_t>(random());
    const Message message = decoder.accept(bytes);
    ASSERT_NE(message, Message::kForeign) << "message " << i;
    ASSERT_EQ(decoder.row().values.size(), decoder.signals().size());
  }
}

TEST(LcmMessages, AChannelHasToLeaveRoomForThatOfItsHeader) {
  EXPECT_NO_THROW(check_channel(std::string(kLongestTraceChannel, 'C')));
  EXPECT_THROW(check_channel(std::string(kLongestTraceChannel + 1, 'C')), std::invalid_argument);
  EXPECT_THROW(check_channel(""), std::invalid_argument);
}

}  // namespace
}  // namespace lockstep::lcm_messages_test
